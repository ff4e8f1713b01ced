"""Reads what a driver left, facts.json, and checks it against the contract of README.md."""

import json
import math
import re
import struct
from pathlib import Path


class Damaged(Exception):
    """A file that is missing, unreadable, or not what README.md says. Its text is one line for the user."""


def fail(where, message):
    raise Damaged(f"{where}: {message}")


def short(value):
    text = json.dumps(value, ensure_ascii=True)
    return text if len(text) <= 40 else text[:37] + "..."


def kind(name, test):
    """A check of one value: check(value, where)."""
    def check(value, where):
        if not test(value):
            fail(where, f"{name} expected, not {short(value)}")
    return check


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


NUMBER = kind("a number", is_number)
POSITIVE = kind("a number above 0", lambda v: is_number(v) and v > 0)
NUMBER_OR_NULL = kind("a number or null", lambda v: v is None or is_number(v))
COUNT = kind("a whole number above 0", lambda v: isinstance(v, int) and not isinstance(v, bool) and v > 0)
PLACE = kind("a whole number from 0", lambda v: isinstance(v, int) and not isinstance(v, bool) and v >= 0)
FLAG = kind("true or false", lambda v: isinstance(v, bool))
TEXT = kind("a text", lambda v: isinstance(v, str))
WORDS = kind("a text that is not empty", lambda v: isinstance(v, str) and v.strip() != "")
COLOUR = kind("a colour like \"#1f77b4\"", lambda v: isinstance(v, str) and re.fullmatch("#[0-9a-f]{6}", v))
STEM = kind("a file name without an end", lambda v: isinstance(v, str) and re.fullmatch(r"[\w-]+", v))
FILE = kind("a file in the driver's folder", lambda v: isinstance(v, str) and v != "" and ".." not in Path(v).parts and
            not Path(v).is_absolute())


def one_of(*words):
    return kind(" or ".join(words), lambda v: v in words)


def list_of(check, least=0):
    def listed(value, where):
        if not isinstance(value, list) or len(value) < least:
            fail(where, f"a list{f' of at least {least}' if least else ''} expected, not {short(value)}")
        for i, entry in enumerate(value):
            check(entry, f"{where}[{i}]")
    return listed


def record(**checks):
    """An object; the name of a key that may be missing ends with an underscore. Other keys are left alone."""
    def checked(value, where):
        if not isinstance(value, dict):
            fail(where, f"an object expected, not {short(value)}")
        for key, check in checks.items():
            name = key.rstrip("_")
            if name in value:
                check(value[name], f"{where}.{name}")
            elif not key.endswith("_"):
                fail(where, f"\"{name}\" is missing")
    return checked


def tick(value, where):
    if isinstance(value, list):
        if len(value) != 2 or not is_number(value[0]) or not isinstance(value[1], str):
            fail(where, f"[number, text] expected, not {short(value)}")
    else:
        NUMBER(value, where)


PICTURE = record(file=FILE, alt=WORDS, caption_=TEXT)
AXIS = {"label": WORDS, "scale": one_of("linear", "log", "symlog"), "threshold_": POSITIVE, "least_": NUMBER,
        "most_": NUMBER, "ticks_": list_of(tick)}
LENGTHS = {"points": (2, 3), "line": (2,), "steps": (2,), "band": (3,), "rule": (2,)}
MARKERS = ("circle", "square", "triangle", "diamond", "down", "plus", "cross", "star", "none")


def axis(value, where):
    record(**AXIS)(value, where)
    if value["scale"] == "symlog" and "threshold" not in value:
        fail(where, "a symlog axis needs a \"threshold\"")
    if value["scale"] == "log" and min(value.get("least", 1), value.get("most", 1)) <= 0:
        fail(where, "a log axis begins and ends above 0")


def series(value, where):
    record(label=WORDS, style=one_of(*LENGTHS), colour_=COLOUR, points=list_of(list_of(NUMBER_OR_NULL)), labelled_=FLAG,
           texts_=list_of(TEXT), dashed_=FLAG, marker_=one_of(*MARKERS))(value, where)
    for i, point in enumerate(value["points"]):
        if len(point) not in LENGTHS[value["style"]]:
            fail(f"{where}.points[{i}]", f"{len(point)} numbers do not make a point of style {value['style']}")
        if value["style"] == "rule" and point == [None, None]:
            fail(f"{where}.points[{i}]", "a rule is [x, null] or [null, y]")
    if "texts" in value and len(value["texts"]) != len(value["points"]):
        fail(f"{where}.texts", f"{len(value['points'])} expected, one for each point, not {len(value['texts'])}")


