#!/usr/bin/env python3
"""Runs the driver soft_shadows at its smallest and checks what it leaves: soft_shadows_test.py GNOMON_DEMO MAKE_GALLERY"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

DEMO, MAKE_GALLERY = sys.argv[1:3]
SCENES = {"long_range": {"sign", "cables", "bench"}, "models": {"contact", "far"}, "pillar": {"alone", "both"},
          "grazing": {"penumbra", "contact"}}


class SoftShadows(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name)
        for command in ([DEMO, "soft_shadows", "--tiny", "--out", cls.out], [sys.executable, MAKE_GALLERY, "--out", cls.out]):
            ended = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
            if ended.returncode:
                raise RuntimeError(ended.stderr)
        cls.report = json.loads((cls.out / "report.json").read_text())
        cls.facts = json.loads((cls.out / "gallery" / "soft_shadows" / "facts.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def row(self, scene, method, reference="traced", part=""):
        row, = (row for row in self.report if row["lanes"] == 1 and
                (row["scene"], row["part"], row["method"], row["reference"]) == (scene, part, method, reference))
        return row

    def test_every_method_has_a_row_in_every_part_for_every_reference(self):
        methods = {row["method"] for row in self.report}
        self.assertGreaterEqual(len(methods), 11)
        expected = {(scene, part, method, reference) for scene, parts in SCENES.items() for part in parts | {""}
                    for method in methods for reference in ("filtered", "traced")}
        self.assertEqual({(r["scene"], r["part"], r["method"], r["reference"]) for r in self.report}, expected)

    def test_a_small_search_makes_long_range_shadows_too_hard(self):
        errors = [self.row("long_range", f"pcss_{search}", part="sign")["rmse"] for search in (9, 15, 27)]
        self.assertGreater(errors[0], errors[1])
        self.assertGreater(errors[1], errors[2])

    def test_moments_are_as_good_as_percentage_closer_soft_shadows(self):
        for scene in SCENES:
            self.assertLess(self.row(scene, "msm4_soft")["rmse"], 1.5 * self.row(scene, "pcss_27")["rmse"], scene)

    def test_the_default_leaks_no_more_than_the_bias_of_the_paper(self):
        ours, paper = ([self.row(scene, method, "filtered")["leak"] for scene in SCENES]
                       for method in ("msm4_soft", "msm4_soft_paper"))
        self.assertLessEqual(sum(ours), sum(paper))
        for scene, one, other in zip(SCENES, ours, paper):
            self.assertLess(one, 1.02 * other, scene)  # the search has the bias, too, which moves blockers on steep ground

    def test_two_moments_leak_more_than_four_and_six_leak_less(self):
        for scene in ("long_range", "models"):
            self.assertGreater(self.row(scene, "vssm", "filtered")["leak"],
                               1.5 * self.row(scene, "msm4_soft", "filtered")["leak"], scene)
        self.assertLess(self.row("models", "msm6_soft")["leak"], 0.9 * self.row("models", "msm4_soft")["leak"])

    def test_interpolation_darkens_less_than_the_grid_and_than_dithering(self):
        for scene in SCENES:
            for other in ("msm4_soft_snapped", "msm4_soft_dithered"):
                self.assertLess(1.2 * self.row(scene, "msm4_soft", "filtered")["acne"], self.row(scene, other, "filtered")["acne"],
                                (scene, other))

    def test_a_bias_that_follows_the_plane_keeps_grazing_ground_lit(self):
        for method in ("msm4_soft", "pcss_27"):
            biased, unbiased = (self.row("grazing", method, "filtered")[name] for name in ("acne", "acne_unbiased"))
            self.assertLess(biased, 0.5 * max(unbiased, 1e-3), method)

    def test_costs_have_a_line_for_each_kind_of_map(self):
        charts = {block["name"]: block for block in self.facts["blocks"] if block["type"] == "chart"}
        texels, memory = charts["cost-per-texel"]["panels"]
        for panel in (texels, memory):
            for one in panel["series"]:
                self.assertEqual([x for x, _ in one["points"]], [256, 512, 1024, 2048, 4096], one["label"])
                values = [y for _, y in one["points"]]
                self.assertEqual(values, sorted(values), one["label"])
        receivers, = charts["cost-per-receiver"]["panels"]
        times = {one["label"]: [y for _, y in one["points"]] for one in receivers["series"]}
        self.assertGreater(times["PCSS"][-1], 8 * times["PCSS"][0])
        self.assertLess(times["MSM soft, 4 moments"][2], times["PCSS"][1])  # 27 x 27 against 15 x 15
        for label, values in times.items():
            if label != "PCSS":  # flat in the search: the light grows with it, so fewer receivers are lit
                self.assertLess(max(values), 3 * min(values), label)
                self.assertLess(values[-1], 0.2 * times["PCSS"][-1], label)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
