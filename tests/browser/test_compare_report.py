"""The page of softreel compare: worst first, slider, blink, the curve and the keyboard, in a browser."""

import struct
import subprocess
import time
import zlib

import page

try:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys
except ImportError:
    pass  # page.main() says that it is missing

FRAMES, BAD = 12, {4: 20, 9: 90}  # frame -> levels by which a square of it differs


def png(levels, text):
    """64 x 48 grey with a square in it, `levels` brighter."""
    rows = b"".join(b"\0" + bytes(100 + (levels if 10 <= x < 30 and 10 <= y < 30 else 0) for x in range(64))
                    for y in range(48))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 64, 48, 8, 0, 0, 0, 0)) +
            chunk(b"tEXt", b"Software\0" + text) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class CompareReport(page.Page):
    @classmethod
    def write(cls, folder):
        for side in ("reference", "actual"):
            (folder / side).mkdir()
            for frame in range(1, FRAMES + 1):
                levels = BAD.get(frame, 0) if side == "actual" else 0
                (folder / side / f"frame_{frame:04}.png").write_bytes(png(levels, side.encode() + b" </script><b>"))
        done = subprocess.run([page.PROGRAM, "compare", folder / "reference", folder / "actual", "--report",
                               folder / "report.html", "--report-pictures", "3"], capture_output=True, text=True, check=False)
        assert done.returncode == 1, done.stderr
        return folder / "report.html"

    def name(self):
        return self.find("#name").text

    def press(self, *keys):
        ActionChains(self.browser).send_keys(*keys).perform()

    def clip(self):
        return self.script("return getComputedStyle(document.getElementById('top')).clipPath")

    def pressed(self):
        return [b.text for b in self.all("button[aria-pressed=true]")]

    def test_the_worst_frame_is_shown_first_with_all_three_pictures(self):
        self.assertEqual(self.name(), "frame_0009.png")
        self.assertIn("90 levels", self.find("#text").text)
        self.assertEqual(sum(i.is_displayed() for i in self.all("#side img")), 3)
        names = [line.text.split(":")[0] for line in self.all("#names div")]
        self.assertEqual(names[:2], ["frame_0009.png", "frame_0004.png"])
        self.assertEqual(len(names), FRAMES)

    def test_a_click_on_the_curve_jumps_to_that_frame(self):
        curve = self.find("#curve")
        for frame in (1, 4, 12):
            x = (10 + 980 * (frame - 1) / (FRAMES - 1)) / 1000
            ActionChains(self.browser).move_to_element_with_offset(
                curve, int((x - 0.5) * curve.size["width"]), 0).click().perform()
            self.assertEqual(self.name(), f"frame_{frame:04}.png")
        self.assertEqual(len(self.all("#curve circle")), len(BAD))

    def test_the_slider_uncovers_the_actual_picture(self):
        self.find("#mode-slider").click()
        self.assertFalse(self.find("#side").is_displayed())
        self.assertIn("50%", self.clip())
        slider = self.find("#slider")
        ActionChains(self.browser).click_and_hold(slider).move_by_offset(-slider.size["width"] // 4, 0).release().perform()
        self.assertTrue(20 <= int(slider.get_attribute("value")) <= 30, slider.get_attribute("value"))
        self.assertIn(slider.get_attribute("value") + "%", self.clip())
        under, top = self.find("#under img"), self.find("#top img")
        self.assertEqual((under.size, under.location), (top.size, top.location))

    def test_blinking_alternates_until_another_view_is_chosen(self):
        self.find("#mode-blink").click()
        seen = set()
        end = time.time() + 5
        while len(seen) < 2 and time.time() < end:
            seen.add(self.find("#shown").text)
        self.assertEqual(seen, {"reference", "actual"})
        self.press("1")
        self.assertTrue(self.find("#side").is_displayed())

    def test_every_key_does_what_the_page_says(self):
        self.press(Keys.ARROW_LEFT)
        self.assertEqual(self.name(), "frame_0008.png")
        self.press(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        self.assertEqual(self.name(), "frame_0010.png")
        self.press(Keys.HOME)
        self.assertEqual(self.name(), "frame_0009.png")
        self.press(Keys.ARROW_DOWN)
        self.assertEqual(self.name(), "frame_0004.png")
        self.press(Keys.ARROW_UP)
        self.assertEqual(self.name(), "frame_0009.png")
        for key, button in (("2", "slider"), ("3", "blink"), ("1", "side by side")):
            self.press(key)
            self.assertEqual(self.pressed(), [button])
        self.press(".")
        self.assertIn("55%", self.clip())
        self.press(",", ",")
        self.assertIn("45%", self.clip())
        self.press(" ")
        self.assertEqual(self.find("#shown").text, "actual")
        self.press(" ")
        self.assertEqual(self.find("#shown").text, "reference")
        self.press("p")
        self.assertIn("pixels", self.pressed())

    def test_frames_without_pictures_say_so_and_texts_that_differ_are_marked(self):
        self.assertEqual([row.text for row in self.all("#texts tr.other")],
                         ["Software reference </script><b> actual </script><b>"])
        for _ in range(FRAMES):
            self.press(Keys.ARROW_DOWN)
        self.assertTrue(self.find("#none").is_displayed())
        self.assertFalse(self.find("#views").is_displayed())


page.main()
