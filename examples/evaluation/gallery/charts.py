"""Draws the panels of chart blocks: points, lines, steps, bands and rules, with their labels."""

import math
from dataclasses import dataclass
from itertools import cycle

import matplotlib
import numpy
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import colours
import labels
from scales import set_axis, thin_ticks, wrapped

WIDTH, HEIGHT, DPI = 4.5, 3.8, 96  # of a panel: inches, and the pixels of one
MARKERS = {"circle": "o", "square": "s", "triangle": "^", "diamond": "D", "down": "v", "plus": "P", "cross": "X",
           "star": "*", "none": ""}
DASHES = ("", "5 2", "1.5 1.5", "6 2 1.5 2")
AREA, LARGEST_AREA = 36, 250  # of a mark, in square points; the largest where marks have sizes
GROWTH, GROWTHS = 1.15, 8  # a chart whose labels do not fit grows
LINED = ("line", "steps")

STYLE = {"font.family": "DejaVu Sans", "font.size": 8.5, "axes.spines.top": False, "axes.spines.right": False,
         "axes.grid": True, "grid.color": colours.GRID, "axes.axisbelow": True, "axes.edgecolor": colours.QUIET,
         "axes.labelcolor": colours.INK, "text.color": colours.INK, "xtick.color": colours.QUIET,
         "ytick.color": colours.QUIET, "xtick.labelcolor": colours.INK, "ytick.labelcolor": colours.INK,
         "svg.hashsalt": "gnomon", "svg.fonttype": "path"}


@dataclass
class Look:
    """How all series of one label look in all panels of a chart."""
    colour: str
    marker: str
    dashes: str
    style: str


def looks(panels):
    """The look of each label of a chart. Two labels that share a colour differ in marker and dashes."""
    found, own, used = {}, cycle(colours.SERIES), {}
    for series in (series for panel in panels for series in panel["series"]):
        label = series["label"]
        if label in found:
            continue
        colour = colours.readable(series["colour"] if "colour" in series else next(own))
        alike = used.setdefault((colour, series["style"] in LINED), [])
        marker = series.get("marker") or list(MARKERS)[len(alike) % 8 if series["style"] == "points" else -1]
        dashes = DASHES[len(alike) % len(DASHES)] if series["style"] in LINED else ""
        if series.get("dashed"):
            dashes = DASHES[2]
        if not series.get("labelled"):
            alike.append(label)
        found[label] = Look(colour, marker, dashes, series["style"])
    return found


def coordinates(points, which):
    """All values of points along an axis, "x" or "y"."""
    found = (value for point, style in points for value in
             (point[:1] if which == "x" else point[1:] if style == "band" else point[1:2]))
    return [value for value in found if value is not None]


def pareto_front(points):
    """The points that no other beats in both coordinates, from left to right."""
    front = []
    for x, y in sorted(points):
        if not front or y < front[-1][1]:
            front.append((x, y))
    return front


class Areas:
    """From the third number of a point to the area of its mark, for all panels of a chart."""

    def __init__(self, panels):
        points = [point for panel in panels for series in panel["series"] if series["style"] == "points"
                  for point in series["points"]]
        self.largest = max((point[2] for point in points if len(point) > 2 and point[2] is not None), default=0)

    def __call__(self, size=None):
        return max(LARGEST_AREA * size / self.largest, 6) if size and self.largest > 0 else AREA


def draw_series(axes, series, look, area):
    """Draws one series; returns its points that can be drawn."""
    style, colour = series["style"], look.colour
    if style == "rule":
        points = [[x, None] if x is not None else [None, y] for x, y in series["points"]]
    else:
        points = [point for point in series["points"] if None not in point]
    line = {"color": colour, "lw": 1.6, "zorder": 2}
    if look.dashes:
        line["dashes"] = [float(length) for length in look.dashes.split()]
    if style == "rule":
        for x, y in points:
            rule = {**line, "lw": 1}
            axes.axhline(y, **rule) if x is None else axes.axvline(x, **rule)
    elif style == "band":
        x, low, high = zip(*points) if points else ((), (), ())
        axes.fill_between(x, low, high, color=colour, alpha=0.22, lw=0, zorder=1)
    elif style == "points":
        axes.scatter([p[0] for p in points], [p[1] for p in points], s=[area(*p[2:]) for p in points], c=colour,
                     marker=MARKERS[look.marker], alpha=0.8, edgecolors=colours.SURFACE, linewidths=0.6, zorder=3)
    else:
        axes.plot([p[0] for p in points], [p[1] for p in points], marker=MARKERS[look.marker], ms=4.5,
                  drawstyle="steps-post" if style == "steps" else "default", **line)
    return points


