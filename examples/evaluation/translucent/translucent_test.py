#!/usr/bin/env python3
"""Runs the driver of translucent occluders at its smallest and checks what it leaves: translucent_test.py GNOMON_DEMO
MAKE_GALLERY"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import matplotlib.image

DEMO, MAKE_GALLERY = sys.argv[1:3]
PAPER, MIDDLE, DIVIDED, TESTED = {}, {"overestimation": 0.5}, {"strength": 0.95}, {"least_alpha": 0.01}
MOMENTS = "msm4_unorm16_paper_blended"
EXPONENTIAL = "evsm_half_blended", "evsm_float_blended"
HONEST = {"msm4_unorm16_blended": 2e-5, "msm4_half_blended": 2e-5, "msm4_float_blended": 2e-5,
          "msm6_unorm10_blended": 0.29, "msm6_unorm16_blended": 8.1e-3}  # stated weights; of certificates, arithmetic
PARTS = {"", "surfaces", "behind", "pipes", "pane", "smoke", "inset_pipe", "inset_silhouette", "inset_smoke", "inset_glass"}


class Translucent(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        out = Path(cls.folder.name)
        for command in ([DEMO, "translucent", "--tiny", "--out", out], [sys.executable, MAKE_GALLERY, "--out", out]):
            ended = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
            if ended.returncode:
                raise RuntimeError(ended.stderr)
        cls.report = json.loads((out / "report.json").read_text())
        cls.pictures = out / "gallery" / "translucent"
        cls.facts = json.loads((cls.pictures / "facts.json").read_text())
        cls.methods = {row["method"] for row in cls.report}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def row(self, method, part, parameters=PAPER, reference="filtered", scene="translucent"):
        row, = (row for row in self.report if row["lanes"] == 1 and row["parameters"] == parameters and
                (row["scene"], row["part"], row["method"], row["reference"]) == (scene, part, method, reference))
        return row

    def error(self, name, *which):
        return self.row(*which)[name]

    def test_the_order_of_the_paper(self):
        for part in ("smoke", "pipes"):
            moments = self.error("leak", MOMENTS, part)
            for other in EXPONENTIAL:
                self.assertLess(moments, self.error("leak", other, part), part)
                self.assertLess(self.error("leak", other, part), self.error("leak", "vsm_unorm16_blended", part), part)

    def test_division_hides_leaks_on_surfaces(self):
        for method in self.methods - {"pcf_stochastic"}:
            for part in ("surfaces", "inset_pipe"):
                self.assertLess(self.error("leak", method, part, DIVIDED), self.error("leak", method, part), method)
        self.assertLess(self.error("leak", MOMENTS, "behind", DIVIDED), 0.9 * self.error("leak", MOMENTS, "behind"))

    def test_the_middle_of_the_bounds_suits_smoke(self):
        for method in self.methods - {"pcf_stochastic"}:
            lower, middle = (self.error("rmse", method, "smoke", shown) for shown in (PAPER, MIDDLE))
            self.assertLess(2 * middle, lower, method)
            # Surfaces show the lower bound either way.
            self.assertEqual(self.error("rmse", method, "surfaces", MIDDLE), self.error("rmse", method, "surfaces"))

    def test_no_surface_is_darker_than_stated(self):
        for method, weight in HONEST.items():
            for part in ("surfaces", "smoke"):
                self.assertLess(self.error("max_dark", method, part), weight, method)

    def test_what_mends(self):
        smoke = {method: self.error("rmse", method, "smoke") for method in self.methods}
        self.assertLess(smoke["msm4_float_blended"], smoke[MOMENTS])
        self.assertLess(smoke["msm6_float_blended"], 0.95 * smoke[MOMENTS])
        self.assertLess(smoke["absorbance4_float"], 0.9 * smoke[MOMENTS])
        self.assertLess(self.error("leak", "absorbance4_float", "behind"), 0.5 * self.error("leak", MOMENTS, "behind"))
        # Allowing for all roundings costs leaks, the fewer bits the more.
        self.assertLess(smoke["msm4_float_blended"], smoke["msm4_unorm16_blended"])
        self.assertLess(smoke["msm4_unorm16_blended"], smoke["msm4_half_blended"])

    def test_an_alpha_test_leaves_fewer_roundings(self):
        for method in ("msm4_unorm16_blended", "msm4_half_blended", "msm6_unorm10_blended"):
            self.assertLess(self.error("rmse", method, "smoke", TESTED), self.error("rmse", method, "smoke") + 2e-3, method)

    def test_chance_has_noise_and_hardly_a_bias(self):
        for method in ("pcf_stochastic", "msm4_unorm16_stochastic"):
            row = self.row(method, "smoke")
            self.assertEqual(row["seeds"], 4)
            self.assertGreater(row["noise"], 1e-3)
            self.assertLess(row["noise"], 0.1)
        self.assertLess(abs(self.error("bias", "pcf_stochastic", "")), 2e-3)

    def test_every_method_has_a_row_for_each_part_way_and_reference(self):
        self.assertEqual(len(self.methods), 15)
        found = {(row["method"], row["part"], row["reference"], json.dumps(row["parameters"])) for row in self.report
                 if row["scene"] == "translucent" and row["lanes"] == 1 and "least_alpha" not in row["parameters"]}
        both = {**MIDDLE, **DIVIDED}
        expected = {(method, part, reference, json.dumps(shown)) for method in self.methods for part in PARTS
                    for reference in ("filtered", "traced") for shown in (PAPER, DIVIDED, MIDDLE, both)
                    if method != "pcf_stochastic" or "overestimation" not in shown}
        self.assertEqual(found, expected)
        close_up = {row["method"] for row in self.report if row["scene"] == "smoke_close_up"}
        self.assertEqual(close_up, self.methods)

    def test_glass_colours_its_shadow_where_a_method_knows_colours(self):
        def colourful(name):
            picture = matplotlib.image.imread(self.pictures / name)[..., :3]
            inset = picture[-12 * 4:, -12 * 4:]  # of the glass, magnified, last of four
            return (inset.max(-1) - inset.min(-1)).mean()

        grey = colourful("msm4_unorm16_blended-lower.png")
        for name in ("traced", "filtered", "msm4_unorm16_coloured-lower", "absorbance4_float_coloured-lower"):
            self.assertGreater(colourful(name + ".png"), 1.1 * grey, name)

    def test_every_picture_is_shown_and_none_is_empty(self):
        shown = {picture["file"] for block in self.facts["blocks"] for picture in block.get("pictures", [])}
        left = {file.name for file in self.pictures.glob("*.png") if not file.name.startswith("speed")}
        self.assertEqual(shown, left)
        for file in left:
            if not file.endswith("-error.png"):
                self.assertGreater(matplotlib.image.imread(self.pictures / file)[..., :3].std(), 0.01, file)

    def test_the_page_tells_costs_with_and_without_fragments(self):
        table, = (block for block in self.facts["blocks"] if block.get("title") == "What it costs")
        self.assertEqual(len(table["rows"]), len(self.methods))
        for row in table["rows"]:
            self.assertGreater(row["build"], 0)
            self.assertGreater(row["opaque"], 0)
            self.assertAlmostEqual(row["ratio"], row["build"] / row["opaque"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
