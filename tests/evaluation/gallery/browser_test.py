#!/usr/bin/env python3
"""Runs the gallery's script in a browser, as a user would use it: browser_test.py GALLERY_CODE CHROMIUM

Makes the gallery of sample facts, adds to its pages a script that presses, chooses and moves, and reads what it reports.
"""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from html import unescape
from pathlib import Path

import sample_facts

CODE, CHROMIUM = Path(sys.argv[1]), sys.argv[2]

# Each step leaves its findings in `found`.
USE = """
const found = {};
const cells = (table, column) => [...table.tBodies[0].rows].map((row) => row.children[column].textContent);
const table = document.querySelector("table");
if (table) {
    const heads = [...table.querySelectorAll("thead button")];
    const press = (column) => { heads[column].click(); return cells(table, column); };
    found.leak = press(1);
    found.fallingLeak = press(1);
    found.speed = press(2);
    found.names = press(0);
    found.sorted = [...table.querySelectorAll("th[aria-sort]")].map((head) => head.getAttribute("aria-sort"));
}
const slider = document.querySelector(".slider");
if (slider) {
    const [left, right] = slider.querySelectorAll(".stack img");
    const [first, second] = slider.querySelectorAll("select");
    const range = slider.querySelector("input");
    found.shown = [left.alt, right.alt];
    found.choices = [...first.options].map((option) => option.text);
    second.value = "1";
    second.dispatchEvent(new Event("change"));
    range.value = 25;
    range.dispatchEvent(new Event("input"));
    found.chosen = [left.alt, right.alt, getComputedStyle(right).clipPath];
    const box = slider.querySelector(".stack").getBoundingClientRect();
    slider.querySelector(".stack").setPointerCapture = () => {};
    slider.querySelector(".stack").dispatchEvent(new PointerEvent("pointerdown", { clientX: box.left + 0.75 * box.width }));
    found.dragged = range.value;
}
for (const details of document.querySelectorAll("details")) {
    details.open = true;
}
found.wide = [...document.querySelectorAll("body *")].filter((e) => !e.closest(".scroll *") &&
    !e.classList.contains("unseen") && e.getBoundingClientRect().right > innerWidth + 1).map((e) => e.outerHTML.slice(0, 80));
found.scrolls = document.documentElement.scrollWidth - innerWidth;
found.background = getComputedStyle(document.body).backgroundColor;
found.sources = [...document.querySelectorAll("picture img")].map((image) => image.currentSrc.split("/").pop());
document.body.append(Object.assign(document.createElement("pre"), { id: "found", textContent: JSON.stringify(found) }));
"""


class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        out = Path(cls.folder.name)
        cls.gallery = out / "gallery"
        cls.facts = sample_facts.write(out)
        subprocess.run([sys.executable, CODE / "make_gallery.py", "--out", out], check=True)
        for page in cls.gallery.rglob("index.html"):
            text = page.read_text().replace('loading="lazy"', "")
            used = text.replace("</body>", f"<script>addEventListener('load', () => {{{USE}}});</script></body>")
            page.with_name("used.html").write_text(used)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def use(self, page, width=1280, dark=False):
        # A window is at least 500 pixels wide, so a narrow page is a frame in it.
        frame = self.gallery / "frame.html"
        frame.write_text(f'<iframe src="{page}" style="width: {width}px; height: 800px; border: 0"></iframe>'
                         "<script>onload = () => document.body.append(frames[0].document.getElementById('found'))</script>")
        ended = subprocess.run([CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                                "--allow-file-access-from-files", f"--user-data-dir={self.folder.name}/profile",
                                f"--blink-settings=preferredColorScheme={0 if dark else 1}", "--window-size=1400,1000",
                                "--virtual-time-budget=8000", "--dump-dom", frame.as_uri()],
                               capture_output=True, text=True, timeout=120, check=True)
        return json.loads(unescape(re.search('<pre id="found">(.*?)</pre>', ended.stdout, re.DOTALL)[1]))

    def test_a_press_on_a_head_sorts_and_another_turns_the_order(self):
        found = self.use("first/used.html")
        numbers = [re.search(r"[\d.]+", text)[0] for text in found["leak"]]
        self.assertEqual(numbers, ["0.00", "2.11", "2.11", "2.12", "12.30"])
        self.assertEqual([re.search(r"[\d.]+", text)[0] for text in found["fallingLeak"]], numbers[::-1])
        self.assertIn("–", found["speed"][-1])
        self.assertEqual(found["names"][1:], ["fourth", "reference", "second", "third"])
        self.assertEqual(found["sorted"], ["ascending"])

    def test_two_pictures_are_compared_by_choice_keys_and_pointer(self):
        found = self.use("first/used.html")
        alts = [picture["alt"] for picture in self.facts["first"]["blocks"][1]["pictures"]]
        self.assertEqual(found["shown"], [alts[0], alts[2]])
        self.assertEqual(found["choices"], ["moved by 0", "moved by 8", "moved by 16"])
        self.assertEqual(found["chosen"], [alts[0], alts[1], "inset(0px 0px 0px 25%)"])
        self.assertEqual(float(found["dragged"]), 75)

    def test_pages_fit_into_a_phone_and_a_desktop(self):
        for name in ("used.html", *(f"{name}/used.html" for name in self.facts)):
            for width in (360, 390, 1280):
                found = self.use(name, width)
                self.assertEqual((found["wide"], found["scrolls"]), ([], 0), (name, width))

    def test_the_dark_scheme_has_pictures_of_its_own(self):
        for dark in (False, True):
            found = self.use("second/used.html", dark=dark)
            self.assertEqual(found["background"], "rgb(20, 24, 28)" if dark else "rgb(252, 252, 253)")
            self.assertTrue(all(source.endswith("-dark.svg") == dark and source.endswith(".svg") for source in found["sources"]))
            self.assertEqual(len(found["sources"]), 5)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
