#!/usr/bin/env python3
"""Writes walker.gltf, a skinned figure that walks a step a second towards +z: walker.py FILE"""

import base64
import json
import math
import struct
import sys
from pathlib import Path

SIDES = 10
KEYS = 16  # of a second
FLOATS, BYTES, SHORTS = 5126, 5121, 5123

# Joints by their names: parent, and place in metres where nothing is turned.
JOINTS = {"hips": (None, (0, 1, 0)), "chest": ("hips", (0, 1.2, 0)), "head": ("chest", (0, 1.52, 0))}
for side, x in ("left", 1), ("right", -1):
    JOINTS |= {f"{side} hip": ("hips", (0.11 * x, 0.93, 0)), f"{side} knee": (f"{side} hip", (0.11 * x, 0.5, 0)),
               f"{side} shoulder": ("chest", (0.23 * x, 1.4, 0)), f"{side} elbow": (f"{side} shoulder", (0.23 * x, 1.1, 0))}
NAMES = list(JOINTS)


def limbs():
    """Each limb: its rings from below, (x, y, z, half width, half depth), the joint of its lower part, that of its upper one,
    and the height between the two."""
    rows = lambda low, high, n, make: [make(low + (high - low) * i / (n - 1)) for i in range(n)]
    round_at = lambda middle, y, r: math.sqrt(max(r * r - (y - middle) ** 2, 1e-4))
    yield rows(0.88, 1.48, 9, lambda y: (0, y, 0, 0.13 + 0.07 * (y - 0.88), 0.09 + 0.03 * (y - 0.88))), "hips", "chest", 1.2
    yield rows(1.5, 1.79, 8, lambda y: (0, y, 0, 0.8 * round_at(1.65, y, 0.145), round_at(1.65, y, 0.145))), "head", "head", 0
    for side, x in ("left", 1), ("right", -1):
        leg = rows(0.05, 0.97, 14, lambda y: (0.11 * x, y, 0, 0.045 + 0.045 * y, 0.045 + 0.045 * y))
        yield leg, f"{side} knee", f"{side} hip", 0.5
        yield rows(0, 0.07, 3, lambda y: (0.11 * x, y, 0.06, 0.05, 0.13 - 0.6 * y)), f"{side} knee", f"{side} knee", 0
        arm = rows(0.78, 1.44, 12, lambda y: (0.23 * x, y, 0, 0.02 + 0.035 * (y - 0.3), 0.02 + 0.035 * (y - 0.3)))
        yield arm, f"{side} elbow", f"{side} shoulder", 1.1


def skin():
    """Places, joints and weights of vertices, and indices of triangles."""
    places, joints, weights, indices = [], [], [], []
    for rings, lower, upper, between in limbs():
        first = len(places)
        for x, y, z, wide, deep in rings:
            share = round(255 * min(max((y - between) / 0.12 + 0.5, 0), 1)) if lower != upper else 0
            for k in range(SIDES):
                angle = 2 * math.pi * k / SIDES
                places.append((x + wide * math.cos(angle), y, z + deep * math.sin(angle)))
                joints.append((NAMES.index(lower), NAMES.index(upper), 0, 0))
                weights.append((255 - share, share, 0, 0))
        ring = lambda row, k: first + row * SIDES + k % SIDES
        for row in range(len(rings) - 1):
            for k in range(SIDES):
                a, b, c, d = ring(row, k), ring(row, k + 1), ring(row + 1, k), ring(row + 1, k + 1)
                indices += [(a, c, b), (b, c, d)]
        for k in range(1, SIDES - 1):  # caps
            indices += [(ring(0, 0), ring(0, k), ring(0, k + 1)),
                        (ring(len(rings) - 1, 0), ring(len(rings) - 1, k + 1), ring(len(rings) - 1, k))]
    return places, joints, weights, indices


def pose(joint, time):
    """The turn of a joint about x, in degrees."""
    side = 1 if joint.startswith("left") else -1
    swing = side * math.sin(2 * math.pi * time)
    lift = side * math.cos(2 * math.pi * time)
    return {"hip": -28 * swing, "knee": 12 + 30 * max(lift, 0), "shoulder": 30 * swing, "elbow": -30 - 12 * swing,
            "chest": 4}.get(joint.split()[-1], 0)


class Buffer:
    def __init__(self):
        self.bytes, self.views, self.accessors = b"", [], []

    def add(self, kind, component, rows, **more):
        code = {FLOATS: "f", BYTES: "B", SHORTS: "H"}[component]
        data = b"".join(struct.pack(f"<{len(row)}{code}", *row) for row in rows)
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data + bytes(-len(data) % 4)
        per = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}[kind]
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": component,
                               "count": sum(map(len, rows)) // per, "type": kind, **more})
        return len(self.accessors) - 1


def written():
    places, joints, weights, indices = skin()
    to = Buffer()
    ends = {"min": [round(min(p), 6) for p in zip(*places)], "max": [round(max(p), 6) for p in zip(*places)]}
    attributes = {"POSITION": to.add("VEC3", FLOATS, places, **ends), "JOINTS_0": to.add("VEC4", BYTES, joints),
                  "WEIGHTS_0": to.add("VEC4", BYTES, weights, normalized=True)}
    triangles = to.add("SCALAR", SHORTS, indices)
    binds = to.add("MAT4", FLOATS, [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, *(-v for v in place), 1) for _, place in JOINTS.values()])
    times = [k / KEYS for k in range(KEYS + 1)]
    keys = to.add("SCALAR", FLOATS, [(t,) for t in times], min=[0], max=[1])
    samplers, channels, nodes = [], [], []

    def animate(node, path, kind, rows):
        samplers.append({"input": keys, "output": to.add(kind, FLOATS, rows), "interpolation": "LINEAR"})
        channels.append({"sampler": len(samplers) - 1, "target": {"node": node, "path": path}})

    for number, (name, (parent, place)) in enumerate(JOINTS.items()):
        above = JOINTS[parent][1] if parent else (0, 0, 0)
        nodes.append({"name": name, "translation": [round(a - b, 6) for a, b in zip(place, above)],
                      "children": [k for k, other in enumerate(NAMES) if JOINTS[other][0] == name]})
        if not nodes[-1]["children"]:
            del nodes[-1]["children"]
        angles = [math.radians(pose(name, t)) / 2 for t in times]
        if any(angles):
            animate(number, "rotation", "VEC4", [(math.sin(a), 0, 0, math.cos(a)) for a in angles])
    animate(0, "translation", "VEC3", [(0, 0.97 + 0.025 * math.cos(4 * math.pi * t), 1.4 * t) for t in times])
    nodes.append({"name": "walker", "mesh": 0, "skin": 0})
    file = {"asset": {"version": "2.0", "generator": "walker.py"}, "scene": 0, "scenes": [{"nodes": [0, len(NAMES)]}], "nodes": nodes,
            "meshes": [{"name": "walker", "primitives": [{"attributes": attributes, "indices": triangles}]}],
            "skins": [{"joints": list(range(len(NAMES))), "inverseBindMatrices": binds}],
            "animations": [{"name": "walk", "samplers": samplers, "channels": channels}],
            "accessors": to.accessors, "bufferViews": to.views,
            "buffers": [{"byteLength": len(to.bytes),
                         "uri": "data:application/octet-stream;base64," + base64.b64encode(to.bytes).decode()}]}
    return "{\n" + ",\n".join(f"{json.dumps(key)}: {json.dumps(value)}" for key, value in file.items()) + "\n}\n"


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(written(), encoding="ascii")
