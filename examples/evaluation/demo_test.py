#!/usr/bin/env python3
"""Runs the demo at its smallest and checks what it leaves: demo_test.py GNOMON_DEMO MAKE_GALLERY"""

import base64
import json
import re
import struct
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import matplotlib.image

DEMO, MAKE_GALLERY = sys.argv[1:3]
IDENTITY = ("scene", "part", "method", "family", "map", "receiver", "format", "parameters", "reference", "real", "lanes",
            "threads", "device")
ANALYTIC = "resolved_ranges", "analytic"


def run(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)


def moving_cube(file):
    """Writes a glTF whose animation "slide" takes a cube one side along x within a second."""
    corners = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    indices = [q[i] for q in quads for i in (0, 1, 2, 0, 2, 3)]
    parts = [struct.pack("<24f", *(v for corner in corners for v in corner)), struct.pack("<36H", *indices),
             struct.pack("<2f", 0, 1), struct.pack("<6f", 0, 0, 0, 1, 0, 0)]
    starts = [sum(map(len, parts[:i])) for i in range(len(parts))]
    float_, short = 5126, 5123
    accessors = ((float_, 8, "VEC3", [0, 0, 0], [1, 1, 1]), (short, 36, "SCALAR", [0], [7]),
                 (float_, 2, "SCALAR", [0], [1]), (float_, 2, "VEC3", [0, 0, 0], [1, 0, 0]))
    data = b"".join(parts)
    file.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "animations": [{"name": "slide", "samplers": [{"input": 2, "output": 3, "interpolation": "LINEAR"}],
                        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
        "accessors": [{"bufferView": i, "componentType": kind, "count": count, "type": shape, "min": low, "max": high}
                      for i, (kind, count, shape, low, high) in enumerate(accessors)],
        "bufferViews": [{"buffer": 0, "byteOffset": start, "byteLength": len(part)} for start, part in zip(starts, parts)],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}))


class Links(HTMLParser):
    def __init__(self):
        super().__init__()
        self.targets = set()

    def handle_starttag(self, tag, attrs):
        self.targets |= {value for name, value in attrs if name in ("src", "href") or (tag, name) == ("option", "value")}


def weights(steps):
    """Depths and weights of a distribution function; its first and last points bound the chart."""
    return [(z, after - before) for (_, before), (z, after) in zip(steps[:-2], steps[1:-1])]


