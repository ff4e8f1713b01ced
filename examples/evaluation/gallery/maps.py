"""Draws map blocks: a value over two parameters as a heat map, with the region where it fails outlined."""

import math

import matplotlib
import numpy
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure
from matplotlib.patheffects import Normal, Stroke
from matplotlib.ticker import FuncFormatter, MaxNLocator

import colours
from charts import DPI, STYLE
from scales import set_axis, spoken, thin_ticks, wrapped

WIDTH, HEIGHT, KEY_HEIGHT = 3.6, 3.1, 0.75  # of a map and of the key, in inches
COLUMNS, KEY_ASPECT = 4, 0.1  # of a sheet, and of the key on it
DECADES = 4  # that are told apart on each side of the threshold
COLOUR_MAP = "RdYlBu_r"  # blue holds, red fails
OUTLINE, HALO, NOTHING = "#000000", "#ffffff", "#9aa3ab"  # the same in both schemes, as cells are


def edges(values, scale):
    """The borders of cells around values: midway, and as far outside as the next border is inside."""
    places = numpy.log(values) if scale == "log" else numpy.asarray(values, float)
    if len(places) == 1:
        borders = numpy.array([places[0] - 0.5, places[0] + 0.5])
    else:
        middle = (places[1:] + places[:-1]) / 2
        borders = numpy.concatenate(([2 * places[0] - middle[0]], middle, [2 * places[-1] - middle[-1]]))
    return numpy.exp(borders) if scale == "log" else borders


def outline(excess, x, y):
    """The segments around cells that fail, along the borders x and y; none between a cell that fails and one without a
    value. excess: above 0 where a cell fails, NaN where it has no value."""
    padded = numpy.pad(excess, 1, constant_values=-1)
    fails, holds = padded > 0, padded <= 0
    beside = (fails[1:-1, 1:] & holds[1:-1, :-1]) | (holds[1:-1, 1:] & fails[1:-1, :-1])
    above = (fails[1:, 1:-1] & holds[:-1, 1:-1]) | (holds[1:, 1:-1] & fails[:-1, 1:-1])
    return ([[(x[i], y[j]), (x[i], y[j + 1])] for j, i in zip(*numpy.nonzero(beside))]
            + [[(x[i], y[j]), (x[i + 1], y[j])] for j, i in zip(*numpy.nonzero(above))])


class Shades:
    """The colours of values, the same for all maps of a block; the threshold has the middle one."""

    def __init__(self, block):
        self.log = block.get("scale", "log") == "log"
        self.threshold = block["threshold"]
        known = [value for shown in block["maps"] for row in shown["values"] for value in row if value is not None]
        centre, values = self.place(self.threshold), [self.place(value) for value in known]
        low, high = min(values, default=centre), max(values, default=centre)
        if self.log:
            low, high = max(low, centre - DECADES), min(high, centre + DECADES)
        reach = max(high - centre, centre - low, 1e-9)
        self.norm = TwoSlopeNorm(centre, min(low, centre - 0.2 * reach), max(high, centre + 0.2 * reach))

    def place(self, value):
        """Where a value stands on the scale of colours."""
        if not self.log:
            return value
        return math.log10(max(value, self.threshold * 10.0**-(DECADES + 1)))

    def value(self, place):
        return 10**place if self.log else place


def failures(shown, threshold):
    """How many cells of a map fail, and how many have a value."""
    known = [value for row in shown["values"] for value in row if value is not None]
    return sum(value > threshold for value in known), len(known)


def figure_of(width, height, rows=1, columns=1):
    figure = Figure(figsize=(width, height), dpi=DPI, facecolor=colours.SURFACE, layout="constrained")
    FigureCanvasAgg(figure)
    return figure, figure.subplots(rows, columns, squeeze=False)


def finish(figure):
    figure.draw_without_rendering()
    for axes in figure.axes:
        thin_ticks(axes)
    return figure


def fill(axes, block, shown, shades):
    """Draws one map."""
    borders = [edges(block[which]["values"], block[which]["scale"]) for which in "xy"]
    places = numpy.array([[math.nan if value is None else shades.place(value) for value in row]
                          for row in shown["values"]])
    axes.grid(False)
    axes.set_facecolor(NOTHING)
    axes.pcolormesh(*borders, numpy.ma.masked_invalid(places), cmap=COLOUR_MAP, norm=shades.norm, zorder=1,
                    rasterized=True)
    excess = numpy.array(shown["values"], float) - block["threshold"]
    axes.add_collection(LineCollection(
        outline(excess, *borders), colors=OUTLINE, linewidths=1.6, capstyle="round", zorder=3,
        path_effects=[Stroke(linewidth=3.4, foreground=HALO), Normal()]), autolim=False)
    for which, (first, *_, last) in zip("xy", borders):
        set_axis(axes, which, {"least": first, "most": last, **block[which]}, block[which]["values"])
    axes.set_title(wrapped(shown["label"], 40), fontsize=9.5, loc="left", parse_math=False)


def fill_key(axes, block, shades):
    """Draws the scale of colours, with the threshold marked."""
    low, high = shades.norm.vmin, shades.norm.vmax
    axes.grid(False)
    axes.pcolormesh(numpy.linspace(low, high, 257), [0, 1], numpy.linspace(low, high, 256)[None], cmap=COLOUR_MAP,
                    norm=shades.norm, rasterized=True)
    axes.axvline(shades.place(block["threshold"]), color=OUTLINE, lw=1.6,
                 path_effects=[Stroke(linewidth=3.4, foreground=HALO), Normal()])
    axes.set_xlim(low, high)
    axes.set_yticks([])
    axes.spines["left"].set_visible(False)
    axes.xaxis.set_major_locator(MaxNLocator(6, integer=shades.log))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda place, _: spoken(shades.value(place))))
    axes.set_xlabel(wrapped(block["label"], 44), parse_math=False)
    axes.set_title(f"fails above {spoken(block['threshold'])}", fontsize=8.5, loc="left")


def draw(block, shown, shades):
    """The figure of one map."""
    with matplotlib.rc_context(STYLE):
        figure, ((axes,),) = figure_of(WIDTH, HEIGHT)
        fill(axes, block, shown, shades)
        return finish(figure)


def draw_key(block, shades):
    """The figure of the scale of colours."""
    with matplotlib.rc_context(STYLE):
        figure, ((axes,),) = figure_of(WIDTH, KEY_HEIGHT)
        fill_key(axes, block, shades)
        return finish(figure)


def draw_sheet(block, shades):
    """The figure of all maps together, for where there is no page around them."""
    with matplotlib.rc_context(STYLE):
        rows = -(-(len(block["maps"]) + 1) // COLUMNS)
        figure, panels = figure_of(COLUMNS * WIDTH, rows * HEIGHT, rows, COLUMNS)
        key, *others = panels.flat
        fill_key(key, block, shades)
        key.set_box_aspect(KEY_ASPECT)
        for axes, shown in zip(others, block["maps"]):
            fill(axes, block, shown, shades)
        for axes in others[len(block["maps"]):]:
            axes.remove()
        return finish(figure)
