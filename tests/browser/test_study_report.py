"""The report of softreel study: whole in a browser, and its table sorts."""

import json
import pathlib

import page

SCENES = pathlib.Path(__file__).parents[2] / "assets/scenes"


class StudyReport(page.Page):
    @classmethod
    def write(cls, folder):
        # A frame a second: one step of verlet each is unstable, a failed row, whose cells are empty.
        page.softreel("study", SCENES / "oscillator.toml", "--integrators", "verlet,newmark", "--substeps", "1,16,64",
                      "--set", "time.fps=1", "--set", "time.duration=12", "--repeats", "1", "-o", folder)
        cls.rows = json.loads((folder / "study.json").read_text())["rows"]
        return folder / "report.html"

    def column(self, number):
        return self.script("return Array.from(document.querySelectorAll(arguments[0]), cell => cell.dataset.value)",
                           f"tbody td:nth-child({number})")

    def test_every_run_of_the_study_is_a_row(self):
        self.assertEqual(sorted(self.column(1)), sorted(row["label"] for row in self.rows))
        self.assertTrue(self.all("tr.failed"))

    def test_a_click_on_a_head_sorts_its_column_both_ways_with_what_failed_last(self):
        for number, head in enumerate(self.all("th"), 1):
            self.script("arguments[0].scrollIntoView({inline: 'center'})", head)
            before = sorted(self.column(number))
            for order, back in (("ascending", False), ("descending", True)):
                if number <= 3:
                    head.click()  # as a mouse does, which takes a tenth of a second
                else:
                    self.script("arguments[0].click()", head)
                self.assertEqual(head.get_attribute("aria-sort"), order)
                self.assertEqual(len(self.all("th[aria-sort]")), 1)
                now = self.column(number)
                self.assertEqual(sorted(now), before)
                filled = [value for value in now if value != ""]
                self.assertEqual(now, filled + [""] * (len(now) - len(filled)), head.text)
                try:
                    filled = [float(value) for value in filled]
                except ValueError:
                    continue  # words: their order is the browser's own
                self.assertEqual(filled, sorted(filled, reverse=back), head.text)

    def test_the_plots_and_the_words_are_there(self):
        self.assertTrue(self.browser.title.startswith("Study of "))
        self.assertTrue(self.all("svg"))
        words = self.find("body").text
        for word in ("All runs", "How it was made", "softreel study", "closed form"):
            self.assertIn(word, words)


page.main()