def table(value, where):
    record(columns=list_of(record(key=WORDS, label=WORDS, digits_=PLACE, scale_=NUMBER, best_=one_of("low", "high"),
                                  hint_=TEXT, colour_=COLOUR), 1),
           rows=list_of(record(colour_=COLOUR, aside_=FLAG)))(value, where)
    cell = kind("a number, a text or null", lambda v: v is None or isinstance(v, str) or is_number(v))
    for i, row in enumerate(value["rows"]):
        for column in value["columns"]:
            if column["key"] not in row:
                fail(f"{where}.rows[{i}]", f"\"{column['key']}\" is missing")
            cell(row[column["key"]], f"{where}.rows[{i}].{column['key']}")


def pictures(value, where):
    record(columns_=COUNT, compare_=FLAG, pixelated_=FLAG, pictures=list_of(PICTURE, 1), shown_=list_of(PLACE, 2),
           key_=list_of(record(colour=COLOUR, label=WORDS)))(value, where)
    count = len(value["pictures"])
    if value.get("compare") and count < 2:
        fail(where, "a comparison needs two pictures")
    if any(place >= count for place in value.get("shown", ())):
        fail(f"{where}.shown", f"there are {count} pictures")


def heat_map(value, where):
    values = {**AXIS, "scale": one_of("linear", "log"), "values": list_of(NUMBER, 1)}
    record(name=STEM, alt=WORDS, caption_=TEXT, x=record(**values), y=record(**values), threshold=NUMBER, label=WORDS,
           scale_=one_of("linear", "log"),
           maps=list_of(record(label=WORDS, values=list_of(list_of(NUMBER_OR_NULL))), 1))(value, where)
    if value.get("scale", "log") == "log":
        POSITIVE(value["threshold"], f"{where}.threshold")
    for which in "xy":
        places = value[which]["values"]
        if value[which]["scale"] == "log" and min(places) <= 0:
            fail(f"{where}.{which}.values", "a log axis has values above 0 alone")
        if any(a >= b for a, b in zip(places, places[1:])):
            fail(f"{where}.{which}.values", "values that rise expected")
    width, height = len(value["x"]["values"]), len(value["y"]["values"])
    for i, shown in enumerate(value["maps"]):
        if len(shown["values"]) != height or any(len(row) != width for row in shown["values"]):
            fail(f"{where}.maps[{i}].values", f"{height} rows of {width} values expected")


BLOCKS = {
    "text": record(text=TEXT), "table": table, "pictures": pictures, "map": heat_map,
    "chart": record(name=STEM, alt=WORDS, caption_=TEXT, front_=FLAG, panels=list_of(
        record(title_=TEXT, x=axis, y=axis, pareto_=FLAG, size_=TEXT, series=list_of(series, 1)), 1))}


def block(value, where):
    record(type=TEXT, title_=TEXT, text_=TEXT, folded_=FLAG)(value, where)
    if value["type"] not in BLOCKS:
        fail(where, f"unknown type {short(value['type'])}; {', '.join(BLOCKS)} expected")
    BLOCKS[value["type"]](value, where)
    if value.get("folded"):
        record(title=WORDS)(value, where)


FACTS = record(driver=WORDS, title=WORDS, family=WORDS, summary=WORDS, order_=NUMBER,
               front_=record(picture=FILE, alt=WORDS, caption=TEXT), blocks=list_of(block))


def read(file):
    """The facts of one driver."""
    try:
        facts = json.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        fail(file, error.strerror)
    except (ValueError, RecursionError) as error:
        fail(file, f"not JSON: {error}")
    try:
        FACTS(facts, "facts")
    except Damaged as damage:
        fail(file, damage)
    names = [b["name"] for b in facts["blocks"] if "name" in b]
    for name in names:
        if names.count(name) > 1:
            fail(file, f"two blocks have the name {short(name)}")
    return facts


def size_of_png(file):
    """Width and height of a picture, from the head of its file."""
    try:
        with open(file, "rb") as stream:
            head = stream.read(24)
    except OSError as error:
        fail(file, error.strerror)
    if head[:8] != b"\x89PNG\r\n\x1a\n" or head[12:16] != b"IHDR":
        fail(file, "not a PNG file")
    return struct.unpack(">II", head[16:24])
