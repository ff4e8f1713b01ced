#!/usr/bin/env python3
"""The reader of glTF places every corner where the independent reader does: gltf_places.py GLTF_PARTS [FOLDER of assimp-testmodels]"""

import json
import random
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from gltf_reader import Gltf
from gltf_writer import RandomModel, Writer

PARTS = sys.argv[1]
FOREIGN = Path(sys.argv[2]) if len(sys.argv) > 2 else None
TOLERANCE = 1e-6  # of the longest side of the model
# Files that are refused, by folder or name, and the words that say why.
REFUSED = {
    "BoxWithInfinites-glTF-Binary/": "no triangles in it",  # every corner has one
    "IndexOutOfRange/": "where there are 24 corners",
    "MissingBin/": "File not found",
    "RecursiveNodes/": "nodes are their own descendants",
    "SchemaFailures/": '"scene" is not an index',
    "TestNoRootNode/NoScene": "there is no scene 0",
    "TestNoRootNode/SceneWithoutNodes": "no triangles in it",
    "draco/": "extension KHR_draco_mesh_compression is not supported",
    **{f"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_{i:02}": "no triangles in it"
       for i in (0, 1, 2, 3, 7, 8, 9, 10)},  # points and lines
    "wrongTypes/badArray": '"primitives" is not a list',
    "wrongTypes/badNumber": "'index' property is missing in NormalTextureInfo",
}

TRIANGLE = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]


def read(file, *when):
    """The parts that the reader finds, or the line that it ends in."""
    ended = subprocess.run([PARTS, str(file), *map(str, when)], capture_output=True, text=True, check=False)
    if ended.returncode == 0:
        return json.loads(ended.stdout)
    if (ended.returncode, ended.stderr.count("\n")) != (2, 1) or not ended.stderr.startswith(f"{file}: "):
        raise RuntimeError(f"{file}: {ended.returncode} {ended.stderr}")
    return ended.stderr.removeprefix(f"{file}: ").strip()


def longest_side(parts):
    corners = [corner for places, _ in parts for corner in places]
    return max(max(c[k] for c in corners) - min(c[k] for c in corners) for k in range(3))


class Places(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name) / "model.gltf"

    def hold(self, found, expected, where):
        if found[1] == "open":
            self.assertEqual([part["triangles"] for part in found[0]], [[list(t) for t in triangles]
                                                                        for _, triangles in expected], where)
        tolerance = TOLERANCE * longest_side(expected)
        for part, (corners, _) in zip(found[0], expected):
            for corner, right in zip(part[found[1]], corners, strict=True):
                for a, b in zip(corner, right):
                    self.assertLessEqual(abs(a - b), tolerance, (where, corner, right))

    def compare(self, file):
        """Holds the file at rest and in all of its animations to the independent reader. Returns whether it moves."""
        source, moves = Gltf(file), False
        found = read(file)
        self.assertIsInstance(found, list, (file, found))
        rest = source.parts()
        self.hold((found, "open"), rest, file)
        for i, animation in enumerate(source.json.get("animations", ())):
            end = source.duration(i)
            for open_, closing in ((0, end), (0.31 * end, 0.5 * end), (0.77 * end, 0.93 * end)):
                found = read(file, animation.get("name", ""), open_, closing)
                self.assertIsInstance(found, list, (file, found))
                for time, when in ((open_, "open"), (closing, "closing")):
                    expected = source.parts(i, time)
                    self.hold((found, when), expected, (file, animation.get("name"), time))
                    moves = moves or expected != rest
        return moves

    def test_random_models_with_all_features(self):
        draw, moving = random.Random(12), 0
        for i in range(60):
            model = RandomModel(draw)
            file = self.file.with_suffix(".glb" if i % 3 == 0 else ".gltf")
            (model.write_binary if i % 3 == 0 else model.write)(file)
            moving += self.compare(file)
        self.assertGreater(moving, 40)

    def carousel(self, mode, path, values):
        """A triangle on a node that one channel moves, below one of the same name."""
        model = Writer()
        mesh = model.mesh(TRIANGLE)
        model.add("nodes", name="robot", children=[1], scale=[1, -2, 0.5], rotation=[0.6, 0, 0, 0.8])
        model.add("nodes", name="robot", mesh=mesh)
        sampler = {"input": model.accessor("SCALAR", [(0,), (1,), (3,)]), "interpolation": mode,
                   "output": model.accessor("VEC4" if path == "rotation" else "VEC3", values)}
        model.add("animations", name="", samplers=[sampler],
                  channels=[{"sampler": 0, "target": {"node": 1, "path": path}}])
        model.write(self.file)
        self.compare(self.file)
        return [read(self.file, "", t, t)[0]["open"] for t in (0.25, 2)]

    def test_modes_of_interpolation_differ(self):
        places = [(0, 0, 0), (1, 0, 0), (0, 2, 0)]
        tangents = [p for place in places for p in ((0, 0, 1), place, (0, 1, 1))]
        found = [self.carousel(mode, "translation", tangents if mode == "CUBICSPLINE" else places)
                 for mode in ("STEP", "LINEAR", "CUBICSPLINE")]
        for i in range(3):
            for k in range(i):
                self.assertNotEqual(found[i], found[k])
        half = 0.5 ** 0.5
        turns = [(0, 0, 0, 1), (0, -half, 0, -half), (half, 0, 0, half)]  # the second is the long way
        self.carousel("LINEAR", "rotation", turns)
        self.carousel("LINEAR", "scale", [(1, 1, 1), (-1, 2, 1), (1, 1, -3)])

    def test_weights_of_the_node_go_before_those_of_the_mesh(self):
        model = Writer()
        target = {"POSITION": model.accessor("VEC3", [(0, 0, 1)] * 3)}
        mesh = model.mesh(TRIANGLE, targets=[target])
        model.json["meshes"][mesh]["weights"] = [0.5]
        model.add("nodes", mesh=mesh)
        model.add("nodes", mesh=mesh, weights=[0.25])
        model.write(self.file)
        self.compare(self.file)
        self.assertEqual([part["open"][0][2] for part in read(self.file)], [0.5, 0.25])

    def test_the_node_of_a_skinned_mesh_does_not_place_it(self):
        model = Writer()
        mesh = model.mesh(TRIANGLE)
        model.json["meshes"][mesh]["primitives"][0]["attributes"] |= {
            "JOINTS_0": model.accessor("VEC4", [(0, 0, 0, 0)] * 3, "B"),
            "WEIGHTS_0": model.accessor("VEC4", [(1, 0, 0, 0)] * 3)}
        model.add("nodes", mesh=mesh, skin=model.add("skins", joints=[1]), translation=[7, 8, 9])
        model.add("nodes", translation=[0, 0, 5])
        model.write(self.file)
        self.compare(self.file)
        self.assertEqual(read(self.file)[0]["open"][1], [1, 0, 5])

    def test_foreign_models(self):
        if FOREIGN is None:
            self.skipTest("assimp-testmodels is not installed")
        refused, read_count = {}, 0
        folder = FOREIGN / "glTF2"
        for file in sorted([*folder.rglob("*.gltf"), *folder.rglob("*.glb")]):
            name, found = file.relative_to(folder).as_posix(), read(file)
            if isinstance(found, str):
                place = next((start for start in REFUSED if name.startswith(start)), None)
                self.assertIn(REFUSED.get(place, "none"), found, name)
                refused[place] = found
            else:
                self.compare(file)
                read_count += 1
        self.assertEqual(refused.keys(), REFUSED.keys())
        self.assertGreater(read_count, 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
