"""The gallery's sections on shadows in motion."""

import math
from html import escape

import motion_charts
from motion_charts import is_accumulation, maps, millis
from motion_tables import cover_first, known_answers, meshes, number, surfaces, wide_filter
from page import chart, legend_of_errors, picture, table

ANALYTIC, SEMI_ANALYTIC = "resolved ranges, receivers analytic", "resolved ranges, receivers semi-analytic"
ACCUMULATION = "accumulation of 16"

# A method that is so much worse still counts as equally good, since all share the error that comes from the size of a
# texel, and so does one whose error is half a step of eight bits.
AS_GOOD, INVISIBLE = 1.1, 0.5 / 255

# The scenes of Palmer's figures, and how much stronger their errors are shown than elsewhere.
FIGURES = {"cube_over_plane": "4.1", "cube_over_turning_plane": "4.2", "cube_near_turning_plane": "4.3"}
GAIN = 4

NOTES = {
    "pillars": """After Figure 11 of Andersson et al. Only the light moves. That takes each point on a long way over the
shadow map, and what an analytic receiver costs grows with the number of texels on it.""",
    "crossed_quads": """After Figure 12 of Andersson et al. One quad shadows another while both move, and both the ground.
Accumulation shows each of its maps as a band.""",
    "toward_and_away": """After Figure 13 of Andersson et al. Depth changes during the exposure.""",
    "cubes_to_the_light": """After Hong & Oh. Surfaces in motion shadow themselves, and fine triangles make long lists.""",
    "random_cubes": """After Hong & Oh. Every cube goes its own way.""",
    "cube_over_plane": """Palm&eacute;r's Figure 4.1. What is shadowed stays where it is.""",
    "cube_over_turning_plane": """Palm&eacute;r's Figure 4.2. What is shadowed turns.""",
    "cube_near_turning_plane": """Palm&eacute;r's Figure 4.3. What is shadowed turns a little, and is close to what shadows it.""",
    "fan": """Each corner goes straight from its first place to its last, so triangles shear as they turn.""",
    "lit_ramp": """After Figure 10 of Andersson et al. The ramp moves towards the light and is lit everywhere at all
times: whatever is darker in a method's picture comes from forgetting when something was where.""",
    "trapezoid": """A bar passes below a light that is far away, so the exact answer is known.""",
}


class Scene:
    """What a driver says of a scene, and its rows, one for each method."""

    def __init__(self, facts, report):
        self.facts = facts
        self.key, self.title = facts["key"], facts["title"]
        found = {row["method"]: row for row in report
                 if row["scene"] == facts["scene"] and row["reference"] == "traced"}
        if not found.keys() >= {method["method"] for method in facts["methods"]} | set(facts["unpictured"]):
            raise SystemExit(f"report.json: rows of the scene {facts['scene']} are missing; run the demo again")
        self.rows = [found[method["method"]] for method in facts["methods"]]
        self.unpictured = [found[method] for method in facts["unpictured"]]

    def row(self, method):
        return next(row for row in self.rows + self.unpictured if row["method"] == method)

    def file(self, method, what="picture"):
        return next(m[what] for m in self.facts["methods"] if m["method"] == method)


COLUMNS = (("bytes per texel", "bytes_per_texel", 1, 0), ("RMSE", "rmse", 1e3, 2), ("leak", "leak", 1e3, 2),
           ("acne", "acne", 1e3, 2), ("largest error", "max_abs", 1e3, 1), ("ns per receiver", "ns_per_receiver", 1, 0),
           ("map, ms", "build_ms", 1, 1))


def numbers(scene):
    def shown(row, key, scale, digits):
        return f"{scale * row[key]:,.{digits}f}"

    best = {key: shown(min(scene.rows, key=lambda row: row[key]), key, scale, digits)
            for _, key, scale, digits in COLUMNS}

    def cells(row):
        yield from ((row[key], escape(row[key])) for key in ("method", "format"))
        for _, key, scale, digits in COLUMNS:
            text = shown(row, key, scale, digits)
            yield row[key], text, text == best[key]

    return table(("method", "format", *(head for head, *_ in COLUMNS)), map(cells, scene.rows))


def in_short(row):
    return f"RMSE {1e3 * row['rmse']:.2f}, {row['ns_per_receiver']:,.0f} ns per receiver, built in {row['build_ms']:,.0f} ms"


