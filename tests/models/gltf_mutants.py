#!/usr/bin/env python3
"""Broken glTF ends in one line and exit code 2, never in a crash: gltf_mutants.py GLTF_PARTS"""

import json
import random
import resource
import struct
import sys
import tempfile
import unittest
from pathlib import Path

from gltf_places import TRIANGLE, read
from gltf_writer import RandomModel, Writer

HOSTILE = (-1, -2, 0, 1, 3, 255, 2 ** 31, 2 ** 32, 2 ** 32 + 1, 10 ** 11, 2 ** 63, 2 ** 64 - 1, 10 ** 400, 0.5, 1e300,
           "", "x", None, True, [], {}, [0], [-1], [None], float("nan"))
BYTES = (*(struct.pack("<f", number) for number in (float("nan"), float("inf"), -1e38)), b"\xff" * 4, bytes(4))


def places_in(value):
    """Each container of the file's tree with each of its keys."""
    for key, item in list(value.items() if isinstance(value, dict) else enumerate(value)):
        yield value, key
        if isinstance(item, (dict, list)):
            yield from places_in(item)


def arm():
    """A skinned, morphed and animated triangle that is read as it is."""
    model = Writer()
    positions = model.accessor("VEC3", TRIANGLE)
    model.add("meshes", weights=[0.5], primitives=[{
        "attributes": {"POSITION": positions, "JOINTS_0": model.accessor("VEC4", [(0, 1, 0, 0)] * 3, "B"),
                       "WEIGHTS_0": model.accessor("VEC4", [(0.5, 0.5, 0, 0)] * 3)},
        "indices": model.accessor("SCALAR", [(0,), (1,), (2,)], "H"), "targets": [{"POSITION": positions}]}])
    model.add("nodes", mesh=0, skin=0)
    model.add("nodes", name="upper", children=[2])
    model.add("nodes", name="lower")
    model.add("skins", joints=[1, 2])
    model.add("animations", name="wave", samplers=[
        {"input": model.accessor("SCALAR", [(0,), (1,)]), "output": model.accessor("VEC3", TRIANGLE[:2])}],
        channels=[{"sampler": 0, "target": {"node": 1, "path": "translation"}}])
    return model


def replaced(*path):
    """Replaces the value at a path, whose last word is the new value."""
    def mutate(model):
        place = model.json
        for key in path[:-2]:
            place = place[key]
        place[path[-2]] = path[-1]
    return mutate


def floats(offset_of, values):
    """Overwrites numbers at the start of an accessor."""
    def mutate(model):
        data = struct.pack(f"<{len(values)}f", *values)
        start = model.json["bufferViews"][model.json["accessors"][offset_of(model)]["bufferView"]]["byteOffset"]
        model.binary = model.binary[:start] + data + model.binary[start + len(data):]
    return mutate


def times_of(model):
    return model.json["animations"][0]["samplers"][0]["input"]


def weights_of(model):
    return model.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"]


