#!/usr/bin/env python3
"""Runs the driver single_scattering at its smallest and checks the results: single_scattering_test.py GNOMON_DEMO MAKE_GALLERY"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

DEMO, MAKE_GALLERY = sys.argv[1:3]
SCENES = {"room": {"opening", "leak", "shaft"}, "trees": {"crown", "ground"}, "gate": {"bars"},
          "entering": {"above", "below"}, "tower": {"epipole"}, "antipode": {"antipode"}}


class SingleScattering(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name)
        for command in ([DEMO, "single_scattering", "--tiny", "--out", cls.out],
                        [sys.executable, MAKE_GALLERY, "--out", cls.out]):
            ended = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
            if ended.returncode:
                raise RuntimeError(ended.stderr)
        cls.report = json.loads((cls.out / "report.json").read_text())
        cls.facts = json.loads((cls.out / "gallery" / "single_scattering" / "facts.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def row(self, scene, method, reference="traced", part=""):
        row, = (row for row in self.report if row["lanes"] == 1 and
                (row["scene"], row["part"], row["method"], row["reference"]) == (scene, part, method, reference))
        return row

    def test_every_method_has_a_row_in_every_part_of_every_scene(self):
        rows = {(row["scene"], row["part"], row["method"]) for row in self.report if row["reference"] == "traced"}
        methods = {method for scene, part, method in rows if (scene, part) == ("room", "")}
        self.assertGreaterEqual(len(methods), 20)
        for scene, parts in SCENES.items():
            of_scene = {method for other, part, method in rows if (other, part) == (scene, "")}
            for part in parts:
                self.assertEqual({m for other, p, m in rows if (other, p) == (scene, part)}, of_scene, (scene, part))

    def test_six_moments_are_better_than_four(self):
        for scene in SCENES.keys() - {"antipode"}:
            for setting in ("unorm16_paper", "unorm16_paper_filtered", "unorm16", "float"):
                self.assertLess(self.row(scene, f"scatter6_{setting}")["rmse"],
                                self.row(scene, f"scatter4_{setting}")["rmse"], (scene, setting))

    def test_more_bits_are_better(self):
        for scene in ("room", "entering", "tower"):
            self.assertLess(self.row(scene, "scatter6_float")["rmse"], self.row(scene, "scatter6_unorm10")["rmse"], scene)

    def test_depth_and_rows_of_the_default_are_better_than_those_of_the_paper(self):
        for scene in ("trees", "gate", "entering", "tower"):
            for method in ("scatter4_unorm16", "scatter6_unorm16"):
                self.assertLess(self.row(scene, method)["rmse"], self.row(scene, f"{method}_paper")["rmse"], (scene, method))

    def test_filtering_at_least_halves_flicker(self):
        def flicker(method):
            return self.row("gate", method, part="change")["leak"]

        for method in ("scatter4_unorm16", "scatter6_unorm16"):
            self.assertLess(2 * flicker(method), flicker(f"{method}_texel"), method)
            self.assertLess(2 * flicker(f"{method}_moments"), flicker(f"{method}_texel"), method)
            self.assertLess(2 * flicker(f"{method}_paper_filtered"), flicker(f"{method}_paper"), method)

    def test_no_light_is_seen_through_the_tower(self):
        half, most, adaptive, usual = (self.row("tower", f"scatter4_unorm16{name}", part="epipole")["leak"]
                                       for name in ("_half", "_most", "_paper", ""))
        for leaking in (half, most):
            self.assertLess(adaptive, 0.7 * leaking)
            self.assertLess(usual, 0.7 * leaking)

    def test_height_fog_has_rows_with_weights_of_the_fog_and_of_even_air(self):
        rows = {(row["part"], row["parameters"]["falloff"], row["parameters"]["falloff_of_rows"]): row["rmse"]
                for row in self.report if row["scene"] == "height_fog"}
        self.assertEqual({part for part, _, _ in rows}, {"room", "trees"})
        for part, falloff, of_rows in rows:
            self.assertIn(of_rows, (0, falloff))
            self.assertNotEqual(rows[part, falloff, 0], rows[part, falloff, falloff])

    def test_translucent_surfaces_have_errors_like_those_of_opaque_ones(self):
        for method in ("scatter4_unorm16", "scatter6_unorm16"):
            opaque, layers = (self.row("veils", method, part=part)["rmse"] for part in ("opaque", "layers"))
            self.assertLess(layers, 1.5 * opaque, method)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
