#!/usr/bin/env python3
"""Measures the texts of charts: overlaps.py GALLERY_CODE OUT...

Draws each chart and each map that facts below OUT/gallery ask for, with the gallery's own code, and prints a line for each
text that touches another text, a mark that is not its own, or the border of the figure. Exit code 1 if there is any.
"""

import sys
from pathlib import Path

from matplotlib.collections import PathCollection
from matplotlib.text import Text

SLACK = 0.5  # pixels


def texts_of(figure, shown_ticks):
    """What is written in a figure, as [(text, box)]."""
    renderer = figure.canvas.get_renderer()
    found = []
    for axes in figure.axes:
        written = [*(child for child in axes.get_children() if isinstance(child, Text)), axes.xaxis.label, axes.yaxis.label,
                   *(tick.label1 for side in (axes.xaxis, axes.yaxis) for tick in shown_ticks(side))]
        found += [(text.get_text(), text.get_window_extent(renderer).extents) for text in written
                  if text.get_visible() and text.get_text().strip()]
    return found


def marks_of(figure):
    """The boxes of all points, and those of lines' markers."""
    for axes in figure.axes:
        for points in axes.collections:
            if isinstance(points, PathCollection):
                for (x, y), area in zip(axes.transData.transform(points.get_offsets()), points.get_sizes()):
                    radius = area**0.5 / 2 * figure.dpi / 72
                    yield x - radius, y - radius, x + radius, y + radius
        for line in axes.lines:
            if line.get_marker() not in ("", "None", None):
                radius = line.get_markersize() / 2 * figure.dpi / 72
                for x, y in axes.transData.transform(line.get_xydata()):
                    yield x - radius, y - radius, x + radius, y + radius


def common(a, b):
    return (min(a[2], b[2]) - max(a[0], b[0]) > SLACK) and (min(a[3], b[3]) - max(a[1], b[1]) > SLACK)


def overlaps(figure, shown_ticks):
    """What overlaps in a figure, a line each."""
    texts, frame = texts_of(figure, shown_ticks), figure.bbox.extents
    found = [f"'{a}' touches '{b}'" for i, (a, box) in enumerate(texts) for b, other in texts[:i] if common(box, other)]
    found += [f"'{text}' hides a point" for text, box in texts if any(common(box, mark) for mark in marks_of(figure))]
    return found + [f"'{text}' leaves the figure" for text, (left, low, right, high) in texts
                    if left < frame[0] - SLACK or low < frame[1] - SLACK or right > frame[2] + SLACK or high > frame[3] + SLACK]


def figures(facts):
    """All figures of a driver's facts, as (name, figure)."""
    import charts
    import maps

    for block in facts["blocks"]:
        if block["type"] == "chart":
            looks, area = charts.looks(block["panels"]), charts.Areas(block["panels"])
            for i, panel in enumerate(block["panels"]):
                yield f"{block['name']}, panel {i + 1}", charts.draw(panel, looks, area)
        elif block["type"] == "map":
            shades = maps.Shades(block)
            yield f"{block['name']}, key", maps.draw_key(block, shades)
            if len(block["maps"]) > 1:
                yield f"{block['name']}, all", maps.draw_sheet(block, shades)
            for shown in block["maps"]:
                yield f"{block['name']}, {shown['label']}", maps.draw(block, shown, shades)


def main():
    sys.path.insert(0, sys.argv[1])
    import facts
    import scales

    count, breaches = 0, 0
    for out in sys.argv[2:]:
        for file in sorted((Path(out) / "gallery").glob("*/facts.json")):
            for name, figure in figures(facts.read(file)):
                count += 1
                for breach in overlaps(figure, scales.shown_ticks):
                    breaches += 1
                    print(f"{file}: {name}: {breach}")
    print(f"{count} figures")
    return 1 if breaches or not count else 0


if __name__ == "__main__":
    sys.exit(main())
