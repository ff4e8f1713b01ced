"""Says where every corner of a glTF file is at a time of an animation.

Written from the glTF 2.0 specification alone, to hold the reader of the examples to; nothing but the standard library.
Sections of the specification are named where they say something that is easily missed. An affine matrix is three rows
of four numbers.
"""

import base64
import json
import math
import struct
import urllib.parse
from pathlib import Path

COMPONENTS = {5120: ("b", 127), 5121: ("B", 255), 5122: ("h", 32767), 5123: ("H", 65535), 5125: ("I", 4294967295),
              5126: ("f", None)}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
IDENTITY = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0))


def product(a, b):
    return tuple(tuple(sum(row[k] * b[k][column] for k in range(3)) + (row[3] if column == 3 else 0)
                       for column in range(4)) for row in a)


def transformed(matrix, point):
    return tuple(row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3] for row in matrix)


def weighted_sum(matrices, weights):
    return tuple(tuple(sum(w * m[row][column] for m, w in zip(matrices, weights)) for column in range(4))
                 for row in range(3))


def determinant(m):
    return (m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]))


def from_columns(numbers):
    """The matrix that a file stores column by column (2.2, 3.6.2.2)."""
    return tuple(tuple(numbers[4 * column + row] for column in range(4)) for row in range(3))


def normalised(q):
    length = math.sqrt(sum(c * c for c in q))
    return tuple(c / length for c in q)


def from_parts(translation, rotation, scale):
    """T * R * S (3.5.2)."""
    x, y, z, w = normalised(rotation)
    turn = ((1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
            (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)))
    return tuple((*(turn[row][k] * scale[k] for k in range(3)), translation[row]) for row in range(3))


def slerp(a, b, t):
    """Appendix C.4: the shorter way."""
    a, b = normalised(a), normalised(b)
    cosine = sum(p * q for p, q in zip(a, b))
    if cosine < 0:
        b, cosine = tuple(-c for c in b), -cosine
    angle = math.acos(min(cosine, 1))
    if angle < 1e-6:
        return tuple((1 - t) * p + t * q for p, q in zip(a, b))
    return tuple((math.sin((1 - t) * angle) * p + math.sin(t * angle) * q) / math.sin(angle) for p, q in zip(a, b))


