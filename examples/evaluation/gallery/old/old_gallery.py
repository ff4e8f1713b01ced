"""The page of drivers that leave no blocks yet."""

import json
from html import escape
from pathlib import Path
from string import Template

import old_charts as charts
from page import chart, legend_of_errors, picture, table

HERE = Path(__file__).resolve().parent


def read(file):
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise SystemExit(f"{file}: {error}") from None


class Rows:
    """The report's rows of one scene."""

    def __init__(self, report, facts):
        self.scene = facts["scene"]
        scenes = {self.scene, *(f"{self.scene}: {inset['name']}" for inset in facts["insets"])}
        self.rows = [row for row in report if row["scene"] in scenes]
        if {row["method"] for row in self.rows} < {method["method"] for method in facts["methods"]}:
            raise SystemExit(f"report.json: rows of the scene {self.scene} are missing; run the demo again")

    def find(self, method, reference, part=None, lanes=None):
        """With no lanes given the row with most of them, None where there is none."""
        scene = f"{self.scene}: {part}" if part else self.scene
        found = [row for row in self.rows if (row["method"], row["reference"], row["scene"]) == (method, reference, scene)
                 and lanes in (None, row["lanes"])]
        return max(found, key=lambda row: row["lanes"], default=None)


def numbers(facts, rows, of_insets):
    """of_insets: the error that is shown of each inset."""
    lanes = max(row["lanes"] for row in rows.rows)
    insets = [inset["name"] for inset in facts["insets"]]

    def swatch(inset):
        return f'<span class="swatch" style="background: {inset["colour"]}"></span>{of_insets}: {escape(inset["name"])}'

    heads = ["method", "format", "bytes per texel", "leak", "acne", "acne without bias", "largest darkness", "darkened",
             *(swatch(inset) for inset in facts["insets"]), "RMSE", "RMSE, traced", "ns, one by one", f"ns, packs of {lanes}",
             "map, ms"]
    records = []
    for method in facts["methods"]:
        name = method["method"]
        one = rows.find(name, "filtered", lanes=1)
        packed = rows.find(name, "filtered", lanes=lanes) if lanes > 1 else None
        records.append([name, method["format"], one["bytes_per_texel"], one["leak"], one["acne"],
                        one["acne_unbiased"], one["max_dark"], one["darkened"],
                        *(rows.find(name, "filtered", part)[of_insets] for part in insets), one["rmse"],
                        rows.find(name, "traced")["rmse"], one["ns_per_receiver"],
                        packed and packed["ns_per_receiver"], one["build_ms"]])
    # The best of each column, percentage-closer filtering aside: it is the reference.
    best = [None] * len(heads)
    for column in range(3, len(heads)):
        values = [record[column] for record in records if record[0] != "PCF" and record[column] is not None]
        best[column] = min(values, default=None)

    def cell(record, column):
        value = record[column]
        if isinstance(value, str):
            return value, escape(value)
        if value is None:
            return "1e99", "&ndash;"
        if column in (2, len(heads) - 1):
            text = f"{value:.0f}"
        elif column >= len(heads) - 3:
            text = f"{value:.1f}"
        else:
            text = f"{1e3 * value:.2f}"
        return value, text, value == best[column] and record[0] != "PCF"

    return table(heads, ([cell(record, c) for c in range(len(heads))] for record in records))


def chooser(folder, facts, initial):
    choices = [("filtered.png", "reference: percentage-closer filtering, same weights"),
               ("traced.png", "reference: ray tracing"),
               *((f"{m['file']}.png", m["method"]) for m in facts["methods"])]
    options = "".join(f'<option value="{folder}/{file}"{" selected" if name == initial else ""}>{escape(name)}</option>'
                      for file, name in choices)
    return f'<div><select aria-label="method">{options}</select><img src="" alt=""></div>'


