"""The gallery's charts, drawn from what the drivers left behind."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, LogLocator, SymmetricalLogLocator

plt.rcParams.update({
    "font.family": "sans-serif", "font.size": 10, "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "grid.color": "#e6e6e6", "axes.axisbelow": True, "svg.hashsalt": "gnomon", "svg.fonttype": "none",
})

FAMILY_COLOURS = {"PCF": "#222222", "VSM": "#8c6d31", "LVSM": "#c49a4a", "ESM": "#9467bd", "EVSM": "#d62728", "CSM": "#7f7f7f",
                  "MSM": "#1f77b4", "MSM6": "#2ca02c"}
ERRORS = {"leak": "leak (mean of what is too bright)", "acne": "acne (mean of what is too dark)", "rmse": "RMSE"}


def save(figure, folder, name):
    """Writes PNG and SVG aside, then renames them."""
    for suffix, options in (("png", {"dpi": 110}), ("svg", {"metadata": {"Date": None}})):
        part = folder / f"{name}.{suffix}.part"
        figure.savefig(part, format=suffix, **options)
        part.replace(folder / f"{name}.{suffix}")
    plt.close(figure)


def pareto_front(points):
    """The points that no other beats in both coordinates, from left to right."""
    front = []
    for x, y in sorted(points):
        if not front or y < front[-1][1]:
            front.append((x, y))
    return front


def overlap(a, b):
    return max(0, min(a[2], b[2]) - max(a[0], b[0])) * max(0, min(a[3], b[3]) - max(a[1], b[1]))


def place_labels(axes, points, labels):
    """Puts each label where it hides the fewest points and other labels; points are x, y, radius in points."""
    renderer = axes.figure.canvas.get_renderer()
    scale = axes.figure.dpi / 72
    frame = axes.get_window_extent(renderer).extents
    centres = [axes.transData.transform((x, y)) for x, y, _ in points]
    taken = [(x - r * scale, y - r * scale, x + r * scale, y + r * scale) for (x, y), (_, _, r) in zip(centres, points)]
    for (x, y, radius), (px, py), label in zip(points, centres, labels):
        text = axes.annotate(label, (x, y), (0, 0), textcoords="offset points", ha="center", va="center", fontsize=8, color=colour(label),
                             arrowprops={"arrowstyle": "-", "lw": 0.4, "color": colour(label)})
        extent = text.get_window_extent(renderer)
        width, height = extent.width / 2, extent.height / 2
        candidates = []
        for reach in (2, 10, 22, 36):
            for side, up in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)):
                distance = (radius + reach) * scale
                dx, dy = side * (distance + width), up * (distance + height)
                box = (px + dx - width, py + dy - height, px + dx + width, py + dy + height)
                outside = 4 * width * height - overlap(box, frame)
                hidden = sum(overlap(box, other) for other in taken)
                candidates.append((hidden + 10 * outside + 4 * reach, dx / scale, dy / scale, reach, box))
        _, dx, dy, reach, box = min(candidates)
        text.set_position((dx, dy))
        text.arrow_patch.set_visible(reach > 2)
        taken.append(box)


def set_error_scale(axes, errors):
    """Logarithmic, and linear below 1e-5 where there are such errors; every decade has some labelled ticks."""
    ticks = (1, 2, 5)
    if min(errors) > 1e-5:
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=ticks))
    else:
        axes.set_yscale("symlog", linthresh=1e-5, linscale=0.4)
        axes.yaxis.set_major_locator(SymmetricalLogLocator(base=10, linthresh=1e-5))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda y, _: "" if 0 < y < 9e-6 else f"{y:g}"))
    axes.yaxis.set_minor_formatter(FuncFormatter(lambda y, _: ""))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))


def colour(method):
    return FAMILY_COLOURS.get(method.split()[0], "#17becf")


def speed_against_accuracy(rows, folder, name, title):
    """rows: one for each method, all with the same reference."""
    figure, panels = plt.subplots(1, 3, figsize=(14, 5.4))
    figure.subplots_adjust(left=0.06, right=0.99, top=0.9, bottom=0.2, wspace=0.22)
    figure.suptitle(title)
    for axes, (key, label) in zip(panels, ERRORS.items()):
        axes.set_xscale("log")
        set_error_scale(axes, [row[key] for row in rows])
        axes.set_xlabel("ns per receiver, one thread, kernel alone")
        axes.set_ylabel(label)
        front = pareto_front([(row["ns_per_receiver"], row[key]) for row in rows])
        axes.step(*zip(*front), where="post", color="#bbbbbb", lw=1.5, zorder=1)
        areas = [12 * row["bytes_per_texel"] for row in rows]
        axes.scatter([row["ns_per_receiver"] for row in rows], [row[key] for row in rows], s=areas,
                     c=[colour(row["method"]) for row in rows], alpha=0.75,
                     edgecolors="white", zorder=2)
        axes.margins(x=0.2, y=0.12)
    figure.canvas.draw()
    for axes, key in zip(panels, ERRORS):
        points = [(row["ns_per_receiver"], row[key], (12 * row["bytes_per_texel"]) ** 0.5 / 2) for row in rows]
        place_labels(axes, points, [row["method"] for row in rows])
    sizes = [Line2D([], [], marker="o", lw=0, color="#cccccc", markersize=(12 * b) ** 0.5, label=f"{b} bytes per texel")
             for b in (4, 16, 32)]
    front = Line2D([], [], color="#bbbbbb", label="Pareto front")
    figure.legend(handles=[front, *sizes], loc="lower center", ncols=4, frameon=False)
    save(figure, folder, name)


def steps(depths, weights):
    """The distribution function of some depths, ready to be drawn from -1 to 1."""
    xs, ys, sum_ = [-1.2], [0.0], 0.0
    for z, w in sorted(zip(depths, weights)):
        xs += [z, z]
        ys += [sum_, sum_ + w]
        sum_ += w
    return xs + [1.2], ys + [sum_]


def bounds(facts, folder, name):
    figure, panels = plt.subplots(1, 3, figsize=(14, 4.8), sharey=True)
    figure.subplots_adjust(left=0.05, right=0.99, top=0.93, bottom=0.2, wspace=0.06)
    colours = ("#d62728", "#ff7f0e", "#2ca02c", "#1f77b4")
    truth = steps(facts["depths"], facts["weights"])
    for axes, b in zip(panels, facts["bounds"]):
        axes.set_title(f"m = {b['moments']} moments")
        axes.fill_between(b["receivers"], b["lower"], b["upper"], color="#dfe7f1", label="between the bounds")
        axes.plot(b["receivers"], b["lower"], color="#5b7ea8", lw=1)
        axes.plot(b["receivers"], b["upper"], color="#5b7ea8", lw=1)
        for line_colour, r in zip(colours, b["representations"]):
            axes.plot(*steps(r["depths"], r["weights"]), color=line_colour, lw=1.2, alpha=0.85,
                      label=f"representation, $z_f$ = {r['receiver']:g}")
            axes.axvline(r["receiver"], color=line_colour, lw=0.6, ls=":")
        axes.plot(*truth, color="black", lw=2, label="ground truth")
        axes.set_xlim(-1, 1)
        axes.set_xticks((-1, -0.5, 0, 0.5, 1))
        axes.set_ylim(-0.02, 1.02)
        axes.set_xlabel("depth")
    panels[0].set_ylabel("shadow intensity")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="lower center", ncols=6, frameon=False)
    save(figure, folder, name)
