"""Writes glTF files for tests: small ones with one feature, and random ones with all of them."""

import base64
import json
import math
import struct

KINDS = {"b": (5120, 127), "B": (5121, 255), "h": (5122, 32767), "H": (5123, 65535), "I": (5125, None),
         "f": (5126, None)}
WIDTHS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Writer:
    """A file in the making: `json` may be changed at will until it is written."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0"}, "nodes": [], "meshes": [], "accessors": [], "bufferViews": []}
        self.binary = b""

    def add(self, kind, **item):
        """Appends to one of the file's lists and returns the index."""
        items = self.json.setdefault(kind, [])
        items.append(item)
        return len(items) - 1

    def view(self, data, **item):
        self.binary += bytes(-len(self.binary) % 4)
        index = self.add("bufferViews", buffer=0, byteOffset=len(self.binary), byteLength=len(data), **item)
        self.binary += data
        return index

    def accessor(self, shape, elements, kind="f", normalized=False, stride=None):
        """Elements are tuples; normalized ones are fractions."""
        width = WIDTHS[shape]
        layout = struct.Struct(f"<{width}{kind}")
        packed = [layout.pack(*self.coded(element, kind, normalized)) for element in elements]
        if stride:
            packed = [part + bytes(stride - len(part)) for part in packed]
        extra = {"normalized": True} if normalized else {}
        view = self.view(b"".join(packed), **({"byteStride": stride} if stride else {}))
        return self.add("accessors", bufferView=view, componentType=KINDS[kind][0], count=len(elements), type=shape,
                        **extra)

    def sparse(self, shape, elements, replaced, base=True, index_kind="H"):
        """An accessor of floats some of whose elements are replaced, by index; zeros below where there is no base."""
        index = self.accessor(shape, elements) if base else self.add(
            "accessors", componentType=5126, count=len(elements), type=shape)
        width = WIDTHS[shape]
        self.json["accessors"][index]["sparse"] = {
            "count": len(replaced),
            "indices": {"bufferView": self.view(struct.pack(f"<{len(replaced)}{index_kind}", *replaced)),
                        "componentType": KINDS[index_kind][0]},
            "values": {"bufferView": self.view(b"".join(struct.pack(f"<{width}f", *v) for v in replaced.values()))}}
        return index

    @staticmethod
    def coded(element, kind, normalized):
        return [round(c * KINDS[kind][1]) for c in element] if normalized else element

    def mesh(self, positions, **rest):
        return self.add("meshes", primitives=[{"attributes": {"POSITION": self.accessor("VEC3", positions)}, **rest}])

    def text(self):
        if not self.binary:
            return json.dumps(self.json)
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.binary).decode()
        return json.dumps(self.json | {"buffers": [{"byteLength": len(self.binary), "uri": uri}]})

    def write(self, file):
        file.write_text(self.text())

    def write_binary(self, file):
        data = self.binary + bytes(-len(self.binary) % 4)
        text = json.dumps(self.json | {"buffers": [{"byteLength": len(self.binary)}]}).encode()
        text += b" " * (-len(text) % 4)
        file.write_bytes(struct.pack("<4sIII4s", b"glTF", 2, 28 + len(text) + len(data), len(text), b"JSON") + text
                         + struct.pack("<I4s", len(data), b"BIN\0") + data)


