"""A page that softreel wrote, opened in a real browser: Debian's chromium without a display, driven through selenium.

A test is a file test_NAME.py beside this one with unittest cases; it ends with `page.main()` and gets the program's path
as its argument. tests/CMakeLists.txt finds it and makes it the ctest `browser: NAME`.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 77  # what tests/CMakeLists.txt tells ctest
PROGRAM = None  # softreel, set by main()

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
except ImportError:
    webdriver = None


class Page(unittest.TestCase):
    """Cases about one page: `write(folder)` makes it (once for all cases) and returns its path."""

    @classmethod
    def write(cls, folder):
        raise NotImplementedError

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="softreel_browser_")
        cls.addClassCleanup(folder.cleanup)
        cls.file = pathlib.Path(cls.write(pathlib.Path(folder.name))).resolve()
        cls.browser = open_browser()
        cls.addClassCleanup(cls.browser.quit)

    def setUp(self):
        self.browser.set_window_size(1280, 900)
        self.browser.get(self.file.as_uri())

    def find(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def all(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def script(self, text, *arguments):
        return self.browser.execute_script(text, *arguments)

    # What holds for every page.

    def test_the_browser_has_nothing_to_complain_about(self):
        complaints = [e["message"] for e in self.browser.get_log("browser") if e["level"] in ("SEVERE", "WARNING")]
        self.assertEqual(complaints, [])

    def test_nothing_is_fetched_but_the_page_itself(self):
        names = self.script("return performance.getEntriesByType('resource').map(function (e) { return e.name; })")
        self.assertEqual([n for n in names if not n.startswith("data:")], [])

    def test_every_picture_is_shown(self):
        for image in self.all("img"):
            self.assertGreater(self.script("return arguments[0].naturalWidth", image), 0, image.get_attribute("alt"))
            self.assertTrue(image.get_attribute("alt"))
        for plot in self.all("svg"):
            self.assertGreater(min(plot.size.values()), 50)

    def test_a_narrow_window_has_no_sideways_scroll(self):
        self.browser.set_window_size(500, 900)  # chromium's least
        wide, shown = self.script("var d = document.documentElement; return [d.scrollWidth, d.clientWidth]")
        self.assertLessEqual(wide, shown)


class Tests(unittest.TestLoader):
    """`Page` itself holds cases for its heirs only."""

    def loadTestsFromTestCase(self, case):
        return unittest.TestSuite() if case is Page else super().loadTestsFromTestCase(case)


def softreel(*arguments):
    """Runs the program and returns what it printed; another exit code than 0 is a failure."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"softreel {' '.join(map(str, arguments))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def open_browser():
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    # No proxy and no network: a page has to stand by itself.
    for option in ("--headless=new", "--disable-dev-shm-usage", "--disable-gpu", "--disable-background-networking",
                   "--host-resolver-rules=MAP * ~NOTFOUND", "--force-device-scale-factor=1"):
        options.add_argument(option)
    if os.geteuid() == 0:
        options.add_argument("--no-sandbox")  # chromium refuses to run as root otherwise
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


def main():
    """Runs the cases of the file that calls this: python3 test_NAME.py PROGRAM [arguments of unittest]"""
    global PROGRAM
    if len(sys.argv) < 2:
        sys.exit(f"usage: {sys.argv[0]} PROGRAM [arguments of unittest]")
    PROGRAM = sys.argv.pop(1)
    missing = [name for name, found in (("python3-selenium", webdriver), ("chromium", shutil.which("chromium")),
                                        ("chromium-driver", shutil.which("chromedriver"))) if not found]
    if missing:
        print("not run: missing", ", ".join(missing), "(sh app/setup.sh test installs them)")
        sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)
    # The file that was started is the module __main__, but it imported this one by its name.
    sys.modules["page"].PROGRAM = PROGRAM
    unittest.main(testLoader=Tests(), verbosity=2)
