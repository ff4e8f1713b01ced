#!/usr/bin/env python3
"""Runs the driver motion_layered at its smallest and checks what it leaves: motion_layered_test.py GNOMON_DEMO MAKE_GALLERY"""

import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

DEMO, MAKE_GALLERY = sys.argv[1:3]
MODELS = Path(__file__).parent / "models"
FIGURES = "pillars", "crossed_quads", "toward_and_away"
FAMILIES = {"exact_visibility", "accumulation", "time_slices", "deep", "layers", "footprints", "resolved_ranges"}
EXACT, LAYERS = "exact_visibility", "layered_variance"


class MotionLayered(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name)
        for command in ([DEMO, "motion_layered", "--tiny", "--out", cls.out], [sys.executable, MAKE_GALLERY, "--out", cls.out]):
            ended = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
            if ended.returncode:
                raise RuntimeError(ended.stderr)
        cls.report = json.loads((cls.out / "report.json").read_text())
        cls.facts = json.loads((cls.out / "gallery" / "motion_layered" / "facts.json").read_text())
        cls.scenes = {row["scene"] for row in cls.report}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def rows(self, scene, method, part="", biased=False):
        return [row for row in self.report if (row["scene"], row["method"], row["part"]) == (scene, method, part) and
                ("bias" in row["parameters"]) == biased]

    def usual(self, scene, method):
        return self.rows(scene, method)[0]

    def block(self, kind, title):
        found, = (block for block in self.facts["blocks"] if block["type"] == kind and block.get("title") == title)
        return found

    def test_every_scene_has_every_family(self):
        self.assertGreaterEqual(self.scenes, {*FIGURES, "lit_ramp", "random_cubes", "tentacles", "wrecking_ball", "chess",
                                              "tree_in_moving_light", "runner", "walker"})
        for scene in self.scenes:
            self.assertGreaterEqual({row["family"] for row in self.report if row["scene"] == scene}, FAMILIES, scene)
        for row in self.report:
            self.assertIn("reference_times", row["parameters"])
            self.assertEqual(row["reference"], "traced")

    def test_what_is_exact_has_the_camera_s_noise_alone(self):
        for scene in self.scenes - {"lit_ramp"}:
            row = self.usual(scene, EXACT)
            self.assertLess(row["noise_beyond_camera"], 1e-6, scene)
            self.assertEqual(row["noise_of_map"], 0, scene)
            self.assertGreater(row["noise"], 0.02, scene)
            self.assertLess(row["bias"], 0.5 * row["rmse"], scene)

    def test_layers_have_less_noise_than_slices(self):
        for scene in FIGURES:
            layers = self.usual(scene, LAYERS)
            for slices in ("time_slices", "time_slices_sloped"):
                for noise in ("noise", "noise_of_map", "noise_beyond_exact"):
                    self.assertLess(layers[noise], 0.8 * self.usual(scene, slices)[noise], (scene, slices, noise))

    def test_layers_have_a_part_of_the_map_s_noise_of_slices(self):
        for scene, part in zip(FIGURES, (1 / 2, 1 / 3, 1 / 3)):  # a third of larger maps of pillars, too
            slices = min((rows[0] for rows in (self.rows(scene, f"time_slices{kind}") for kind in ("", "_motion", "_sloped"))),
                         key=lambda row: row["rmse"])
            self.assertLess(self.usual(scene, LAYERS)["noise_of_map"], part * slices["noise_of_map"], scene)

    def test_footprints_have_no_noise_of_the_map(self):
        for scene in FIGURES:
            row = self.usual(scene, "range_footprints")
            self.assertEqual(row["noise_of_map"], 0, scene)
            self.assertLess(row["noise_beyond_exact"], 0.1 * self.usual(scene, EXACT)["noise"], scene)
            self.assertLess(row["noise"], 0.6 * self.usual(scene, EXACT)["noise"], scene)

    def test_the_lit_ramp_is_lit_where_the_bias_follows_its_motion(self):
        self.assertEqual(self.usual("lit_ramp", "time_slices_sloped")["acne"], 0)
        for short, least in (("time_slices", 0.2), ("time_slices_motion", 0.01)):
            self.assertGreater(self.usual("lit_ramp", short)["acne"], least, short)
        self.assertLess(self.usual("lit_ramp", LAYERS)["acne"], 0.02)

    def test_deep_maps_smear_what_the_light_sees_move(self):
        deep, layers = (self.usual("pillars", method)["rmse"] for method in ("deep_ranges", LAYERS))
        self.assertGreater(deep, 1.5 * layers)

    def test_the_best_constant_is_better(self):
        for row in self.report:
            if "bias" not in row["parameters"]:
                continue
            plain = dict(row["parameters"])
            del plain["bias"]
            other, = (one for one in self.rows(row["scene"], row["method"]) if one["parameters"] == plain)
            self.assertLess(row["rmse"], 1.05 * other["rmse"], row["label"])

    def test_steps_add_up(self):
        for row in self.report:
            if row["part"]:
                continue
            self.assertAlmostEqual(row["build_ms"], row["sampling_ms"] + row["conversion_ms"], 6)
            for step in ("sampling", "conversion", "camera", "look_up", "shading"):
                self.assertTrue(math.isfinite(row[f"{step}_ms"]) and row[f"{step}_ms"] >= 0, row["label"])

    def test_goals_are_told(self):
        goals = self.block("table", "Goals")["rows"]
        self.assertGreaterEqual(len(goals), 6)
        self.assertEqual(sum(row["goal"].startswith("noise of the map") for row in goals), len(FIGURES))
        self.assertTrue({"yes"} <= {row["met"] for row in goals} <= {"yes", "no"})

    def test_fewer_layers_take_less_memory(self):
        sizes = {row["parameters"].get("layers", 4): row["map_bytes"] for row in self.rows("tentacles_from_above", LAYERS)
                 if set(row["parameters"]) <= {"layers", "camera_samples", "reference_times"}}
        self.assertEqual(sorted(sizes), [1, 2, 3, 4])
        self.assertEqual([sizes[n] for n in sorted(sizes)], sorted(sizes.values()))

    def setting(self, scene, **parameters):
        found, = (row for row in self.rows(scene, LAYERS) if all(row["parameters"].get(name) == value for name, value in parameters.items()))
        return found

    def test_layers_of_ranges_are_no_worse_than_those_of_samples(self):
        exact, random = (self.usual("tentacles_from_above", method)["rmse"] for method in ("layered_ranges", LAYERS))
        self.assertLess(exact, 1.1 * random)

    def test_division_by_motion_pays_where_layers_are_few(self):
        one, divided = (self.setting("tentacles_from_above", layers=1, **more) for more in ({"division": None}, {"division": 8}))
        self.assertLess(divided["rmse"], 0.9 * one["rmse"])
        self.assertLess(divided["map_bytes"], self.usual("tentacles_from_above", LAYERS)["map_bytes"])
        self.assertLess(self.setting("random_cubes", division=8)["rmse"], 1.01 * self.usual("random_cubes", LAYERS)["rmse"])

    def test_even_weights_and_even_times_change_little_in_pictures(self):
        usual = self.usual("tentacles_from_above", LAYERS)["rmse"]
        for setting in ({"even": 0}, {"even_times": 1}):
            self.assertLess(abs(self.setting("tentacles_from_above", **setting)["rmse"] / usual - 1), 0.03, setting)

    def test_a_crown_in_a_moving_light_leaks_by_the_bias_and_by_long_texels(self):
        usual = self.usual("tree_in_moving_light", LAYERS)
        biased, fine = (self.setting("tree_in_moving_light", **setting) for setting in ({"limit": 0.25}, {"texels": 16}))
        self.assertGreater(usual["leak"], 2 * usual["acne"])
        for error in "rmse", "leak":
            self.assertGreater(biased[error], 1.2 * usual[error])
            self.assertLess(fine[error], 0.97 * usual[error])

    def test_one_scene_has_sweeps_of_samples_and_of_maps(self):
        def values(method, name, usual):
            return {row["parameters"].get(name, usual) for row in self.rows("tentacles_from_above", method)}

        for slices in ("time_slices", "time_slices_sloped"):
            self.assertGreaterEqual(values(slices, "samples", 4), {4, 8, 16, 20, 32})
        self.assertIn(128, values("deep_samples", "samples", 0))
        for method in ("time_slices_sloped", LAYERS):
            self.assertGreaterEqual(values(method, "scale", 1), {0.5, 1, 2})
        settings = [tuple(row["parameters"].get(name, usual) for name, usual in
                          (("scale", 1), ("tile", 4), ("guard", 12), ("texels", 8), ("layers", 4)))
                    for row in self.rows("tentacles_from_above", LAYERS)]
        for paper_s_or_fast in ((1, 4, 12, 8, 4), (2, 8, 16, 16, 4), (1, 8, 16, 8, 2)):
            self.assertIn(paper_s_or_fast, settings)

    def test_a_model_stands_in_for_the_scenes(self):
        with tempfile.TemporaryDirectory() as folder:
            ended = subprocess.run([DEMO, "motion_layered", "--tiny", "--out", folder, "--model", MODELS / "walker.gltf"],
                                   capture_output=True, text=True, check=False)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            report = json.loads((Path(folder) / "report.json").read_text())
            self.assertEqual({row["scene"] for row in report}, {"model"})
            self.assertGreaterEqual({row["family"] for row in report}, FAMILIES)
            self.assertEqual([path.name for path in (Path(folder) / "gallery").iterdir()], ["layered_model"])
            facts = json.loads((Path(folder) / "gallery" / "layered_model" / "facts.json").read_text())
            self.assertIn("moved by its first animation. The shutter opens 0 s", json.dumps(facts))

    def test_the_model_is_what_its_program_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            again = Path(folder) / "walker.gltf"
            subprocess.run([sys.executable, MODELS / "walker.py", again], check=True)
            self.assertEqual(json.loads(again.read_text()), json.loads((MODELS / "walker.gltf").read_text()))

    def test_layers_flicker_less_than_slices(self):
        changes = {row["method"]: row for row in self.report if row["part"] == "change"}
        self.assertLess(changes[LAYERS]["rmse"], 0.8 * changes["time_slices_sloped"]["rmse"])
        self.assertLess(changes["range_footprints"]["rmse"], changes[LAYERS]["rmse"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
