#!/usr/bin/env python3
"""Makes facts of three drivers that use every block and option, as the demo's drivers do: sample_facts.py OUT"""

import json
import math
import random
import sys
from pathlib import Path

import matplotlib.image
import numpy

HOSTILE = "<script>alert('$x^2$')</script> & \"friends\" </style>"
COLOURS = ("#222222", "#8c6d31", "#c49a4a", "#9467bd", "#d62728", "#7f7f7f", "#1f77b4", "#2ca02c")


def paint(file, shift, width=96, height=54):
    """A picture of rings."""
    y, x = numpy.mgrid[0:height, 0:width]
    rings = 0.5 + 0.5 * numpy.sin(0.3 * numpy.hypot(x - width / 2 - shift, y - height / 2))
    matplotlib.image.imsave(file, numpy.stack((rings, rings * 0.8, 1 - rings), axis=2))


def axis(label, scale="linear", **more):
    return {"label": label, "scale": scale, **more}


def crowd(seed, count, scale="log", zeros=0):
    """A panel of many labelled points, of which some lie on each other."""
    draw = random.Random(seed)
    names = [f"filter {i} of {2**(i % 5 + 4)} bit" + (", depth in [0, 1], certified" if i % 6 == 0 else "") for i in range(count)]
    places = [(10**draw.gauss(0, 0.35), 0 if i < zeros else 10**draw.gauss(-2, 0.5)) for i in range(count)]
    places[1:3] = [places[0]] * 2
    return {"x": axis("ns per receiver, kernel alone", "log"), "y": axis("leak (mean of all that is too bright)", scale, threshold=1e-5),
            "pareto": True, "size": "bytes per texel",
            "series": [{"label": name, "style": "points", "labelled": True, "colour": COLOURS[i % 8],
                        "points": [[*place, 4 * 2**(i % 4)]]} for i, (name, place) in enumerate(zip(names, places))]}


def bounds():
    """A panel of bands, lines, steps and rules."""
    xs = [i / 32 - 1 for i in range(65)]
    ramp = [min(1, max(0, 0.5 + 0.7 * x)) for x in xs]
    return {"title": "four moments", "x": axis("depth", least=-1, most=1, ticks=[-1, [-0.5, "closer"], 0, 0.5, 1]),
            "y": axis("shadow intensity", least=-0.02, most=1.02),
            "series": [{"label": "between the bounds", "style": "band", "points": [[x, max(0, y - 0.2), min(1, y + 0.2)] for x, y in zip(xs, ramp)]},
                       {"label": "ground truth", "style": "steps", "colour": "#222222", "points": [[-1, 0], [-0.3, 0.4], [0.4, 1], [1, 1]]},
                       {"label": "lower bound", "style": "line", "marker": "none", "points": [[x, max(0, y - 0.2)] for x, y in zip(xs, ramp)]},
                       {"label": "receiver", "style": "rule", "dashed": True, "labelled": True, "points": [[0.25, None]]},
                       {"label": "half", "style": "rule", "labelled": True, "points": [[None, 0.5]]}]}


def curve(title, seed):
    """A panel of a line whose points have texts, and of points without labels."""
    draw = random.Random(seed)
    maps = [8, 16, 32, 64, 128]
    return {"title": f"{title}\nanalytic receivers: {draw.uniform(1, 9):.1f} x cheaper", "x": axis("ns per receiver", "log"), "y": axis("RMSE", "log"),
            "series": [{"label": "accumulation of as many maps", "style": "line", "colour": "#222222", "marker": "circle",
                        "points": [[3 * n * draw.uniform(0.9, 1.2), 0.2 / n] for n in maps], "texts": [str(n) for n in maps]},
                       *({"label": f"ranges {k}, receivers {h}", "style": "points", "colour": COLOURS[4 + j],
                          "points": [[10**draw.uniform(1, 2.5), 10**draw.uniform(-3, -1)], [None, 0.1]]}
                         for k in ("exact", "resolved", "of a list") for j, h in enumerate(("analytic", "sampled")))]}


def heat_map(name, count, scale="log"):
    xs, ys = [10**(-6 + 0.5 * i) for i in range(13)], [i / 10 for i in range(1, 10)]

    def values(k):
        return [[None if (i + j) % 23 == 11 else 10**(-k) * y / math.sqrt(x) for i, x in enumerate(xs)] for j, y in enumerate(ys)]

    return {"type": "map", "name": name, "alt": "Where filters fail, over distance and weight", "caption": "Outlined: it fails.",
            "title": "Two surfaces", "text": "Distance of two surfaces against the weight of the closer one.",
            "x": axis("distance, share of the depth range", "log", values=xs), "y": axis("weight of the closer", values=ys),
            "threshold": 1e-2, "label": "error of intensity", "scale": scale,
            "maps": [{"label": f"filter {k}, {HOSTILE if k == 2 else 'moments of a bounded error'}", "values": values(k)} for k in range(2, 2 + count)]}


