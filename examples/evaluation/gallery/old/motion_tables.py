"""What shadows in motion are measured by beside their pictures: tables of ids, covers, filters, meshes and receivers at rest."""

from html import escape

from motion_charts import in_order
from page import table

PLACES = {"ground": "behind all", "among": "among casters"}


def number(value, digits=0):
    return value, f"{value:,.{digits}f}"


def surfaces(scenes):
    """Rows by ids of triangles, and by those of surfaces."""
    def pairs(scene):
        for row in scene.unpictured:
            plain = row["method"].replace(", ids of surfaces", "")
            if plain != row["method"]:
                yield from ((scene, "triangles", scene.row(plain)), (scene, "surfaces", row))

    def joined(scene):
        for row in scene.unpictured:
            if ", joined, " in row["method"]:
                yield scene, "triangles", row

    def cells(scene, whose, row):
        yield scene.title, f'{escape(scene.title)}, {scene.facts["surfaces"]:,} surfaces of {scene.facts["triangles"]:,} triangles'
        yield row["method"], escape(row["method"].replace(", ids of surfaces", ""))
        yield whose, whose
        for key in ("rmse", "leak", "acne", "acne_unbiased"):
            yield number(1e3 * row[key], 2)
        yield number(row["bytes_per_texel"])

    rows = [found for scene in scenes for found in (*pairs(scene), *joined(scene))]
    if not rows:
        return ""
    return """<h3>Ids of surfaces</h3>
<p>A receiver is not shadowed by what has its own id. That may be its triangle, or all triangles that cannot shadow one another
since they stay in one plane or form one convex part (Palm&eacute;r, 2.3.2). Ranges of one id also merge into one of that id, where
a list is full, instead of into one that shadows everybody. Joined are ranges of one mesh that follow one another on nearly one
line, whatever their ids. Acne is shown with the depth bias of all methods and without it.</p>
""" + table(("scene", "method", "ids", "RMSE", "leak", "acne", "acne, no bias", "bytes per texel"),
            (cells(*row) for row in rows), words=3)


def cover_first(scenes):
    rows = [(scene, row) for scene in scenes for first in scene.unpictured if first["method"].startswith("exact ranges, cover first")
            for row in (*(scene.row(f"exact ranges{kind}, 16 times") for kind in ("", " with coverage")), first)]
    if not rows:
        return ""
    return """<h3>The cover first</h3>
<p>The shadow test of Hong & Oh 2017 asks a texel's cover, and its list only where there is none.</p>
""" + table(("scene", "method", "RMSE", "bytes per texel", "ns per receiver", "map, ms"),
            ([(scene.title, escape(scene.title)), (row["method"], escape(row["method"])), number(1e3 * row["rmse"], 2),
              number(row["bytes_per_texel"]), number(row["ns_per_receiver"]), number(row["build_ms"], 1)]
             for scene, row in rows))


def wide_filter(facts, report):
    found = facts.get("wide_filter")
    if not found:
        return ""
    rows = [row for method in found["methods"] for row in report
            if (row["scene"], row["method"], row["reference"]) == (found["scene"], method, "filtered")]
    return f"""<h3>A wider filter</h3>
<p>The scene {escape(found["scene"])} by percentage-closer filtering of 3 x 3 bilinear look-ups, against the mean over
{found["maps"]} shadow maps under the same filter: errors are those of time alone.</p>
""" + table(("method", "RMSE", "largest error", "ns per receiver", "map, ms"),
            ([(row["method"], escape(row["method"])), number(1e3 * row["rmse"], 2), number(1e3 * row["max_abs"], 1),
              number(row["ns_per_receiver"]), number(row["build_ms"], 1)] for row in rows), words=1)


def meshes(facts):
    found = facts.get("meshes")
    if not found:
        return ""

    def cells(mesh, row):
        yield mesh["scene"], escape(mesh["scene"])
        yield row["method"], escape(row["method"])
        yield number(mesh["triangles"])
        yield f"{mesh['resolution']}", f"{mesh['resolution']} x {mesh['resolution']}"
        yield number(mesh["pairs"])
        yield number(row["ranges"])
        yield number(row["bytes"] / 2**20, 1)
        yield number(row["build_ms"], 1)
        yield number(row["ns_per_pair"], 1)
        yield number(mesh["accumulation_ms"], 1)

    return """<h3>Meshes that people have</h3>
<p>What it takes to build maps, and to resolve them: cubes, a finely tessellated sheet whose triangles are as small as texels, and
animated models of Debian's assimp-testmodels, where that is installed. A pair is a triangle and a texel that it covers at some
time.</p>
""" + table(("mesh", "method", "triangles", "map", "pairs", "ranges", "MiB", "map, ms", "ns per pair", "16 shadow maps, ms"),
            (cells(mesh, row) for mesh in found for row in mesh["maps"]))


def ranges_or_maps(rows):
    """In words, from the rows: which of ranges and accumulated maps receivers at rest should ask."""
    cheaper, dearer = [], []
    for factor, where in in_order((row["factor"], row["where"]) for row in rows):
        here = [row for row in rows if (row["factor"], row["where"], row["shutter"]) == (factor, where, "box")]
        ranges, accumulated = (min((row for row in here if kind in row["method"]), key=lambda row: row["ns"])
                               for kind in ("ranges", "accumulation"))
        text = (f"{PLACES[where]} at {factor:g} x (ranges {ranges['ns']:,.0f} ns, RMSE {1e3 * ranges['rmse']:.2f}; {accumulated['method']} "
                f"{accumulated['ns']:,.0f} ns, {1e3 * accumulated['rmse']:.2f})")
        (cheaper if accumulated["ns"] < ranges["ns"] else dearer).append(text)
    return f"""<p><b>Accumulation is faster</b> than the fastest ranges for receivers {escape(", ".join(cheaper) or "nowhere")};
<b>ranges are faster</b> {escape(", ".join(dearer) or "nowhere")}.</p>
"""


def known_answers(facts):
    text = ""
    if facts.get("closed_forms"):
        text += """<h3>Known answers</h3>
<p>The largest error of visibility, where the exact one is known.</p>
""" + table(("scene", "method", "receivers", "largest error"),
            ([(row["scene"], escape(row["scene"])), (row["method"], escape(row["method"])), number(row["receivers"]),
              (row["max_abs"], f"{row['max_abs']:.1e}")] for row in facts["closed_forms"]))
    if facts.get("static"):
        text += """<h3>Receivers at rest</h3>
<p>Visibility over the whole shutter interval, against ray tracing with motion blur, on the ground behind all casters and at random
heights among them. Totals are what all ranges of a texel hide together: a receiver behind all of them needs no list. Maps that
are accumulated keep the depths of a texel side by side, since a receiver at rest asks all of them at one place. A tent shutter
opens and closes evenly; its reference is traced at times as dense as it is open. Errors in thousandths; the ratio is how many
times as fast as 16 rays.</p>
""" + ranges_or_maps(facts["static"]) + table(("motion", "receivers", "method", "bytes per texel", "map, ms", "ns per receiver", "RMSE", "ratio"),
            ([(row["factor"], f"{row['factor']:g} x"), (row["where"], PLACES[row["where"]]),
              (row["method"], escape(row["method"])), number(row["bytes_per_texel"], 1), number(row["build_ms"]),
              number(row["ns"]), number(1e3 * row["rmse"], 2), number(row["ratio"], 1)]
             for row in sorted(facts["static"], key=lambda row: (row["factor"], row["where"] == "among"))), words=3)
    return text
