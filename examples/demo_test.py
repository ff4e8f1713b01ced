#!/usr/bin/env python3
"""Runs the demo at its smallest and checks what it leaves: demo_test.py GNOMON_DEMO MAKE_GALLERY"""

import json
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

import matplotlib.image

DEMO, MAKE_GALLERY = sys.argv[1:3]


def run(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)


class Links(HTMLParser):
    def __init__(self):
        super().__init__()
        self.targets = set()

    def handle_starttag(self, tag, attrs):
        self.targets |= {value for name, value in attrs if name in ("src", "href") or (tag, name) == ("option", "value")}


class Demo(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name) / "out"
        for command in ([DEMO, "--tiny", "--out", cls.out], [sys.executable, MAKE_GALLERY, "--out", cls.out]):
            ended = run(*command)
            if ended.returncode:
                raise RuntimeError(ended.stderr)
        cls.report = json.loads((cls.out / "report.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def error(self, method, name, part=None, reference="filtered"):
        scene = "fence: " + part if part else "fence"
        row, = (row for row in self.report if row["lanes"] == 1
                and (row["scene"], row["method"], row["reference"]) == (scene, method, reference))
        return row[name]

    def less(self, better, worse, name="leak", part=None):
        self.assertLess(self.error(better, name, part), self.error(worse, name, part))

    def test_moments_leak_less_than_exponential_variance_at_64_bits(self):
        self.less("MSM 64 bit (paper)", "EVSM 64 bit")
        self.less("MSM 64 bit", "MSM 64 bit (paper)")

    def test_signed_depth_leaks_less_than_depth_from_0_to_1(self):
        self.less("MSM 128 bit (paper)", "MSM 128 bit, depth in [0, 1]")
        self.less("MSM 128 bit", "MSM 128 bit (paper)")

    def test_six_moments_leak_less_than_four_where_three_surfaces_meet(self):
        self.less("MSM6 192 bit", "MSM 128 bit", part="sign, fence and wall")

    def test_more_moments_and_more_bits_are_better(self):
        self.less("MSM 128 bit", "VSM 32 bit", "rmse")
        self.less("MSM6 192 bit", "MSM6 96 bit", "rmse")
        self.less("MSM6 96 bit", "MSM6 60 bit", "rmse")

    def test_percentage_closer_filtering_is_its_own_reference(self):
        # Some hundred float weights, each rounded to 2^-24 of at most 1 when it is added up.
        self.assertLess(self.error("PCF", "max_abs"), 1e3 * 2**-24)

    def test_lower_bounds_show_no_acne(self):
        # An intensity may exceed the bound by what rounding to the format can do; 1e-3 is visible to nobody.
        for method in ("VSM 32 bit", "LVSM 128 bit", "ESM 32 bit", "EVSM 128 bit", "MSM 64 bit", "MSM 128 bit",
                       "MSM6 192 bit"):
            self.assertLess(self.error(method, "acne"), 1e-3, method)

    def test_rows_are_complete(self):
        for row in self.report:
            self.assertGreater(row["receivers"], 0)
            self.assertGreater(row["ns_per_receiver"], 0)
            self.assertGreater(row["bytes_per_texel"], 0)

    def test_pictures_are_not_empty(self):
        files = sorted((self.out / "gallery").rglob("*.png"))
        self.assertGreater(len(files), 40)
        for file in files:
            if file.name == "method00-filtered.png" or file.name.endswith("-difference.png"):
                continue  # white: percentage-closer filtering against itself, and the CPU against a device
            self.assertGreater(matplotlib.image.imread(file)[..., :3].std(), 0.01, file)

    def test_the_page_links_to_what_is_there_and_to_nothing_outside(self):
        page = (self.out / "gallery" / "index.html").read_text()
        links = Links()
        links.feed(page)
        for target in links.targets - {""}:
            self.assertNotIn(":", target)
            if not target.startswith("#"):
                self.assertTrue((self.out / "gallery" / target).exists(), target)

    def test_bounds_hold(self):
        facts = json.loads((self.out / "gallery" / "bounds" / "facts.json").read_text())
        widths = []
        for bounds in facts["bounds"]:
            for z, lower, upper in zip(bounds["receivers"], bounds["lower"], bounds["upper"]):
                closer = sum(w for depth, w in zip(facts["depths"], facts["weights"]) if depth < z)
                self.assertLessEqual(lower, closer + 1e-12)
                self.assertLessEqual(closer, upper + 1e-12)
            widths.append(sum(u - l for u, l in zip(bounds["upper"], bounds["lower"])))
            for touching in bounds["representations"]:
                for power in range(bounds["moments"] + 1):
                    expected, found = (sum(w * z**power for z, w in zip(d["depths"], d["weights"]))
                                       for d in (facts, touching))
                    self.assertAlmostEqual(expected, found, 10)
        self.assertGreater(widths[0], widths[1])
        self.assertGreater(widths[1], widths[2])

    def test_bad_flags_and_files_end_in_one_line_and_leave_results_alone(self):
        def state():
            return {file: (file.stat().st_mtime_ns, file.stat().st_ino) for file in self.out.rglob("*")}

        before = state()
        broken = Path(self.folder.name) / "broken.obj"
        broken.write_text("f 1 2 3\n")
        for words in (["--size"], ["soft"], ["--full", "--tiny"], ["--model"], ["--model", "absent.ply"],
                      ["--model", broken], ["--model", self.folder.name], ["--out", broken, "bounds"]):
            ended = run(DEMO, *words, *([] if "--out" in words else ["--out", self.out]))
            self.assertEqual((ended.returncode, ended.stdout, ended.stderr.count("\n")), (2, "", 1), (words, ended.stderr))
            self.assertEqual(state(), before, words)

    def test_a_model_is_shaded(self):
        cube = Path(self.folder.name) / "cube.obj"
        corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        faces = ("1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4")
        cube.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join(f"f {f}\n" for f in faces))
        with tempfile.TemporaryDirectory() as out:
            self.assertEqual(run(DEMO, "--tiny", "--out", out, "--model", cube).returncode, 0)
            self.assertEqual(run(sys.executable, MAKE_GALLERY, "--out", out).returncode, 0)
            report = json.loads((Path(out) / "report.json").read_text())
            self.assertTrue(all(row["rmse"] < 0.5 for row in report))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
