"""The charts of shadows in motion."""

from itertools import cycle

import numpy
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator

from old_charts import plt, save, set_error_scale

COLOURS = ("#7f7f7f", "#9467bd", "#ff7f0e", "#2ca02c", "#d62728", "#17becf", "#8c6d31", "#e377c2")
SATURATED = 0.98  # how dark the darkest channel of an error's colour is at most
SAMPLES = (8, 20, 64)  # of a time-dependent shadow map
MARKERS = ("^", "s", "D", "o", "v", "P", "X", "*", "<", ">")


def millis(row):
    """Of one picture: the map, and all receivers."""
    return row["build_ms"] + 1e-6 * row["receivers"] * row["ns_per_receiver"]


def is_accumulation(row):
    return row["method"].startswith("accumulation")


def maps(row):
    """How many are accumulated."""
    return row["method"].split()[-1]


def parts(row):
    """The kind of map, and how receivers ask it."""
    kind, _, how = row["method"].rpartition(", ")
    return kind, how


def in_order(values):
    return list(dict.fromkeys(values))


def label_decades(axis):
    """Every decade has a label, and where there are few of them some more have one."""
    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 100 * low else (1,)))
    axis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axis.set_minor_formatter(FuncFormatter(lambda x, _: ""))


def equal_error(panels, folder, name):
    """panels: a title, rows, the time of a row, which goes to the right, and what that is; errors go up."""
    ranges = [row for _, rows, _, _ in panels for row in rows if not is_accumulation(row)]
    colours = dict(zip(in_order(parts(row)[1] for row in ranges), cycle(COLOURS)))
    markers = dict(zip(in_order(parts(row)[0] for row in ranges), cycle(MARKERS)))
    columns = min(4, len(panels))
    lines = -(-len(panels) // columns)
    width, height = max(3.5 * columns, 12), 3 * lines + 1.1
    figure, axes = plt.subplots(lines, columns, figsize=(width, height), squeeze=False)
    figure.subplots_adjust(left=0.7 / width, right=0.99, top=1 - 0.45 / height, bottom=1.3 / height, wspace=0.25, hspace=0.6)
    for unused in axes.flat[len(panels):]:
        unused.remove()
    for panel, (title, rows, time, label) in zip(axes.flat, panels):
        panel.set_title(title, fontsize=9)
        panel.set_xscale("log")
        set_error_scale(panel, [row["rmse"] for row in rows])
        accumulated = [row for row in rows if is_accumulation(row)]
        panel.plot([time(row) for row in accumulated], [row["rmse"] for row in accumulated], "-", color="black", lw=1.2,
                   marker=".")
        for row in rows:
            if is_accumulation(row):
                panel.annotate(maps(row), (time(row), row["rmse"]), (3, 3), textcoords="offset points", fontsize=7)
            else:
                kind, how = parts(row)
                panel.plot(time(row), row["rmse"], markers[kind], color=colours[how], ms=6, alpha=0.75,
                           markeredgecolor="white", markeredgewidth=0.5, zorder=3)
        panel.tick_params(labelsize=8)
        panel.margins(x=0.08, y=0.1)
        label_decades(panel.xaxis)
        panel.set_xlabel(label, fontsize=8, labelpad=1)
    for panel in axes[:, 0]:
        panel.set_ylabel("RMSE")
    handles = [Line2D([], [], color="black", marker=".", label="accumulation of as many maps"),
               *(Line2D([], [], lw=0, marker="o", color=c, label=how) for how, c in colours.items()),
               *(Line2D([], [], lw=0, marker=m, color="#999999", label=kind) for kind, m in markers.items())]
    figure.legend(handles=handles, loc="lower center", ncols=-(-len(handles) // 3), frameon=False, fontsize=9)
    save(figure, folder, name)


def linear(picture):
    """From sRGB to light (IEC 61966-2-1)."""
    return numpy.where(picture <= 0.04045, picture / 12.92, ((picture + 0.055) / 1.055) ** 2.4)


def encoded(light):
    light = numpy.clip(light, 0, 1)
    return numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def strengthened(errors, gain):
    """Colours of errors `gain` times as far from white, or as far as the drivers let them be."""
    missing = 1 - errors
    strongest = numpy.maximum(missing.max(axis=2, keepdims=True), 1e-6)
    return 1 - missing * numpy.clip(SATURATED / strongest, 1, gain)


def close_ups(rows, gain, folder, name):
    """rows: a title, an inset, and pictures of (file, caption, whether it shows errors); these are made `gain` times as
    strong."""
    columns = len(rows[0][2])
    figure, panels = plt.subplots(len(rows), columns, figsize=(2.8 * columns, 3 * len(rows)), squeeze=False)
    figure.subplots_adjust(left=0.03, right=0.995, top=1 - 0.25 / len(rows) / 3, bottom=0.005, wspace=0.03, hspace=0.04)
    for axes, (_, caption, _) in zip(panels[0], rows[0][2]):
        axes.set_title(caption, fontsize=9)
    for line, (title, inset, pictures) in zip(panels, rows):
        line[0].set_ylabel(title, fontsize=9)
        left, top = inset["x"], inset["y"]
        for axes, (file, _, shows_errors) in zip(line, pictures):
            light = linear(plt.imread(file)[top:top + inset["height"], left:left + inset["width"], :3])
            axes.imshow(encoded(strengthened(light, gain) if shows_errors else light), interpolation="none")
            axes.set_xticks([])
            axes.set_yticks([])
            axes.grid(False)
            for spine in axes.spines.values():
                spine.set(visible=True, color="#dde1e5")
    save(figure, folder, name)


def ratio(value):
    return f"1/{1 / value:g}" if value < 1 else f"{value:g}"


def cubes(rows, resolution, folder, name):
    """What maps take, against number, speed and size of cubes."""
    quantities = (("bytes", "MiB", 2**-20), ("build_ms", "ms, one core", 1), ("ns_per_pair", "ns per texel and triangle", 1))
    small, large = sorted({row["half_extent"] for row in rows})
    number = max(in_order(row["count"] for row in rows), key=[row["count"] for row in rows].count)
    views = (("count", "cubes", f"cubes of half-extent {small:g}, speed 1", lambda row: row["factor"] == 1),
             ("factor", "speed", f"{number} cubes of half-extent {small:g}", lambda row: row["count"] == number),
             ("factor", "speed", f"{number} cubes of half-extent {large:g}", lambda row: row["count"] == number))
    methods = dict(zip(in_order(m["method"] for row in rows for m in row["maps"]), zip(cycle(COLOURS), cycle(MARKERS))))
    figure, panels = plt.subplots(len(quantities), len(views), figsize=(13, 9.5), sharey="row")
    figure.subplots_adjust(left=0.06, right=0.99, top=0.96, bottom=0.13, wspace=0.06, hspace=0.27)
    for i, (column, (free, label, title, chosen)) in enumerate(zip(panels.T, views)):
        size = large if i == 2 else small
        shown = sorted((row for row in rows if row["half_extent"] == size and chosen(row)), key=lambda row: row[free])
        column[0].set_title(title, fontsize=10)
        places = [row[free] for row in shown]
        for axes, (key, _, scale) in zip(column, quantities):
            def line(method, of, style):
                values = [scale * m[of] for row in shown for m in row["maps"] if m["method"] == method]
                colour, marker = methods[method]
                if any(values):
                    axes.plot(places, values, style, color=colour, marker=marker, ms=5, lw=1.3, alpha=0.85)

            for method in methods:
                line(method, key, "-")
                if key == "bytes":
                    line(method, "building_bytes", ":")
            if key == "bytes":
                for samples in SAMPLES:
                    level = scale * 4 * samples * resolution**2
                    axes.axhline(level, color="black", lw=0.8, ls="--", alpha=0.6)
                    axes.annotate(f"{samples} samples", (1, level), xycoords=("axes fraction", "data"), ha="right", va="center",
                                  fontsize=7, bbox={"color": "white", "alpha": 0.7, "pad": 0.5})
            axes.set_xscale("log", base=2)
            axes.set_yscale("log")
            axes.set_xticks(places, [ratio(place) for place in places])
            axes.minorticks_off()
            axes.set_xlabel(label)
    for axes, (_, unit, _) in zip(panels[:, 0], quantities):
        axes.set_ylabel(unit)
        label_decades(axes.yaxis)
    handles = [Line2D([], [], color=colour, marker=marker, label=method) for method, (colour, marker) in methods.items()]
    handles += [Line2D([], [], color="black", ls=":", label="the same with the fragments that building needs"),
                Line2D([], [], color="black", lw=0.8, ls="--", label="time-dependent shadow map")]
    figure.legend(handles=handles, loc="lower center", ncols=4, frameon=False, fontsize=9)
    save(figure, folder, name)