class RandomModel(Writer):
    """Nodes that share a name and hang on each other, meshes with skins and morph targets, and an animation of each."""

    def __init__(self, draw):
        super().__init__()
        self.draw = draw
        count = draw.randint(3, 9)
        for i in range(count):
            self.add("nodes", name="same", **self.place())
            if i and draw.random() < 0.7:
                self.json["nodes"][draw.randrange(i)].setdefault("children", []).append(i)
        children = {c for node in self.json["nodes"] for c in node.get("children", ())}
        roots = [i for i in range(count) if i not in children]
        draw.shuffle(roots)
        hidden = roots[1:2] if draw.random() < 0.3 else []  # joints may be out of sight
        self.json["scenes"] = [{"nodes": []}, {"nodes": [root for root in roots if root not in hidden]}]
        self.json["scene"] = 1
        seen = [i for i in range(count) if not self.is_below(i, hidden)]
        skins = [self.skin(count) for _ in range(2)]
        for i in {seen[0], *draw.sample(seen, draw.randint(1, len(seen)))}:
            node, skinned = self.json["nodes"][i], draw.random() < 0.5
            targets = draw.choice((0, 0, 1, 3))
            joints = len(self.json["skins"][skins[0]]["joints"])
            mesh = {"name": "same", "primitives": [self.primitive(targets, joints if skinned else 0)
                                                   for _ in range(draw.randint(1, 2))]}
            if targets and draw.random() < 0.5:
                mesh["weights"] = self.numbers(targets)
            node["mesh"] = self.add("meshes", **mesh)
            if targets and draw.random() < 0.5:
                node["weights"] = self.numbers(targets)
            if skinned:
                node["skin"] = draw.choice(skins)
        self.animate()

    def is_below(self, node, roots):
        return node in roots or any(self.is_below(i, roots) for i, other in enumerate(self.json["nodes"])
                                    if node in other.get("children", ()))

    def numbers(self, count, low=-1, high=1):
        return [self.draw.uniform(low, high) for _ in range(count)]

    def rotation(self):
        q = [self.draw.gauss(0, 1) for _ in range(4)]
        return [c / math.sqrt(sum(c * c for c in q)) for c in q]

    def scale(self):
        return [self.draw.choice((-1, 1, 1)) * self.draw.uniform(0.4, 2) for _ in range(3)]

    def matrix(self):
        return [c for last in (0, 0, 0, 1) for c in (*self.numbers(3), last)]

    def place(self):
        if self.draw.random() < 0.2:  # sheared and mirrored, as parts cannot be
            return {"matrix": self.matrix()}
        parts = {"translation": self.numbers(3), "rotation": self.rotation(), "scale": self.scale()}
        return {key: value for key, value in parts.items() if self.draw.random() < 0.7}

    def skin(self, count):
        joints = self.draw.sample(range(count), min(count, 3))
        matrices = [self.matrix() for _ in joints]
        return self.add("skins", joints=joints, **({"inverseBindMatrices": self.accessor("MAT4", matrices)}
                                                   if self.draw.random() < 0.7 else {}))

    def primitive(self, targets, joints):
        draw, corners = self.draw, self.draw.randint(5, 12)
        places = [self.numbers(3) for _ in range(corners)]
        how = draw.random()
        if how < 0.6:
            position = self.accessor("VEC3", places, stride=draw.choice((None, 12, 20)))
        else:
            replaced = {i: self.numbers(3) for i in sorted(draw.sample(range(corners), 3))}
            position = self.sparse("VEC3", places, replaced, base=how < 0.8, index_kind=draw.choice("BHI"))
        result = {"attributes": {"POSITION": position}, "mode": draw.choice((4, 4, 5, 6)),
                  "targets": [{"POSITION": self.accessor("VEC3", [self.numbers(3) for _ in range(corners)])}
                              if draw.random() < 0.8 else {} for _ in range(targets)]}
        for k in range(draw.choice((1, 2)) if joints else 0):
            kind = draw.choice("BHf")
            weights = [self.numbers(4, 0, 1) for _ in range(corners)]
            result["attributes"] |= {
                f"JOINTS_{k}": self.accessor("VEC4", [draw.choices(range(joints), k=4) for _ in range(corners)],
                                             draw.choice("BH")),
                f"WEIGHTS_{k}": self.accessor("VEC4", weights, kind, normalized=kind != "f")}
        if draw.random() < 0.7:
            order = [draw.randrange(corners) for _ in range(12)]
            result["indices"] = self.accessor("SCALAR", [(i,) for i in order], draw.choice("BHI"))
        return result if targets else {key: value for key, value in result.items() if key != "targets"}

    def animate(self):
        channels, samplers = [], []
        targets = [(i, path) for i, node in enumerate(self.json["nodes"])
                   for path in (("weights",) if self.target_count(node) else ())
                   + (() if "matrix" in node else ("translation", "rotation", "scale"))]
        for node, path in self.draw.sample(targets, min(len(targets), 8)):
            mode = self.draw.choice(("STEP", "LINEAR", "CUBICSPLINE", None))
            times = sorted({0.0, *self.numbers(self.draw.randint(1, 3), 0, 2)} if self.draw.random() < 0.5 else
                           {*self.numbers(self.draw.randint(1, 3), 0.5, 2)})
            samplers.append({"input": self.accessor("SCALAR", [(t,) for t in times]),
                             "output": self.values(path, self.target_count(self.json["nodes"][node]),
                                                   len(times) * (3 if mode == "CUBICSPLINE" else 1)),
                             **({"interpolation": mode} if mode else {})})
            channels.append({"sampler": len(samplers) - 1, "target": {"node": node, "path": path}})
        if channels:
            self.add("animations", name="all", channels=channels, samplers=samplers)

    def target_count(self, node):
        return len(self.json["meshes"][node["mesh"]]["primitives"][0].get("targets", ())) if "mesh" in node else 0

    def values(self, path, targets, count):
        if path == "weights":
            kind = self.draw.choice("fbBhH")
            return self.accessor("SCALAR", [(c,) for c in self.numbers(targets * count, 0, 1)], kind, kind != "f")
        if path == "rotation":
            kind = self.draw.choice("ffbh")
            return self.accessor("VEC4", [self.rotation() for _ in range(count)], kind, kind != "f")
        return self.accessor("VEC3", [self.scale() if path == "scale" else self.numbers(3) for _ in range(count)])