class Demo(unittest.TestCase):
    progress = ""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name) / "out"
        for command in ([DEMO, "--tiny", "--out", cls.out], [sys.executable, MAKE_GALLERY, "--out", cls.out]):
            ended = run(*command)
            if ended.returncode:
                raise RuntimeError(ended.stderr)
            cls.progress = cls.progress or ended.stderr
        cls.report = json.loads((cls.out / "report.json").read_text())
        cls.registry = json.loads(run(DEMO, "--registry").stdout)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def facts(self, driver):
        return json.loads((self.out / "gallery" / driver / "facts.json").read_text())

    def error(self, method, name, part="", reference="filtered", scene="fence"):
        row, = (row for row in self.report if row["lanes"] == 1 and
                (row["scene"], row["part"], row["method"], row["reference"]) == (scene, part, method, reference))
        return row[name]

    def motion(self, scene, method, receiver, name="rmse", reference="traced", **parameters):
        row, = (row for row in self.report if row["part"] == "" and row["parameters"] == parameters and
                (row["scene"], row["method"], row["receiver"], row["reference"]) == (scene, method, receiver, reference))
        return row[name]

    def accumulation(self, scene, times, **more):
        return self.motion(scene, "accumulation", "at_times_of_maps", times=times, **more)

    def tables(self, driver):
        return {block.get("title", ""): block["rows"] for block in self.facts(driver)["blocks"] if block["type"] == "table"}

    def less(self, better, worse, name="leak", part=""):
        self.assertLess(self.error(better, name, part), self.error(worse, name, part))

    def test_moments_leak_less_than_exponential_variance_at_64_bits(self):
        # The paper's bias leaks less than the certificate here, but does not allow for what two passes round.
        self.less("msm4_unorm16_paper", "evsm_half")
        self.less("msm4_unorm16", "evsm_half")

    def test_signed_depth_leaks_less_than_depth_from_0_to_1(self):
        self.less("msm4_float_paper", "msm4_float_unit")
        self.less("msm4_float", "msm4_float_paper")

    def test_six_moments_leak_less_than_four_where_three_surfaces_meet(self):
        self.less("msm6_float", "msm4_float", part="sign_fence_wall")

    def test_more_moments_and_more_bits_are_better(self):
        self.less("msm4_float", "vsm_unorm16", "rmse")
        self.less("msm6_float", "msm6_unorm16", "rmse")
        self.less("msm6_unorm16", "msm6_unorm10", "rmse")

    def test_percentage_closer_filtering_is_its_own_reference(self):
        # Some hundred float weights, each rounded to 2^-24 of at most 1 when it is added up.
        self.assertLess(self.error("pcf", "max_abs"), 1e3 * 2**-24)

    def test_lower_bounds_show_no_acne(self):
        # An intensity may exceed the bound by what rounding to the format can do; 1e-3 is visible to nobody.
        for method in ("vsm_unorm16", "lvsm_unorm16", "esm_float", "evsm_float", "msm4_unorm16", "msm4_float", "msm6_float"):
            self.assertLess(self.error(method, "acne"), 1e-3, method)

    def test_certified_bounds_never_darken_where_raised_pivots_do(self):
        raised = "msm4_unorm16_raised"
        self.assertGreater(self.error(raised, "max_dark", scene="contact"), 0.05)
        self.assertGreater(self.error(raised, "darkened", scene="contact"), 0)
        for method in ("msm4_unorm16", "msm4_half", "msm4_float"):
            for scene in ("fence", "contact"):
                self.assertLess(self.error(method, "max_dark", scene=scene), 1e-5, method)
                self.assertLess(self.error(method, "acne_unbiased", scene=scene), 1e-5, method)

    def test_every_scene_in_motion_has_a_row_for_every_method(self):
        def identity(row):
            return row["method"], row["receiver"], row["map"], row["format"], tuple(sorted(row["parameters"].items()))

        whole = [row for row in self.report if row["part"] == "" and row["receiver"] != "camera_samples"]
        moving = {row["scene"] for row in whole if row["receiver"] == "analytic"}
        traced = [row for row in whole if row["scene"] in moving and row["reference"] == "traced"]
        scenes = {scene: {identity(row) for row in traced if row["scene"] == scene} for scene in moving}
        self.assertGreaterEqual(scenes.keys(), {"crossed_quads", "random_cubes", "lit_ramp", "trapezoid"})
        common = set.intersection(*scenes.values())
        self.assertEqual(len(common), 18)
        self.assertEqual(sum(found == common for found in scenes.values()), len(scenes) - 2)  # two have ids of surfaces
        self.assertTrue(all(row["rmse"] <= 1 for row in traced))

    def test_integrals_over_time_beat_means_over_maps(self):
        for scene in ("crossed_quads", "toward_and_away", "fan", "trapezoid"):
            self.assertLess(self.motion(scene, *ANALYTIC), self.accumulation(scene, 16), scene)

    def test_more_maps_are_better(self):
        for scene in ("crossed_quads", "trapezoid"):
            self.assertLess(self.accumulation(scene, 64), self.accumulation(scene, 8), scene)

    def test_a_ramp_that_moves_towards_the_light_stays_lit(self):
        self.assertLess(self.motion("lit_ramp", *ANALYTIC, "max_abs"), 1e-3)

    def test_lists_never_leak_more_for_their_capacity(self):
        # Merging only makes more of the time dark; 1e-5 is what the sums of some hundred spans can be rounded by.
        for scene in ("random_cubes", "fan"):
            self.assertLess(self.motion(scene, "interval_lists", "analytic", "leak", capacity=4),
                            self.motion(scene, *ANALYTIC, "leak") + 1e-5, scene)

    def test_ids_of_surfaces_spare_short_lists_from_shadowing_themselves(self):
        for capacity in (4, 8):
            lists = "cubes_to_the_light", "interval_lists", "analytic", "acne"
            self.assertLess(4 * self.motion(*lists, capacity=capacity, surfaces=1), self.motion(*lists, capacity=capacity))
        resolved = "random_cubes", *ANALYTIC, "acne_unbiased"
        self.assertLess(2 * self.motion(*resolved, surfaces=1), self.motion(*resolved))

    def test_a_cover_that_is_read_first_answers_as_the_list(self):
        first, every = (self.motion("random_cubes", method, "stochastic", times=16)
                        for method in ("cover_first_ranges", "exact_ranges"))
        self.assertAlmostEqual(first, every, 5)

    def test_a_wider_filter_is_integrated_better_than_it_is_sampled(self):
        filtered = {"reference": "filtered", "look_ups": 3}
        few, many = (self.accumulation("crossed_quads", times, **filtered) for times in (16, 64))
        self.assertLess(self.motion("crossed_quads", *ANALYTIC, **filtered), many)
        self.assertLess(many, few)

    def test_static_receivers_are_measured_behind_casters_and_among_them(self):
        def error(part, method, speed, **parameters):
            row, = (row for row in self.report if (row["part"], row["method"], row["receiver"]) == (part, method, "analytic")
                    and row["parameters"] == {"cubes": 1600, "speed": speed, **parameters})
            return row["rmse"]

        for speed in (1, 4):
            for part in ("ground", "among"):
                self.assertAlmostEqual(error(part, "packed_caster_ranges", speed, totals=1),
                                       error(part, "caster_ranges", speed, totals=1), 3)
            # Under a tent both count the same times: errors are of the size that they have under a box.
            self.assertLess(error("ground", "resolved_ranges", speed, tent=1), 2 * error("ground", "resolved_ranges", speed))

    def test_meshes_and_curves_have_a_row_per_case(self):
        rows = self.tables("motion_analytic")["Meshes that people have"]
        meshes = {row["mesh"] for row in rows}
        self.assertGreaterEqual(meshes, {"400 random cubes", "waving sheet"})
        self.assertEqual(len({(row["mesh"], row["method"]) for row in rows}), 4 * len(meshes))
        curves = [block for block in self.facts("motion_analytic")["blocks"] if block.get("name", "").startswith("cubes_")]
        self.assertEqual([len(block["panels"]) for block in curves], [3, 3, 3])
        for block in curves:
            for panel in block["panels"]:
                self.assertGreaterEqual(len([one for one in panel["series"] if one["style"] == "line"]), 8)

    def test_known_answers(self):
        known = {row["scene"]: row["max_abs"] for row in self.report if row["reference"] == "closed-form"}
        self.assertLess(known["trapezoid"], 1e-5)
        self.assertEqual(known["lit_ramp"], 0)

    def test_rows_are_complete(self):
        for row in self.report:
            self.assertGreater(row["receivers"], 0)
            self.assertGreater(row["ns_per_receiver"], 0)
            self.assertEqual(row["bytes_per_texel"] > 0, row["map"] != "", row["method"])  # rays need no map

    def test_rows_are_identified_by_what_the_registry_knows(self):
        known = {kind: {one["id"]: one for one in entries} for kind, entries in self.registry.items()}
        identities = set()
        for row in self.report:
            method = known["methods"][row["method"]]
            self.assertEqual(row["family"], method["family"], row["method"])
            if method["bytes_per_texel"]:  # one map and one format, whatever is measured
                for kind in ("map", "format", "bytes_per_texel"):
                    self.assertEqual(row[kind], method[kind], row["method"])
            elif row["map"]:
                self.assertIn(row["map"], known["maps"])
            for kind in ("family", "scene", "receiver", "reference"):
                self.assertIn(row[kind], known["families" if kind == "family" else kind + "s"])
            self.assertTrue(row["label"])
            self.assertIsInstance(row["parameters"], dict)
            identity = tuple(json.dumps(row[field], sort_keys=True) for field in IDENTITY)
            self.assertNotIn(identity, identities)
            identities.add(identity)

    def test_every_method_has_a_row_in_every_part_for_every_reference(self):
        parts = {"fence": {"", "fence", "fence_wall", "sign_fence_wall"}, "contact": {"", "gap_1", "gap_2", "gap_3"}}
        for scene, expected in parts.items():
            rows = [row for row in self.report if row["scene"] == scene and row["reference"] in ("filtered", "traced")]
            methods = {row["method"] for row in rows}
            self.assertGreaterEqual(len(methods), 17)
            found = {(row["method"], row["part"], row["reference"]) for row in rows}
            self.assertEqual(found, {(m, p, r) for m in methods for p in expected for r in ("filtered", "traced")})

    def test_a_look_up_takes_longer_than_its_kernel(self):
        filterable = {m["id"] for m in self.registry["methods"] if m["map"] == "filtered"}
        rows = [row for row in self.report if row["method"] in filterable and row["reference"] == "filtered"]
        self.assertTrue(rows)
        for row in rows:
            self.assertLess(row["ns_kernel"], row["ns_per_receiver"], row["method"])
            self.assertGreater(row["map_bytes"], row["bytes_per_texel"] * 256**2, row["method"])  # mip levels

    def test_pages_have_texts_for_those_who_cannot_see(self):
        drivers = {driver["id"] for driver in self.registry["drivers"]}
        pages = [json.loads(file.read_text()) for file in (self.out / "gallery").glob("*/facts.json")]
        pages = [page for page in pages if "blocks" in page]
        self.assertGreaterEqual({page["driver"] for page in pages}, {"hard_shadows", "contact", "bounds", "motion_analytic"})
        for page in pages:
            self.assertIn(page["driver"], drivers)
            self.assertTrue(page["title"] and page["summary"] and page["blocks"])
            shown = [(picture["file"], picture["alt"]) for block in page["blocks"] for picture in block.get("pictures", [])]
            if "front" in page:
                shown.append((page["front"]["picture"], page["front"]["alt"]))
            for file, alt in shown:
                self.assertTrue((self.out / "gallery" / page["driver"] / file).exists(), file)
                self.assertGreater(len(alt), 20, file)
            for block in page["blocks"]:
                if block["type"] in ("chart", "map"):
                    self.assertGreater(len(block["alt"]), 20, block["name"])

    def test_every_picture_of_a_page_is_shown(self):
        for driver in ("hard_shadows", "contact"):
            shown = {picture["file"] for block in self.facts(driver)["blocks"] for picture in block.get("pictures", [])}
            left = {file.name for file in (self.out / "gallery" / driver).glob("*.png")}
            self.assertLessEqual(shown, left)
            self.assertGreaterEqual(len(shown), 3 * 17 + 2)

    def test_pictures_are_not_empty(self):
        files = sorted((self.out / "gallery").rglob("*.png"))
        self.assertGreater(len(files), 40)
        for file in files:
            if file.name == "pcf-filtered.png" or file.name.endswith(("-difference.png", "-error.png")):
                continue  # white: percentage-closer filtering against itself, the CPU against a device, exact methods
            self.assertGreater(matplotlib.image.imread(file)[..., :3].std(), 0.01, file)

    def test_pages_link_to_what_is_there_and_to_nothing_outside(self):
        pages = sorted((self.out / "gallery").rglob("*.html"))
        self.assertGreater(len(pages), 1)
        for page in pages:
            links = Links()
            links.feed(page.read_text())
            for target in links.targets - {""}:
                self.assertNotIn(":", target)
                if not target.startswith("#"):
                    self.assertTrue((page.parent / unquote(target)).exists(), target)

    def test_bounds_hold(self):
        chart, = (block for block in self.facts("bounds")["blocks"] if block["type"] == "chart")
        widths = []
        for panel, moments in zip(chart["panels"], (2, 4, 6), strict=True):
            band, = (series["points"] for series in panel["series"] if series["style"] == "band")
            *touching, truth = (weights(series["points"]) for series in panel["series"] if series["style"] == "steps")
            self.assertEqual(len(touching), 4)
            for z, lower, upper in band:
                closer = sum(w for depth, w in truth if depth < z)
                self.assertLessEqual(lower, closer + 1e-12)
                self.assertLessEqual(closer, upper + 1e-12)
            widths.append(sum(upper - lower for _, lower, upper in band))
            for distribution in touching:
                for power in range(moments + 1):
                    expected, found = (sum(w * z**power for z, w in d) for d in (truth, distribution))
                    self.assertAlmostEqual(expected, found, 10)
        self.assertGreater(widths[0], widths[1])
        self.assertGreater(widths[1], widths[2])

    def test_bad_flags_and_files_end_in_one_line_and_leave_results_alone(self):
        def state():
            return {file: (file.stat().st_mtime_ns, file.stat().st_ino) for file in self.out.rglob("*")}

        before = state()
        broken = Path(self.folder.name) / "broken.obj"
        broken.write_text("f 1 2 3\n")
        cube = Path(self.folder.name) / "moving cube.gltf"
        moving_cube(cube)
        for words in (["--size"], ["soft"], ["--full", "--tiny"], ["--model"], ["--model", "absent.ply"],
                      ["--model", broken], ["--model", self.folder.name], ["--out", broken, "bounds"],
                      ["--animation", "slide"], ["--shutter", "0,1"], ["--model", cube, "--animation"],
                      ["--model", cube, "--animation", "jump"], ["--model", cube, "--shutter"],
                      ["--model="], ["--model", cube, "--animation=", "--size"],
                      ["--model", cube, "--animation=", "--shutter", "0,9"],
                      *(["--model", cube, "--shutter", times]
                        for times in ("x", "", "0", "0,x", "0,1,2", "1,0", "-1,0", "0,9", "nan,1", "0,inf"))):
            ended = run(DEMO, *words, *([] if "--out" in words else ["--out", self.out]))
            self.assertEqual((ended.returncode, ended.stdout, ended.stderr.count("\n")), (2, "", 1), (words, ended.stderr))
            self.assertEqual(state(), before, words)

    def test_the_help_that_run_reads_is_the_programs(self):
        known = (Path(__file__).parent / "help.txt").read_text()
        self.assertEqual(run(DEMO, "--help").stdout, known, "gnomon_demo --help > examples/evaluation/help.txt")

    def test_progress_says_what_is_left(self):
        steps = re.findall(r"^demo: (\w+): (driver )?(\d+) of (\d+)", self.progress, re.MULTILINE)
        drivers = [(driver, int(k), int(n)) for driver, is_driver, k, n in steps if is_driver]
        self.assertEqual([k for _, k, _ in drivers], list(range(1, drivers[0][2] + 1)))
        for counted in ("hard_shadows", "contact", "stability", "motion_analytic"):
            numbers = [(int(k), int(n)) for driver, is_driver, k, n in steps if driver == counted and not is_driver]
            self.assertGreater(len(numbers), 5)
            self.assertEqual(sorted(numbers), [(k, len(numbers)) for k in range(1, len(numbers) + 1)], counted)

    def test_texts_in_charts_overlap_nothing(self):
        overlaps = Path(__file__).resolve().parents[2] / "tests" / "evaluation" / "gallery" / "overlaps.py"
        ended = run(sys.executable, overlaps, Path(MAKE_GALLERY).parent, self.out)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""), ended.stdout)

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

    def test_an_animated_model_is_shaded(self):
        cube = Path(self.folder.name) / "cube.gltf"
        moving_cube(cube)
        with tempfile.TemporaryDirectory() as out:
            ended = run(DEMO, "--tiny", "--out", out, "--model", cube, "--animation", "slide", "--shutter", "0.25,0.75")
            self.assertEqual(ended.returncode, 0, ended.stderr)
            self.assertEqual(run(sys.executable, MAKE_GALLERY, "--out", out).returncode, 0)
            report = json.loads((Path(out) / "report.json").read_text())

            def text():
                facts = json.loads((Path(out) / "gallery" / "animated_model" / "facts.json").read_text())
                return facts["blocks"][0]["text"]

            self.assertIn("its animation <i>slide</i>. The shutter opens 0.25 s", text())
            self.assertIn("closes at 0.75 s", text())
            errors = {(row["method"], row["receiver"], row["parameters"].get("times")): row["rmse"] for row in report}
            self.assertLess(errors[*ANALYTIC, None], errors["accumulation", "at_times_of_maps", 8])
            self.assertTrue(any("cube" in page.read_text() for page in (Path(out) / "gallery").rglob("*.html")))
            # An empty name is the first animation and takes no flag for a name.
            ended = run(DEMO, "--model", cube, "--animation=", "--tiny", "--out", out)
            self.assertEqual(ended.returncode, 0, ended.stderr)
            self.assertIn("its first animation", text())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