PRIMITIVE = ("meshes", 0, "primitives", 0)
ANIMATION = ("animations", 0)
BROKEN = (
    (replaced("accessors", 0, "count", 10 ** 9), "accessor reaches beyond buffer view 0"),
    (replaced("accessors", 0, "count", 10 ** 11), '"count" is not an index or a size'),
    (replaced("accessors", 0, "byteOffset", 4), "accessor reaches beyond buffer view 0"),
    (replaced("accessors", 0, "bufferView", 99), "no buffer view 99"),
    (replaced("accessors", 0, "bufferView", -1), '"bufferView" is not an index'),
    (replaced("accessors", 0, "type", "VEC4"), "accessor 0 has the wrong type"),
    (replaced("accessors", 0, "componentType", 5130), "component type 5130 is not supported"),
    (replaced("accessors", 0, {"componentType": 5126, "type": "VEC3", "count": 2 ** 31 - 1}), "needs too much memory"),
    (replaced("accessors", 3, "componentType", 5126), "accessor 3 holds no unsigned integers"),
    (replaced("bufferViews", 0, "byteLength", 10 ** 9), "buffer view 0 reaches beyond its buffer"),
    (replaced("bufferViews", 0, "byteOffset", 2 ** 31 - 1), "buffer view 0 reaches beyond its buffer"),
    (replaced("bufferViews", 0, "byteStride", 8), "elements overlap in buffer view 0"),
    (replaced(*PRIMITIVE, "attributes", "POSITION", -1), '"attributes" is not a list of indices'),
    (replaced(*PRIMITIVE, "attributes", "POSITION", 2 ** 32), '"attributes" is not a list of indices'),
    (replaced(*PRIMITIVE, "attributes", "POSITION", 99), "no accessor 99"),
    (replaced(*PRIMITIVE, "mode", 7), "mode 7 are not supported"),
    (replaced(*PRIMITIVE, "material", 0), "no material 0"),
    (replaced(*PRIMITIVE, "indices", 1), "accessor 1 has the wrong type"),
    (replaced("meshes", 0, "weights", [1, 2]), "2 numbers instead of 1"),
    (replaced("nodes", 0, "mesh", 7), "no mesh 7"),
    (replaced("nodes", 0, "skin", 7), "no skin 7"),
    (replaced("nodes", 0, "rotation", [0, 0, 0, 0]), "a rotation has no length"),
    (replaced("nodes", 0, "scale", [1, 1]), "2 numbers instead of 3"),
    (replaced("nodes", 2, "matrix", [1] * 16), "a matrix is not affine"),
    (replaced("nodes", 2, "children", [1]), "their own descendants"),
    (replaced("nodes", 2, "children", [2]), "node 2 is a child twice"),
    (replaced("nodes", 2, "children", [3]), "no node 3"),
    (replaced("skins", 0, "joints", [1]), "joint is not in its skin"),
    (replaced("skins", 0, "joints", [1, 9]), "no node 9"),
    (replaced("skins", 0, "inverseBindMatrices", 0), "accessor 0 has the wrong type"),
    (replaced(*ANIMATION, "channels", 0, "target", "node", 9), "no node 9"),
    (replaced(*ANIMATION, "channels", 0, "target", "path", "pointer"), "which is not supported"),
    (replaced(*ANIMATION, "channels", 0, "target", "path", "weights"), "has no morph targets"),
    (replaced(*ANIMATION, "channels", 0, "sampler", 1), "no sampler 1"),
    (replaced(*ANIMATION, "channels", []), 'animation "wave" moves nothing'),
    (replaced(*ANIMATION, "samplers", 0, "interpolation", "CUBICSPLINE"), "not as many values as times"),
    (replaced(*ANIMATION, "samplers", 0, "interpolation", "ROUND"), "interpolation ROUND is not supported"),
    (replaced("extensionsRequired", ["EXT_meshopt_compression"]), "extension EXT_meshopt_compression is not supported"),
    (lambda model: replaced(*PRIMITIVE, "targets", 0, "POSITION", model.sparse("VEC3", [], {0: (1, 1, 1)}))(model),
     "a sparse index lies beyond its accessor"),
    (replaced("asset", {"version": "3.0"}), "glTF version 3.0 is not supported"),
    (replaced("asset", {}), "no version of glTF in it"),
    (floats(times_of, (1, 0)), "times of an animation do not rise"),
    (floats(times_of, (0, float("nan"))), "times of an animation do not rise"),
    (floats(weights_of, (0, 0)), "no joint of its skin carries a corner"),
    (floats(weights_of, (float("nan"), 1)), "no joint of its skin carries a corner"),
    (lambda model: model.json["nodes"][2].update(matrix=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
     or model.json["animations"][0]["channels"][0]["target"].update(node=2), "which has a matrix"),
    (lambda model: model.json["animations"][0]["channels"].append(model.json["animations"][0]["channels"][0]), "twice"),
)


class Mutants(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name) / "model.gltf"

    def test_each_kind_of_breach_has_its_line(self):
        arm().write(self.file)
        self.assertIsInstance(read(self.file, "wave", 0, 1), list)
        for i, (mutate, cause) in enumerate(BROKEN):
            model = arm()
            mutate(model)
            model.write(self.file)
            with self.subTest(i):
                self.assertIn(cause, read(self.file, "wave", 0, 0))

    def test_binary_files_are_not_read_beyond_their_end(self):
        arm().write_binary(self.file)
        content = self.file.read_bytes()
        self.assertIsInstance(read(self.file), list)
        length, = struct.unpack_from("<I", content, 12)
        for broken in (content[:11], content[:19], content[:40], content[:-4],
                       content[:20 + length] + struct.pack("<I", len(content)) + content[24 + length:]):
            self.file.write_bytes(broken)
            self.assertIn("cut off", read(self.file))

    def test_a_full_stack_ends_in_one_line(self):
        depth = 300_000
        resource.setrlimit(resource.RLIMIT_STACK, (2 ** 23, resource.getrlimit(resource.RLIMIT_STACK)[1]))
        self.file.write_text('{"asset": {"version": "2.0"}, "extras": ' + "[" * depth + "1" + "]" * depth + "}")
        self.assertEqual(read(self.file), "its reader crashed")

    def test_no_mutant_crashes(self):
        draw, outcomes = random.Random(5), []
        for _ in range(400):
            model, name = (RandomModel(draw), "all") if draw.random() < 0.7 else (arm(), "wave")
            for _ in range(draw.randint(1, 3)):
                if draw.random() < 0.2:
                    at = 4 * draw.randrange(len(model.binary) // 4)
                    model.binary = model.binary[:at] + draw.choice(BYTES) + model.binary[at + 4:]
                    continue
                place, key = draw.choice([(place, key) for place, key in places_in(model.json) if key != "asset"])
                if draw.random() < 0.1:
                    del place[key]
                else:
                    place[key] = draw.choice(HOSTILE)
            text = model.text()
            self.file.write_text(text[:draw.randrange(len(text))] if draw.random() < 0.03 else text)
            found = read(self.file, *((name, 0, 0) if draw.random() < 0.5 else ()))
            self.assertNotIn("crashed", found if isinstance(found, str) else "", text)
            outcomes.append(isinstance(found, list))
        self.assertGreater(outcomes.count(True), 40)
        self.assertGreater(outcomes.count(False), 40)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
