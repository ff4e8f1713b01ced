"""The legends of charts: labels that stand beside no series, the Pareto front, and the sizes of marks."""

import math
from html import escape

import charts
import colours
from markup import both

# Of the markers that charts draw, in a field of 28 x 16.
SHAPES = {"circle": '<circle cx="14" cy="8" r="4.5"/>', "square": '<path d="M10 4h8v8h-8z"/>',
          "triangle": '<path d="M14 3l5 9h-10z"/>', "diamond": '<path d="M14 2.5l5 5.5l-5 5.5l-5 -5.5z"/>',
          "down": '<path d="M14 13l5 -9h-10z"/>', "plus": '<path d="M12 3h4v3h3v4h-3v3h-4v-3h-3v-4h3z"/>',
          "cross": '<path d="M10 3l4 3l4 -3l2 2l-3 3l3 3l-2 2l-4 -3l-4 3l-2 -2l3 -3l-3 -3z"/>',
          "star": '<path d="M14 2l1.8 4.2h4.2l-3.4 2.7l1.3 4.6l-3.9 -2.8l-3.9 2.8l1.3 -4.6l-3.4 -2.7h4.2z"/>',
          "none": ""}
FRONT = charts.Look(colours.FRONT, "none", "", "line")


def spoken(value):
    """A number with four digits that count, all of them where it is large."""
    if 1e4 <= abs(value) < 1e15:
        return f"{value:,.0f}"
    return f"{value:.4g}" if value == 0 or abs(value) >= 1e-3 else f"{value:.2e}"


def entry(label, look):
    if look.style == "band":
        sign = '<rect x="1" y="3" width="26" height="10" opacity="0.35"/>'
    else:
        dashes = f' stroke-dasharray="{look.dashes}"' if look.dashes else ""
        line = f'<path d="M0 8h28" stroke="currentColor" stroke-width="2"{dashes}/>'
        sign = ("" if look.style == "points" else line) + SHAPES[look.marker]
    return (f'<li><svg class="sign" viewBox="0 0 28 16" width="28" height="16" aria-hidden="true" fill="currentColor" '
            f"{both(look.colour)}>{sign}</svg>{escape(label)}</li>")


def size_entry(value, size, area):
    radius = math.sqrt(area(value)) / 2 * charts.DPI / 72
    across, centre = f"{2 * radius + 1:.1f}", f"{radius + 0.5:.1f}"
    return (f'<li><svg class="sign" width="{across}" height="{across}" aria-hidden="true" fill="currentColor" '
            f'{both(colours.FRONT)}><circle cx="{centre}" cy="{centre}" r="{radius:.1f}"/></svg>'
            f"{escape(spoken(value))} {escape(size)}</li>")


def legend(panels, looks, area):
    """The legend of panels that are shown together."""
    all_series = [series for panel in panels for series in panel["series"]]
    named = dict.fromkeys(series["label"] for series in all_series if not series.get("labelled"))
    entries = [entry(label, looks[label]) for label in named]
    if any(panel.get("pareto") for panel in panels):
        entries.append(entry("Pareto front: no other point is better in both", FRONT))
    for size in dict.fromkeys(panel["size"] for panel in panels if panel.get("size")):
        points = [point for panel in panels if panel.get("size") == size for series in panel["series"]
                  if series["style"] == "points" for point in series["points"]]
        values = sorted({point[2] for point in points if len(point) > 2 and point[2]})
        some = dict.fromkeys([values[0], values[len(values) // 2], values[-1]] if values else [])
        entries += [size_entry(value, size, area) for value in some]
    return f'<ul class="legend">{"".join(entries)}</ul>' if entries else ""