class Gltf:
    def __init__(self, file):
        self.folder = Path(file).parent
        content, binary = Path(file).read_bytes(), None
        if content[:4] == b"glTF":  # section 4.4
            length, = struct.unpack_from("<I", content, 12)
            text, rest = content[20:20 + length], content[20 + length:]
            if rest:
                binary = rest[8:8 + struct.unpack_from("<I", rest)[0]]
            content = text
        self.json = json.loads(content)
        self.buffers = [self.bytes_of(buffer.get("uri"), binary) for buffer in self.json.get("buffers", [])]
        self.nodes = self.json.get("nodes", [])
        self.parents = {child: i for i, node in enumerate(self.nodes) for child in node.get("children", [])}

    def bytes_of(self, uri, binary):
        if uri is None:
            return binary
        if uri.startswith("data:"):
            return base64.b64decode(uri.partition(",")[2])
        return (self.folder / urllib.parse.unquote(uri)).read_bytes()

    def elements(self, view, offset, kind, width, count):
        view = self.json["bufferViews"][view]
        data, layout = self.buffers[view["buffer"]], struct.Struct(f"<{width}{COMPONENTS[kind][0]}")
        first, stride = view.get("byteOffset", 0) + offset, view.get("byteStride", layout.size)
        return [layout.unpack_from(data, first + i * stride) for i in range(count)]

    def accessor(self, index):
        """A list of tuples, one for each element (3.6.2)."""
        accessor = self.json["accessors"][index]
        kind, width, count = accessor["componentType"], WIDTHS[accessor["type"]], accessor["count"]
        if "bufferView" in accessor:
            elements = self.elements(accessor["bufferView"], accessor.get("byteOffset", 0), kind, width, count)
        else:
            elements = [(0,) * width] * count
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            places, values = sparse["indices"], sparse["values"]
            places = self.elements(places["bufferView"], places.get("byteOffset", 0), places["componentType"], 1,
                                   sparse["count"])
            values = self.elements(values["bufferView"], values.get("byteOffset", 0), kind, width, sparse["count"])
            for (place,), value in zip(places, values):
                elements[place] = value
        if accessor.get("normalized"):
            largest = COMPONENTS[kind][1]
            elements = [tuple(max(c / largest, -1) for c in element) for element in elements]
        return elements

    def sampled(self, sampler, time, width, is_rotation):
        """`width` numbers at a time (appendix C)."""
        times = [t for t, in self.accessor(sampler["input"])]
        numbers = [c for element in self.accessor(sampler["output"]) for c in element]
        mode = sampler.get("interpolation", "LINEAR")
        parts = 3 if mode == "CUBICSPLINE" else 1

        def key(i, part=parts // 2):
            first = (parts * i + part) * width
            return numbers[first:first + width]

        if time <= times[0]:
            return key(0)
        if time >= times[-1]:
            return key(len(times) - 1)
        k = max(i for i, t in enumerate(times) if t <= time)
        if mode == "STEP":
            return key(k)
        length = times[k + 1] - times[k]
        t = (time - times[k]) / length
        if mode == "LINEAR":
            if is_rotation:
                return slerp(key(k), key(k + 1), t)
            return [a + t * (b - a) for a, b in zip(key(k), key(k + 1))]
        return [(2 * t ** 3 - 3 * t ** 2 + 1) * v0 + length * (t ** 3 - 2 * t ** 2 + t) * b0
                + (-2 * t ** 3 + 3 * t ** 2) * v1 + length * (t ** 3 - t ** 2) * a1
                for v0, b0, v1, a1 in zip(key(k), key(k, 2), key(k + 1), key(k + 1, 0))]

    def duration(self, animation):
        samplers = self.json["animations"][animation]["samplers"]
        used = [samplers[channel["sampler"]] for channel in self.json["animations"][animation]["channels"]
                if "node" in channel["target"]]
        return max(self.accessor(sampler["input"])[-1][0] for sampler in used)

    def target_count(self, node):
        if "mesh" not in node:
            return 0
        return len(self.json["meshes"][node["mesh"]]["primitives"][0].get("targets", []))

    def states(self, animation, time):
        """Each node's translation, rotation, scale and weights (3.7.2.2: the node's weights go before its mesh's)."""
        states = []
        for node in self.nodes:
            mesh = self.json["meshes"][node["mesh"]] if "mesh" in node else {}
            states.append({"translation": node.get("translation", (0, 0, 0)),
                           "rotation": node.get("rotation", (0, 0, 0, 1)), "scale": node.get("scale", (1, 1, 1)),
                           "weights": node.get("weights", mesh.get("weights", [0] * self.target_count(node)))})
        if animation is not None:
            animation = self.json["animations"][animation]
            for channel in animation["channels"]:
                target = channel["target"]
                if "node" not in target:  # 3.11: to be ignored
                    continue
                state, path = states[target["node"]], target["path"]
                state[path] = self.sampled(animation["samplers"][channel["sampler"]], time, len(state[path]),
                                           path == "rotation")
        return states

    def to_world(self, index, states):
        node, state = self.nodes[index], states[index]
        local = from_columns(node["matrix"]) if "matrix" in node else from_parts(
            state["translation"], state["rotation"], state["scale"])
        return product(self.to_world(self.parents[index], states), local) if index in self.parents else local

    def corner_matrices(self, primitive, node, states, count):
        """One matrix for each corner (3.7.3.3: of a skinned mesh, only the joints' transforms count)."""
        if "skin" not in self.nodes[node]:
            return [self.to_world(node, states)] * count
        skin = self.json["skins"][self.nodes[node]["skin"]]
        inverse = ([from_columns(m) for m in self.accessor(skin["inverseBindMatrices"])]
                   if "inverseBindMatrices" in skin else [IDENTITY] * len(skin["joints"]))
        joints = [product(self.to_world(joint, states), m) for joint, m in zip(skin["joints"], inverse)]
        carriers = [[] for _ in range(count)]
        for k in range(len(primitive["attributes"])):
            if f"JOINTS_{k}" not in primitive["attributes"]:
                break
            for corner, indices, weights in zip(carriers, self.accessor(primitive["attributes"][f"JOINTS_{k}"]),
                                                self.accessor(primitive["attributes"][f"WEIGHTS_{k}"])):
                corner += zip(indices, weights)
        sums = [sum(w for _, w in corner) for corner in carriers]
        return [weighted_sum([joints[j] for j, w in corner if w], [w / total for _, w in corner if w])
                for corner, total in zip(carriers, sums)]

    def triangles(self, primitive, count):
        """3.7.2.1, with the strip's odd triangles turned."""
        order = ([i for i, in self.accessor(primitive["indices"])] if "indices" in primitive else list(range(count)))
        mode = primitive.get("mode", 4)
        if mode == 4:
            return [tuple(order[i:i + 3]) for i in range(0, len(order) - 2, 3)]
        if mode == 5:
            return [(order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]) for i in range(len(order) - 2)]
        return [(order[0], order[i + 1], order[i + 2]) for i in range(len(order) - 2)] if mode == 6 else []

    def parts_of_node(self, index, states):
        node = self.nodes[index]
        for primitive in self.json["meshes"][node["mesh"]]["primitives"] if "mesh" in node else ():
            if primitive.get("mode", 4) < 4 or "POSITION" not in primitive["attributes"]:
                continue
            corners = self.accessor(primitive["attributes"]["POSITION"])
            for target, weight in zip(primitive.get("targets", []), states[index]["weights"]):
                if "POSITION" in target:
                    corners = [tuple(c + weight * d for c, d in zip(corner, by))
                               for corner, by in zip(corners, self.accessor(target["POSITION"]))]
            matrices = self.corner_matrices(primitive, index, states, len(corners))
            triangles = [t if determinant(matrices[t[0]]) >= 0 else (t[0], t[2], t[1])  # 3.7.4: mirrored ones turn
                         for t in self.triangles(primitive, len(corners))]
            yield [transformed(m, corner) for m, corner in zip(matrices, corners)], triangles
        for child in node.get("children", []):
            yield from self.parts_of_node(child, states)

    def parts(self, animation=None, time=0):
        """Corners and triangles of each primitive that has triangles, each node before its children."""
        if "scenes" in self.json:
            roots = self.json["scenes"][self.json.get("scene", 0)].get("nodes", [])
        else:
            roots = [i for i in range(len(self.nodes)) if i not in self.parents]
        states = self.states(animation, time)
        return [part for root in roots for part in self.parts_of_node(root, states)]