def comparison(out, folder, facts, report, introduction, first="EVSM 64 bit", second="MSM 64 bit", of_insets="leak"):
    rows = Rows(report, facts)
    for reference in ("filtered", "traced"):
        chosen = [rows.find(m["method"], reference) for m in facts["methods"]]
        if reference == "filtered":
            chosen = [row for row in chosen if row["method"] != "PCF"]
        charts.speed_against_accuracy(
            chosen, out / "gallery" / folder, f"chart-{reference}",
            "Error against percentage-closer filtering with the same weights" if reference == "filtered"
            else "Error against ray tracing")
    size = f"{facts['width']} x {facts['height']}"
    samples = facts["supersampling"] ** 2
    methods = "\n".join(
        f'<h3>{escape(m["method"])} <span class="quiet">{escape(m["format"])}</span></h3><div class="three">'
        + picture(f"{folder}/{m['file']}.png")
        + picture(f"{folder}/{m['file']}-filtered.png", "against percentage-closer filtering")
        + picture(f"{folder}/{m['file']}-traced.png", "against ray tracing") + "</div>"
        for m in facts["methods"])
    return f"""{introduction}
<p>{size} pixels with {samples} sample{"s" if samples > 1 else ""} each, {facts["receivers"]:,} receivers; a shadow map of
{facts["map_resolution"]} x {facts["map_resolution"]} texels with 4 samples each, a Gaussian of {facts["taps"]} taps in two
passes, mip levels and trilinear look-up, all rounded to the storage format. The depth bias is the rise of the
receiver's plane within {facts["bias_radius"]:g} texels, the same for all methods; no over-darkening.</p>
<h3>Two methods side by side</h3>
<div class="two">{chooser(folder, facts, first)}{chooser(folder, facts, second)}</div>
<h3>Speed against accuracy</h3>
{chart(folder, "chart-filtered", '''Reconstruction error alone: the reference filters with exactly the same weights. Lower
left is better; the line is the Pareto front, the area of a point is its memory. Kernels run on packs.''')}
{chart(folder, "chart-traced", '''Everything: the reference has the hard shadows of ray tracing, so filter width, depth bias
and resolution of the map count too. Percentage-closer filtering, which samples the whole filter region for each receiver,
runs one receiver at a time.''')}
<h3>Numbers</h3>
<p>Errors of visibility in thousandths: leak is the mean of what is too bright, acne the mean of what is too dark, with the
depth bias and without. Darkened is how many of a thousand receivers that the reference leaves at least half lit are too dark
by {1e3 * facts["too_dark"]:g} thousandths and more. Where nothing else is said, the reference is percentage-closer filtering
with the same weights. The best of each column is marked; a click sorts.</p>
{numbers(facts, rows, of_insets)}
<h3>All methods</h3>
<p>{legend_of_errors(facts)}</p>
{methods}
"""


def hard_shadows(out, folder, facts, report):
    legend = ", ".join(f'<span class="swatch" style="background: {i["colour"]}"></span>{escape(i["name"])}'
                       for i in facts["insets"])
    return "Hard shadows", comparison(out, folder, facts, report, f"""
<p>A bird's eye view of a direction sign, a fence with thin slats and a thin wall, after Figure 4 of Peters et al.,
<i>Improved Moment Shadow Maps for Translucent Occluders, Soft Shadows and Single Scattering</i> (JCGT 2017). The scene
provokes every artifact there is: where one, two or three surfaces lie between the light and the ground within one filter
region, a filter that only knows a few moments of their depths lets light through. Insets: {legend}.</p>""")


def contact(out, folder, facts, report):
    first, second = "MSM 64 bit, raised pivots", "MSM 64 bit"
    files = {m["method"]: m["file"] for m in facts["methods"]}
    errors = "".join(picture(f"{folder}/{files[name]}-filtered.png", escape(f"{name}, against percentage-closer filtering"))
                     for name in (first, second))
    legend = ", ".join(f'<span class="swatch" style="background: {i["colour"]}"></span>{escape(i["name"])}'
                       for i in facts["insets"])
    return "Contact", comparison(out, folder, facts, report, f"""
<p>Duckboards on the ground at noon. Next to a slat a filter region holds two close surfaces, and what is lit is the
farther one. Storage rounds moments, and a method that makes too much of the rounded ones darkens the ground there: raised
pivots, the default of moment shadow maps until it was found to do so, show specks. The certified bound that took its
place shows none. The insets, by the signed depth between slat and ground: {legend}.</p>
<div class="two">{errors}</div>
<p>{legend_of_errors(facts)}</p>""", first, second, "darkened")


def model(out, folder, facts, report):
    return f"Model: {facts['scene']}", comparison(out, folder, facts, report, """
<p>A model from a file on a ground plane, camera and light framed by its bounds.</p>""")