def along(corners, steps=False):
    """Points on the lines between corners, in pixels."""
    ends = numpy.array(corners)
    if steps:
        ends = numpy.repeat(ends, 2, axis=0)[:-1]
        ends[1::2, 0] = ends[2::2, 0]
    return [a + (b - a) * t for a, b in zip(ends[:-1], ends[1:]) for t in numpy.linspace(0, 1, 24)]


def rule_place(axes, x, y):
    """Where the label of a rule belongs, in pixels: at the top of an upright one, at the right of a level one."""
    right, top = axes.transAxes.transform((0.98, 0.97))
    if x is None:
        return right, axes.transData.transform((1, y))[1]
    return axes.transData.transform((x, 1))[0], top


def marks_and_labels(axes, panel, found, area, drawn):
    """What labels must not hide, the points of lines, and the labels."""
    scale = axes.figure.dpi / 72
    marks, trail, wanted = [], [], []
    for series, points in zip(panel["series"], drawn):
        look, style = found[series["label"]], series["style"]
        colour = colours.readable(look.colour, colours.TEXT)
        if style == "rule":
            places = [rule_place(axes, x, y) for x, y in points]
            radii = [0] * len(points)
        else:
            places = [tuple(axes.transData.transform(point[:2])) for point in points]
            size = [area(*p[2:]) if style == "points" else 20 if look.marker != "none" else 0 for p in points]
            radii = [math.sqrt(s) / 2 * scale for s in size]
            marks += [(x - r, y - r, x + r, y + r) for (x, y), r in zip(places, radii) if r]
        if style in LINED and len(places) > 1:
            trail += along(places, style == "steps")
        if series.get("labelled") and places:
            best = 0 if style == "rule" or style == "points" else -1
            wanted.append(labels.Label(wrapped(series["label"], 26), places[best], radii[best], colour))
        for place, radius, text in zip(places, radii, series.get("texts", ())):
            wanted.append(labels.Label(text, place, radius, colour, 7))
    return marks, trail, wanted


def draw_once(panel, found, area, height):
    """One try: the figure, and whether all labels are free."""
    figure = Figure(figsize=(WIDTH, height), dpi=DPI, facecolor=colours.SURFACE, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot(facecolor=colours.SURFACE)
    crowded = any(series.get("labelled") for series in panel["series"])
    axes.margins(*((0.1, 0.1) if crowded else (0.04, 0.06)))
    if panel.get("title"):
        title = "\n".join(wrapped(part, 50) for part in panel["title"].split("\n"))
        axes.set_title(title, fontsize=9.5, loc="left", parse_math=False)
    drawn = [draw_series(axes, series, found[series["label"]], area) for series in panel["series"]]
    shown = [(point, series["style"]) for series, points in zip(panel["series"], drawn) for point in points]
    for which in "xy":
        set_axis(axes, which, panel[which], coordinates(shown, which))
    front = []
    if panel.get("pareto"):
        front = pareto_front([point[:2] for point, style in shown if style == "points"])
        if front:
            axes.step(*zip(*front), where="post", color=colours.FRONT, lw=1.3, zorder=1)
    figure.draw_without_rendering()
    thin_ticks(axes)
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    marks, trail, wanted = marks_and_labels(axes, panel, found, area, drawn)
    trail += along(axes.transData.transform(front), steps=True) if len(front) > 1 else []
    return figure, labels.write(axes, wanted, marks, trail)


def draw(panel, found, area):
    """A panel's figure, as high as its labels need. found: looks() of the chart; area: the Areas of it."""
    with matplotlib.rc_context(STYLE):
        height = HEIGHT
        for _ in range(GROWTHS):
            figure, free = draw_once(panel, found, area, height)
            if free:
                break
            height *= GROWTH
        return figure