def comparison(folder, scene):
    facts = scene.facts
    shown = ((ANALYTIC, "ranges, analytic receivers"), (ACCUMULATION, ACCUMULATION))
    pictures = "".join(picture(f"{folder}/{scene.file(method)}", f"{name}: {in_short(scene.row(method))}")
                       for method, name in shown)
    errors = "".join(picture(f"{folder}/{scene.file(method, 'error')}", "its errors") for method, _ in shown)
    everything = "".join(picture(f"{folder}/{m['picture']}", escape(m["method"])) + picture(f"{folder}/{m['error']}")
                         for m in facts["methods"])
    return f"""<h3>{escape(scene.title[0].upper() + scene.title[1:])}
<span class="quiet">{facts["triangles"]:,} triangles, {facts["receivers"]:,} receivers</span></h3>
<p>{NOTES.get(scene.key, "")}</p>
<div class="three tight">{picture(f"{folder}/{facts['reference']}", "reference, ray tracing")}{pictures}<div></div>{errors}</div>
<details><summary>All {len(facts["methods"])} methods: numbers and pictures</summary>
{numbers(scene)}
<div class="four tight">{everything}</div>
</details>"""


def figures_of_palmer(out, folder, scenes):
    chosen = [(scene, scene.facts["insets"][0]) for scene in scenes if scene.key in FIGURES]
    if not chosen:
        return ""
    where = out / "gallery" / folder

    def row(scene, inset):
        return f"{FIGURES[scene.key]}: {scene.title}", inset, [
            (where / scene.facts["reference"], "reference", False),
            (where / scene.file(SEMI_ANALYTIC), "semi-analytic", False),
            (where / scene.file(ANALYTIC), "analytic", False),
            (where / scene.file(SEMI_ANALYTIC, "error"), "errors, semi-analytic", True),
            (where / scene.file(ANALYTIC, "error"), "errors, analytic", True)]

    motion_charts.close_ups([row(*pair) for pair in chosen], GAIN, where, "chart-palmer")
    compared = table(("scene", "RMSE, semi-analytic", "RMSE, analytic", "largest error, semi-analytic", "largest error, analytic"),
                     ([(scene.title, escape(scene.title)),
                       *(number(1e3 * scene.row(method)[key], 2) for key in ("rmse", "max_abs")
                         for method in (SEMI_ANALYTIC, ANALYTIC))] for scene, _ in chosen), words=1)
    return f"""<h3>Palm&eacute;r's Figures 4.1 to 4.3</h3>
<p>In the thesis a receiver that stays within one texel of the shadow map is integrated in closed form, and any other is
sampled at some times. Where a plane turns, both meet along its axis, and the change shows: with these semi-analytic receivers
a broken line of errors runs along the axis of the plane that turns most, and a faint noise of samples lies over the shadows on
both planes that turn. Analytic receivers, which follow a point from texel to texel in closed form, have neither. Errors at the
edges of shadows come from the size of texels, and both have them; where the plane stays, the two are alike.</p>
{chart(folder, "chart-palmer", f"The shadows from close by; errors {GAIN} times as strong as in the other pictures.")}
{compared}"""


def time_at(rows, time, error):
    """When accumulation is as good: interpolated along its line; None where no number of maps is good enough."""
    points = [(time(row), row["rmse"]) for row in rows if is_accumulation(row)]
    if points[0][1] <= error:
        return points[0][0]
    for (t0, e0), (t1, e1) in zip(points, points[1:]):
        if e1 <= error:
            passed = math.log(e0 / error) / math.log(e0 / e1) if e1 > 0 else 1
            return t0 * (t1 / t0) ** passed
    return None


TIMES = ((lambda row: row["ns_per_receiver"], "ns per receiver"), (millis, "ms for map and receivers"))


def needed_by_accumulation(scene, time):
    """What an accumulation takes that is as good as analytic receivers, None where none is."""
    return time_at(scene.rows, time, max(AS_GOOD * scene.row(ANALYTIC)["rmse"], INVISIBLE))


def advantage(scene, time):
    """How many times cheaper analytic receivers are than an accumulation as good; None where none is."""
    needed = needed_by_accumulation(scene, time)
    return None if needed is None else needed / time(scene.row(ANALYTIC))


