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
        self.assertGreaterEqual(len(methods), 11)
        for scene, parts in SCENES.items():
            of_scene = {method for other, part, method in rows if (other, part) == (scene, "")}
            for part in parts:
                self.assertEqual({m for other, p, m in rows if (other, p) == (scene, part)}, of_scene, (scene, part))

    def test_six_moments_are_better_than_four(self):
        for scene in SCENES.keys() - {"antipode"}:
            for setting in ("unorm16_paper", "unorm16_paper_filtered", "unorm16", "float"):
                self.assertLess(self.row(scene, f"scatter6_{setting}")["rmse"],
                                self.row(scene, f"scatter4_{setting}")["rmse"], (scene, setting))


    def test_more_steps_are_better_and_16_bits_enough(self):
        for scene in SCENES:
            errors = [self.row(scene, f"ray_march_{steps}")["rmse"] for steps in (16, 32, 128, 1024)]
            self.assertEqual(errors, sorted(errors, reverse=True), scene)
            for steps, error in ((32, errors[1]), (128, errors[2])):
                coarse = self.row(scene, f"ray_march_{steps}_unorm16")["rmse"]
                self.assertLess(abs(coarse - error), 0.1 * error, (scene, steps))

    def test_exact_counts_are_better_than_moments(self):
        for scene in SCENES.keys() - {"antipode"}:
            exact = self.row(scene, "min_max")["rmse"]
            for other in ("scatter6_float", "scatter4_float"):
                self.assertLess(exact, self.row(scene, other)["rmse"], (scene, other))

    def test_costs_are_of_all_sizes(self):
        charts = {block["name"]: block for block in self.facts["blocks"] if "panels" in block and "name" in block}
        for name, panels, points in (("cost-per-picture", 2, 5), ("cost-per-map", 4, 4), ("error-per-cost", 1, 1)):
            self.assertEqual(len(charts[name]["panels"]), panels)
            for panel in charts[name]["panels"]:
                for series in panel["series"]:
                    self.assertEqual(len(series["points"]), points, (name, series["label"]))
                    self.assertTrue(all(number > 0 for point in series["points"] for number in point))
        table, = (block for block in self.facts["blocks"] if block.get("title", "").startswith("How much cheaper"))
        froxels, = (row for row in table["rows"] if row["method"] == "froxels")
        self.assertGreater(froxels["look_up"], 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