def vulkan_shadows(out, folder, facts, report):
    passes = list(facts["methods"][0]["passes"])
    heads = ["method", "format", *(f"{name.replace('_', ' ')}, ms" for name in passes), "mean", "99%", "99.9%", "largest",
             f"beyond {1e3 * facts['tolerance']:g}, per million", "of these at edges"]

    def cells(m):
        yield m["method"], escape(m["method"])
        yield m["format"], escape(m["format"])
        yield from ((m["passes"][name], f"{m['passes'][name]:.2f}") for name in passes)
        yield from ((m[name], f"{1e3 * m[name]:.3f}") for name in ("mean", "p99", "p999", "largest"))
        yield m["beyond"], f"{1e6 * m['beyond']:.0f}"
        at_edges = 1 - m["beyond_inside"] / m["beyond"] if m["beyond"] else 1
        yield at_edges, f"{100 * at_edges:.1f} %" if m["beyond"] else "&ndash;"

    pictures = "\n".join(
        f'<h3>{escape(m["method"])} <span class="quiet">{escape(" + ".join(m["images"]))}</span></h3><div class="three">'
        + picture(f"{folder}/{m['file']}-device.png", "Vulkan") + picture(f"{folder}/{m['file']}-cpu.png", "CPU")
        + picture(f"{folder}/{m['file']}-difference.png", "difference") + "</div>" for m in facts["methods"])
    return "The same shadows on Vulkan", f"""
<p>The scene of the hard shadows on {escape(facts["device"])}, as an engine renders it: a shadow map of
{facts["map_resolution"]} x {facts["map_resolution"]} texels by the rasterizer with four samples, its resolve to the method's
format and a Gaussian of two passes by compute shaders, mip levels by blits, and {facts["width"]} x {facts["height"]} pixels lit by a
fragment shader that looks the map up through a trilinear sampler. The shaders are {facts["language"]} and include the package of
the library, the same kernels as on the CPU.</p>
<h3>Times and differences</h3>
<p>Times are the device's own timestamps. Differences of visibility to the CPU, in thousandths, over {facts["receivers"]:,}
receivers. They come from what Vulkan leaves to a device: whether a product and a sum are fused, which way a value is rounded to
the map's format, with how many bits a sampler weighs texels, how positions are interpolated, and how finely corners are snapped to
the grid of samples. On this device they may add up to {1e3 * facts["tolerance"]:g} thousandths; beyond that lie receivers at edges of
shadows or surfaces, where intensity is steep. EVSM in half floats differs most where a device rounds them toward zero, as Vulkan
permits.</p>
{table(map(escape, heads), map(cells, facts["methods"]))}
<h3>Pictures</h3>
<p>Differences of visibility: <b style="color:#2a62cc">blue</b> where the device is brighter, <b style="color:#c8232c">red</b>
where it is darker, saturated at {facts["error_scale"]:g}.</p>
{pictures}
"""


def bounds(out, folder, facts, report):
    charts.bounds(facts, out / "gallery" / folder, "bounds")
    return "Bounds from moments", f"""
<p>What a filterable shadow map stores of the depths in a filter region (black) is a few of their moments. They do not
tell how much of the region lies in front of a receiver, but they set sharp bounds on it. A surface is shaded with the lower
one, which never darkens it for nothing. For each receiver there is a distribution of few depths with the very same moments
that touches both bounds; it is all that the kernels have to find. The more moments, the tighter the bounds.</p>
{chart(folder, "bounds", "After Figure 2 of Peters et al. 2017; receivers dotted.")}
"""


SECTIONS = {"hard_shadows": hard_shadows, "contact": contact, "vulkan_shadows": vulkan_shadows, "bounds": bounds,
            "model": model}


def old_page(out):
    """The page of drivers that have no blocks yet, None where all have."""
    report = read(out / "report.json") if (out / "report.json").exists() else []
    links, sections = [], []
    for name, section in SECTIONS.items():
        file = out / "gallery" / name / "facts.json"
        if file.exists() and "blocks" not in read(file):
            title, text = section(out, name, read(file), report)
            links.append(f'<a href="#{name}">{escape(title)}</a>')
            sections.append(f'<section id="{name}"><h2>{escape(title)}</h2>{text}</section>')
    return sections and Template((HERE / "page.html").read_text(encoding="utf-8")).substitute(
        style=(HERE / "style.css").read_text(encoding="utf-8"), script=(HERE / "page.js").read_text(encoding="utf-8"),
        links="".join(links), sections="\n".join(sections))