def so_many(times):
    return f"{times:,.0f} x" if times >= 10 else f"{times:.1f} x"


def verdict(scene, time):
    """In words, from the rows: which is cheaper at equal error."""
    found = advantage(scene, time)
    if found is None:
        return "no accumulation is as good"
    return f"analytic: {so_many(found)} cheaper" if found > 1 else f"accumulation: {so_many(1 / found)} cheaper"


def who_wins(scenes):
    text = ""
    for (time, _), what in zip(TIMES, ("by look-ups alone", "with the time to build maps")):
        found = sorted(((advantage(scene, time), scene.title) for scene in scenes if advantage(scene, time)))
        lost = ", ".join(f"{title} ({so_many(1 / times)})" for times, title in found if times < 1)
        won = ", ".join(f"{title} ({so_many(times)})" for times, title in reversed(found) if times >= 1)
        never = ", ".join(scene.title for scene in scenes if advantage(scene, time) is None)
        text += f"""<p>At equal error, {what}, <b>accumulation is cheaper</b> in: {escape(lost or "no scene")}. <b>Analytic
receivers are cheaper</b> in: {escape(won or "no scene")}. No accumulation is as good as they are in: {escape(never or "no scene")}.</p>
"""
    return text


def equal_error(out, folder, scenes):
    views = [[(f"{scene.title}\n{verdict(scene, time)}", scene.rows, time, unit) for scene in scenes] for time, unit in TIMES]
    if len(scenes) == 1:
        views = [views[0] + views[1]]
    for view, name in zip(views, ("chart-equal-error", "chart-equal-error-total")):
        motion_charts.equal_error(view, out / "gallery" / folder, name)

    def cells(scene):
        analytic = scene.row(ANALYTIC)
        yield scene.title, escape(scene.title)
        yield number(1e3 * analytic["rmse"], 2)
        for time, _ in TIMES:
            spent = time(analytic)
            needed = needed_by_accumulation(scene, time)
            yield number(spent)
            if needed is None:
                yield from ((1e99, "&infin;"), (1e99, "&infin;", True))
            else:
                yield from (number(needed), (*number(needed / spent, 2), needed > spent))

    accumulated = [maps(row) for row in scenes[0].rows if is_accumulation(row)]
    heads = ["scene", "RMSE, analytic"]
    for _, unit in TIMES:
        heads += [f"{unit}, analytic", f"{unit}, accumulation", "ratio"]
    charts = chart(folder, "chart-equal-error", """Error against time on one core; lower left is better. The line is accumulation,
with the number of maps.""")
    if len(views) > 1:
        charts += chart(folder, "chart-equal-error-total", "The same with the time that it takes to build maps.")
    return f"""<h3>Equal error</h3>
<p>What an accumulation costs that is as good, of up to {accumulated[-1]} maps: interpolated between those that were made, at an
error at most {AS_GOOD - 1:.0%} above that of analytic receivers, since texels limit both, or of {1e3 * INVISIBLE:.2f}
thousandths, half a step of eight bits. Receivers are projected beforehand for all methods; accumulation looks its maps up by
packs of receivers, the others one receiver at a time. A ratio above one, marked, is how many times faster analytic receivers
are; below one accumulation is. &infin;: no accumulation of so many maps is as good. Where the smallest, of {accumulated[0]}, is
good enough, its time stands.</p>
{who_wins(scenes)}
{table(heads, map(cells, scenes), words=1)}
{charts}"""