def table():
    columns = [{"key": "method", "label": "method"}, {"key": "leak", "label": "leak", "digits": 2, "scale": 1000, "best": "low", "hint": "mean of what is too bright"},
               {"key": "speed", "label": "speed", "best": "high", "colour": "#d62728"}, {"key": "note", "label": "note"}]
    rows = [{"method": "reference", "leak": 0, "speed": 1, "note": None, "aside": True},
            {"method": HOSTILE, "leak": 0.0123, "speed": 812345.5, "note": HOSTILE, "colour": "#c49a4a"},
            {"method": "second", "leak": 0.00211, "speed": 9.5, "note": "–"},
            {"method": "third", "leak": 0.00212, "speed": None, "note": "ties with the second when rounded? no"},
            {"method": "fourth", "leak": 0.002111, "speed": 2.5e-7, "note": "ties with the second when rounded"}]
    return {"type": "table", "title": "Numbers", "text": "A click on a head sorts.", "columns": columns, "rows": rows}


def pictures(folder, count, **more):
    for i in range(count):
        paint(folder / f"ring {i}.png", 8 * i)
    return {"type": "pictures", "pictures": [{"file": f"ring {i}.png", "alt": f"Rings, moved by {8 * i} pixels", "caption": f"moved by {8 * i}"}
                                             for i in range(count)], **more}


def samples(gallery):
    """The facts of each driver, by its id; pictures are written."""
    for name in ("first", "second", "third"):
        (gallery / name).mkdir(parents=True, exist_ok=True)
    first, second = gallery / "first", gallery / "second"
    front = {"picture": "ring 0.png", "alt": "Rings around a centre", "caption": "Rings show <i>all</i> that a filter does."}
    return {
        "first": {"driver": "first", "title": "Rings at rest", "family": "rings", "summary": "Many filters of the same rings.", "order": 2, "front": front, "blocks": [
            {"type": "text", "title": "The scene", "text": "After <i>Peters & Klein</i>, x<sub>1</sub> < x<sup>2</sup> &lt; 3; see <a href=\"facts.json\">facts</a>.\n\nA second paragraph."},
            pictures(first, 3, title="Side by side", compare=True, shown=[0, 2]),
            {"type": "chart", "name": "speed", "title": "Speed against accuracy", "alt": "Leak of 17 filters against their time", "front": True,
             "caption": "Lower left is <b>better</b>.", "panels": [crowd(1, 17), crowd(2, 17, "symlog", 6), crowd(3, 12, "log", 2)]},
            table(), heat_map("failing", 4)]},
        "second": {"driver": "second", "title": f"Curves {HOSTILE}", "family": "curves", "summary": HOSTILE, "order": 1, "front": front, "blocks": [
            {"type": "chart", "name": "bounds", "alt": "Bounds around a staircase", "panels": [bounds()]},
            {"type": "chart", "name": "equal-error", "title": "Equal error", "alt": "Error against time in four scenes", "caption": HOSTILE,
             "panels": [curve(title, i) for i, title in enumerate(("crossed quads", "random cubes", "a $ sign and a { brace", HOSTILE))]},
            {**table(), "title": "All numbers", "folded": True},
            pictures(second, 8, columns=4, pixelated=True, folded=True, title="All pictures",
                     key=[{"colour": "#2a62cc", "label": "light that leaks"}, {"colour": "#c8232c", "label": HOSTILE}])]},
        "third": {"driver": "third", "title": "Nothing measured", "family": "curves", "summary": "A driver without a picture.", "blocks": [
            {"type": "text", "text": HOSTILE}, {**heat_map("one", 1, "linear"), "title": HOSTILE},
            {"type": "chart", "name": "empty", "alt": "An empty chart", "panels": [{"x": axis("x", "log"), "y": axis("y", "log"), "pareto": True, "series": [
                {"label": "nothing", "style": "points", "points": []}, {"label": "no number", "style": "line", "labelled": True, "points": [[None, 1]]}]}]}]}}


def write(out):
    """Leaves the samples in OUT/gallery as the demo would."""
    found = samples(out / "gallery")
    for name, facts in found.items():
        (out / "gallery" / name / "facts.json").write_text(json.dumps(facts), encoding="utf-8")
    (out / "report.json").write_text("[]")
    return found


if __name__ == "__main__":
    write(Path(sys.argv[1]))
