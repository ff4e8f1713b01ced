"""The axes of charts: scales, limits, ticks and their text."""

import math
import textwrap

from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter, NullLocator, SymmetricalLogLocator

GAP = 3  # pixels between the labels of two ticks


def wrapped(text, width):
    """The text in lines of about the same length, at most `width` letters each where words allow it."""
    def lines(width):
        return textwrap.wrap(text, width, break_long_words=False)

    narrow = width
    while narrow > 8 and len(lines(narrow - 1)) == len(lines(width)):
        narrow -= 1
    return "\n".join(lines(narrow))


def spoken(value):
    """A number as the label of a tick."""
    if value == 0 or 1e-3 <= abs(value) < 1e6:
        return f"{value:,.6g}"
    exponent = math.floor(math.log10(abs(value)) + 1e-9)
    mantissa = value / 10**exponent
    return f"$10^{{{exponent}}}$" if math.isclose(mantissa, 1) else f"${mantissa:.3g}\\cdot10^{{{exponent}}}$"


def log_locator(values):
    """Decades, and more in between where there are few of them."""
    ratio = max(values, default=1) / min(values, default=1)
    return LogLocator(subs=(1, 1.5, 2, 3, 5, 7) if ratio < 12 else (1, 2, 5) if ratio < 150 else (1,))


def set_axis(axes, which, axis, values):
    """Sets scale, limits, ticks and label of "x" or "y". A logarithmic axis with values that it cannot show is linear
    below the least that it can show."""
    side = getattr(axes, f"{which}axis")
    set_scale, set_limits = getattr(axes, f"set_{which}scale"), getattr(axes, f"set_{which}lim")
    scale, threshold, least = axis["scale"] if values else "linear", axis.get("threshold"), axis.get("least")
    if scale == "log" and min(values, default=1) <= 0:
        scale, threshold = "symlog", min((value for value in values if value > 0), default=1)
    if scale == "symlog":
        set_scale("symlog", linthresh=threshold, linscale=0.4)
        side.set_major_locator(SymmetricalLogLocator(base=10, linthresh=threshold))
        if least is None and min(values, default=0) >= 0:
            least = -0.6 * threshold
    else:
        set_scale(scale)
        side.set_major_locator(log_locator(values) if scale == "log" else MaxNLocator(6, steps=(1, 2, 2.5, 5, 10)))
    side.set_major_formatter(FuncFormatter(lambda value, _: spoken(value)))
    side.set_minor_formatter(NullFormatter())
    side.set_minor_locator(NullLocator())
    if "ticks" in axis:
        places = [tick if isinstance(tick, list) else (tick, spoken(tick)) for tick in axis["ticks"]]
        side.set_ticks([place for place, _ in places], [text for _, text in places])
    axes.autoscale_view()
    if (least, axis.get("most")) != (None, None):
        set_limits(least, axis.get("most"))
    side.set_label_text(wrapped(axis["label"], 52 if which == "x" else 46), parse_math=False)


def shown_ticks(side):
    """The ticks of an axis that lie in its view and have a text."""
    begin, end = sorted(side.get_view_interval())
    slack = 1e-9 * (end - begin)
    return [tick for tick in side.get_major_ticks() if begin - slack <= tick.get_loc() <= end + slack and
            tick.label1.get_visible() and tick.label1.get_text()]


def thin_ticks(axes):
    """Hides the labels of ticks that would touch the one before."""
    renderer = axes.figure.canvas.get_renderer()
    for side, low, high in ((axes.xaxis, 0, 2), (axes.yaxis, 1, 3)):
        boxes = [(tick.label1.get_window_extent(renderer).extents, tick) for tick in shown_ticks(side)]
        free = -math.inf
        for box, tick in sorted(boxes, key=lambda pair: pair[0][low]):
            if box[low] < free + GAP:
                tick.label1.set_visible(False)
            else:
                free = box[high]