def memory(out, folder, facts):
    found = facts.get("memory")
    if not found:
        return ""
    size = found["resolution"]
    motion_charts.cubes(found["rows"], size, out / "gallery" / folder, "chart-memory")

    def saved(row):
        bytes_of = {m["method"]: m["building_bytes"] for m in row["maps"]}
        return bytes_of["prism ranges"] / bytes_of["prism ranges with coverage"]

    def described(row):
        speed = motion_charts.ratio(row["factor"])
        return f"{saved(row):.1f} times as much ({row['count']} cubes of half-extent {row['half_extent']:g}, speed {speed})"

    least, *_, most = sorted(found["rows"], key=saved)
    return f"""<h3>Memory and time</h3>
<p>The curves of Hong & Oh: random cubes, seen by shadow maps of {size} x {size} texels: more and more of them on the left, faster
and faster in the middle, and on the right as well, of larger ones. The longest way of a cube is {found["longest"]:g} times the
speed. Memory is that of the map that look-ups read. To be built, prisms need memory for the fragments that they pair, too: that
sum, their formula (2), is dotted. Level lines are time-dependent shadow maps of {", ".join(map(str, motion_charts.SAMPLES))}
samples, 4 bytes each. Coverage leaves out what is hidden where one triangle covers a texel for the whole time: without it prisms
need, by their formula, from {described(least)} to {described(most)}. Resolved lists have what is in front when. Those of casters leave out the
backdrop as well, what is behind all else in a texel for the whole time, as the ground often is: it shadows nothing. Packed are
the same in fewer bits, which look-ups read as they are. Time includes all that a look-up needs, so that of resolved lists is that
of building and resolving.</p>
{chart(folder, "chart-memory", '''From top to bottom: what a map takes, how long it takes to build, and how long for each texel that a
triangle covers at some time.''')}"""


def setting(facts):
    width, height, texels = facts["width"], facts["height"], facts["map_resolution"]
    together = ", while another part of the run is measured on another" if facts.get("parts_at_once", 1) > 1 else ""
    return f"""{width} x {height} pixels and a shadow map of {texels} x {texels} texels, looked up with bilinear weights. The
reference traces {facts["samples"]:,} rays per pixel from the eye, each at a time of its own, and one from each hit to the light.
Times are those of one core{together}, the least of several runs, or of one that takes long; numbers of errors are in thousandths. {legend_of_errors(facts)} In a table the best of each column
is marked; a click on a head sorts."""


def analytic(out, folder, facts, report):
    scenes = [Scene(scene, report) for scene in facts["scenes"]]
    pictures = "\n".join(comparison(folder, scene) for scene in scenes)
    return "Shadows in motion", f"""
<p>While a shutter is open, everything moves along straight lines. A shadow map of ranges keeps for each texel what the light
sees when: from one time to another, from one depth to another. How long a receiver is lit then is an integral in closed form,
with no noise and no bands. Accumulation, what one would use instead, is the mean over ordinary shadow maps at some times.</p>
<p>Maps keep all ranges, <i>exact</i> by edge functions in time or by <i>prisms</i> (Hong & Oh, <i>Motion Blurred Shadows
Utilizing a Depth-Time Ranges Shadow Map</i>), each also <i>with coverage</i>, without what is hidden for the whole time (Hong &
Oh, <i>Efficient Motion Blurred Shadows Using a Temporal Shadow Map</i>, 2017); or they are <i>resolved</i> to what is in front
when, those of <i>casters</i> without what is behind all else; or <i>lists</i> of a fixed capacity merge what is most similar
(Gribel et al. 2010; Palm&eacute;r, <i>Analytical Motion Blurred Shadows</i>, 2011). Receivers ask at one time for each sample of the camera, or for all the time in which a pixel sees a
surface: as if that were at rest, by samples, in closed form within a texel (semi-analytic), or in closed form along its way
(analytic). Scenes are from these papers and from Andersson et al., <i>Filtered Stochastic Shadow Mapping Using a Layered
Approach</i> (2015).</p>
<p>{setting(facts)}</p>
{pictures}
{figures_of_palmer(out, folder, scenes)}
{equal_error(out, folder, scenes)}
{surfaces(scenes)}
{cover_first(scenes)}
{wide_filter(facts, report)}
{memory(out, folder, facts)}
{meshes(facts)}
{known_answers(facts)}
"""


def animated_model(out, folder, facts, report):
    scenes = [Scene(scene, report) for scene in facts["scenes"]]
    name = f"<i>{escape(facts['animation'])}</i>" if facts["animation"] else "first"
    opens, closes = facts["shutter"]
    return f"Model in motion: {scenes[0].title}", f"""
<p>A model from a file on a ground plane, moved by its {name} animation. The shutter opens {opens:g} s after the animation's start
and closes at {closes:.4g} s; in between, corners go along straight lines.</p>
<p>{setting(facts)}</p>
{"".join(comparison(folder, scene) for scene in scenes)}
{equal_error(out, folder, scenes)}
"""
