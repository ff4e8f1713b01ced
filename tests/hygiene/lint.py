#!/usr/bin/env python3
"""The kernel dialect and the house rules of docs/architecture.md, checked without a compiler.

usage: lint.py ROOT    prints one line, path:line: rule: detail, for each breach below ROOT; exit code 1 if there is any

ROOT holds include/gnomon and, beside it, examples, tests and bench, for which length, includes and build files count.
"""
import math
import os
import re
import sys
from pathlib import Path

MAX_LINES = {"include": 400, "examples": 400, "tests": 300, "bench": 400}
SOURCES = {".h", ".hpp", ".cpp"}

# An include goes down this list or stays on its line, never up. gnomon.h stands with the passes: whoever includes
# everything still needs no library.
LAYERS = [["portable.h", "portable", "version.h"], ["numerics"], ["moments", "filters", "motion/triangle"], ["motion/range"],
          ["motion/receiver"], ["motion/layers"], ["soft", "scattering"], ["storage"], ["comparators"], ["advisor"],
          ["passes", "gnomon.h"], ["simd", "adapters"]]
LAYER = {name: level for level, names in enumerate(LAYERS) for name in names}

# The same in examples/. Rooms of evaluation that are not named hold programs. A lesson sees the library and the renderer,
# and nobody sees a lesson.
FLOORS = [["renderer/output"], ["renderer/scene"], ["renderer/import"], ["renderer/raster"], ["renderer/shade"],
          ["renderer/trace", "renderer/vulkan", "lessons"], ["evaluation/core"], ["evaluation/methods"], ["evaluation"]]
FLOOR = {name: level for level, names in enumerate(FLOORS) for name in names}

KERNEL = re.compile(r"((?:^///.*\n)*)^GNOMON_(DETAIL_)?(?:LIST_)?KERNEL\s+(\w+(?:\(\w+\))?)\s+(\w+)\(([^{;]*)", re.MULTILINE)
UNCLEAR = re.compile(r"(?:What|How|Where|When|Whether|It|One|The same)\b")
FIELD = re.compile(r"^/// *(Domain|NaN|Error|Source): |\b(?:[Dd]omain|NaN|[Ee]rrors?|[Ss]ources?): |^/// ([A-Z]\w*): ", re.MULTILINE)
SOURCE = re.compile(r"[^;]+ \d{4}(?:, (?:Eq|Alg|Sec|App)\. [\dA-Z]+(?:\.\d+)*)?")
COMPILED = re.compile(r"[^\s()]*(?:\.\./|(?:PROJECT|CMAKE)_SOURCE_DIR\}/)[^\s()]*\.(?:cpp|cc|c|cu)\b") # not its own folder's

# Built-in types that follow a pattern; the other reserved words are listed in a file.
BUILTIN_TYPES = re.compile(
    r"[ibudhf]?vec[234]|[dfh]?mat[234](x[234])?"
    r"|(float|half|double|int|uint|bool|u?char|u?short|u?long|long|min16\w+)([1-4](x[1-4])?|8|16)"
    r"|(RW)?[iug]?([sS]ampler|[tT]exture|image|depth)(1D|2D|3D|Cube|cube|Buffer|1d|2d|3d)\w*")

# What some language refuses, as it shows in formatted text without comments and include lines.
CONSTRUCTS = [
    ("conditional operator", r"\?"),
    ("inequality", r"!=(?=[^\n]*[;{)])"), # of NaN, xsimd 8.1 says false
    ("token pasting", r"##"),
    ("double underscore", r"\w*__\w*"),
    ("reference", r"(?<=\w)&(?= )|(?<= )&(?=\w)|(?<=[\w>])&&(?= \w+[,)])"),
    ("pointer", r"(?<=\w)\*+(?=[ ,)>])|(?<= )\*+(?=\w)|->"),
    ("lambda", r"(?<![\w\])])\s*\[(?=[^\]]*\]\s*[({])"),
    ("scope operator", r"::"),
    ("default argument", r"[(,] *(?:const )?[A-Z_a-z]\w*(?:\([^()]*\))? \w+ = [^;()]*(?:\([^()]*\)[^;()]*)*(?=[,)])"),
    ("ellipsis", r"\.\.\."),
    ("hexadecimal float", r"\b0[xX][\da-fA-F.]+[pP][+-]?\d+"),
    ("pragma", r"# *pragma"),
    ("#if without defined", r"# *(?:el)?if (?!(?:[ !()]|&&|\|\||defined *\(\w+\))+$)"),
    ("foreign macro", r"# *define (?!GNOMON_)"),
]
CONSTRUCTS = [(rule, re.compile(pattern, re.MULTILINE)) for rule, pattern in CONSTRUCTS]
DIVISOR = re.compile(r"/\s*(?:GNOMON_LITERAL\(\w+\)|Real\((-?[\d.e+-]+)\))") # drivers multiply by its rounded reciprocal
RULES = [rule for rule, _ in CONSTRUCTS] + [
    "reserved word", "fused multiply-add", "division by a constant", "not ASCII", "include of a library", "include of a .hpp",
    "include goes up", "include of a layer", "name of a layer", "no include guard", "too long", "test too long", "no comment", "unclear beginning", "field", "source", "mask",
    "unused helper", "source of another folder", "macro of others",
    "mutable global"]


def reserved_words():
    text = (Path(__file__).parent / "reserved_words.txt").read_text()
    languages = re.findall(r"^(\S+)\n((?:[^\n]+\n?)+)", re.sub(r"^#.*\n", "", text, flags=re.MULTILINE), re.MULTILINE)
    words = {}
    for language, listed in languages:
        for word in listed.split():
            words.setdefault(word, language)
    return words


def foreign_macros():
    """A pattern of the uses that macros of other headers would replace: of those with arguments where a bracket follows."""
    text = (Path(__file__).parent / "foreign_macros.hpp").read_text()
    plain, called = (set(re.findall(rf"^#define (\w+){end}", text, re.MULTILINE)) for end in (r"(?!\(|\w)", r"\("))
    return re.compile(rf"(?<!\w)(?:(?:{'|'.join(plain)})(?!\w)|(?:{'|'.join(called)}) *(?=\())")


FOREIGN = foreign_macros()
MUTABLE = re.compile(r"^ *(?:(?:inline|static|extern|thread_local) )+(?!const)[^=({;]*(?:=|\{|;)", re.MULTILINE)


def blank(text, pattern, flags=0):
    """The text with each match overwritten by spaces, so that line numbers stay."""
    return re.sub(pattern, lambda match: re.sub(r"[^\n]", " ", match[0]), text, flags=flags)


def without_body_of(function, text):
    head = re.search(r"\b%s\([^)]*\)\s*\{" % function, text)
    if not head:
        return text
    depth, end = 1, head.end()
    while depth and end < len(text):
        depth += {"{": 1, "}": -1}.get(text[end], 0)
        end += 1
    return text[:head.end()] + re.sub(r"[^\n]", " ", text[head.end():end]) + text[end:]


def lint_kernel(text, words):
    """Breaches of the dialect in a .h as (offset, rule, detail)."""
    code = blank(text, r"^[ \t]*# *(include|error)\b.*$", re.MULTILINE)
    for rule, pattern in CONSTRUCTS:
        for match in pattern.finditer(code):
            yield match.start(), rule, match[0].strip()
    for match in re.finditer(r"\b[A-Za-z_]\w*", code):
        if re.search(r"# *$", code[:match.start()].rsplit("\n", 1)[-1]):
            continue # a preprocessor directive
        if match[0] in words:
            yield match.start(), "reserved word", f"{match[0]} ({words[match[0]]})"
        elif BUILTIN_TYPES.fullmatch(match[0]):
            yield match.start(), "reserved word", f"{match[0]} (a built-in type)"
    for match in re.finditer(r"\b(?:\w+_)?fma\s*\(", without_body_of("two_product", code)):
        yield match.start(), "fused multiply-add", "belongs into two_product"
    for match in DIVISOR.finditer(code):
        if not match[1] or math.frexp(abs(float(match[1])))[0] > 0.5: # by a power of two, both are exact
            yield match.start(), "division by a constant", f"{match[0]}: multiply by a GNOMON_CONSTANT"


def lint_includes(path, text):
    """Breaches of the folders' order and of .h against .hpp as (offset, rule, detail); path is relative to include/gnomon."""
    layer = layer_of(path)
    for match in re.finditer(r'^[ \t]*# *include ([<"])([^>"]+)[>"]', text, re.MULTILINE):
        bracket, target = match.groups()
        if bracket == '"' or target.startswith("gnomon/"):
            relative = Path(target).relative_to("gnomon") if bracket == "<" else path.parent / target
            if layer_of(Path(os.path.normpath(relative))) > layer:
                yield match.start(), "include goes up", target
            if target.endswith(".hpp") and path.suffix == ".h" and path.name != "gnomon.h":
                yield match.start(), "include of a .hpp", target
            if is_layer(Path(target)) and not is_layer(path) and path.name != "gnomon.h":
                yield match.start(), "include of a layer", f"{target}: who includes {path.name} would get it, too (docs/patents.md)"
        elif is_kernel(path) or (not re.fullmatch(r"[a-z_]+", target) and layer < LAYER["simd"]):
            yield match.start(), "include of a library", target


def lint_comments(text, kernels):
    """Breaches in the comments of a .h as (offset, rule, detail). kernels is the text of all .h and .hpp without comments."""
    for match in KERNEL.finditer(text):
        comment, detail, result, name, parameters = match.groups()
        if not detail and not comment:
            yield match.start(4), "no comment", f"{name} says neither what it returns nor where it is from"
        if not detail and (first := UNCLEAR.match(comment[4:])):
            yield match.start(), "unclear beginning", f"'{first[0]}' of {name}: begin with what is returned or done"
        if not detail and "GNOMON_MASK" in result + parameters:
            yield match.start(4), "mask", f"{name} has a mask, which no table can hold: make it a GNOMON_DETAIL_KERNEL"
        if detail and len(re.findall(rf"\b{name}\b", kernels)) < 2:
            yield match.start(4), "unused helper", f"nothing below include/gnomon calls {name}"
        for field in FIELD.finditer(comment):
            if not field[1]:
                yield match.start() + field.start(), "field", f"'{field[0].strip('/ ')}' in {name}: Domain, NaN, Error, Source"
        sources = re.findall(r"^/// Source: (.*(?:\n/// (?!\w+: ).*)*)", comment, re.MULTILINE)
        for source in re.sub(r"\n/// ", " ", "; ".join(sources)).split("; "):
            if source and not SOURCE.fullmatch(source):
                yield match.start(), "source", f"'{source}' of {name}: 'Author year, Eq. 3' expected"


def lint_example(path, text, root):
    """Includes that go up in examples/, as (offset, rule, detail); path is relative to it."""
    for match in re.finditer(r'^[ \t]*# *include "([^"]+)"', text, re.MULTILINE):
        target = next((Path(os.path.normpath(place)) for place in (path.parent / match[1], Path(match[1]))
                       if (root / "examples" / place).exists()), None)
        foreign_lesson = target and "lessons" in target.parts[:1] and "lessons" not in path.parts[:1]
        if target and (foreign_lesson or floor_of(target) > floor_of(path)):
            yield match.start(), "include goes up", match[1]


def floor_of(path):
    """The level of the room in examples/ that holds path."""
    return FLOOR.get("/".join(path.parts[:2]), FLOOR.get(path.parts[0], len(FLOORS)))


def layer_of(path):
    """The level of the room that holds path: of its first two folders where these are a room, else of the first."""
    return LAYER.get("/".join(path.parts[:2]), LAYER.get(path.parts[0], len(LAYERS)))


UNPATENTED = {"receiver_footprint.h", "stochastic_sample.h"} # in folders of layers


def is_layer(path):
    """True for the headers that docs/patents.md tells apart from all others by their names."""
    return path.name.startswith("layer_")


def is_kernel(path):
    return path.suffix == ".h" and path.parts[0] not in LAYERS[0]


def lint_header(path, text, words):
    code = blank(text, r"//[^\n]*|/\*.*?\*/", re.DOTALL)
    if path.suffix == ".h" and not text.isascii():
        yield next(i for i, c in enumerate(text) if ord(c) > 127), "not ASCII", "outside the basic alphabet"
    if path.parent.name == "layers" and not is_layer(path) and path.name not in UNPATENTED:
        yield 0, "name of a layer", "layer_... expected: docs/patents.md knows files by it"
    if not re.match(r"\s*#ifndef (GNOMON_\w+)\n#define \1\n.*#endif\s*$", code, re.DOTALL):
        yield 0, "no include guard", "#ifndef GNOMON_..., #define, #endif expected"
    yield from lint_includes(path, code)
    for match in MUTABLE.finditer("" if is_kernel(path) else code):
        yield match.start(), "mutable global", match[0].strip(" ={;")
    if path.parts[0] != "portable" or path.name == "cpp.h": # shader languages have min and max of their own
        for match in FOREIGN.finditer(blank(code, r'^[ \t]*# *(?:include|error)\b.*$|"[^"\n]*"', re.MULTILINE)):
            if not is_kernel(path) or match[0].strip() not in words:
                yield match.start(), "macro of others", f"{match[0].strip()}: a macro in foreign_macros.hpp"
    if is_kernel(path):
        yield from lint_kernel(code, words)
    else:
        foreign = dict(CONSTRUCTS)["foreign macro"]
        for match in foreign.finditer(code):
            if not re.match(r"Real\b", code[match.end():]): # a shader's prelude has no other way to name it
                yield match.start(), "foreign macro", match[0]


def lint(root):
    """All breaches below root as (path, line, rule, detail)."""
    words = reserved_words()
    headers = root / "include" / "gnomon"
    kernels = "\n".join(re.sub(r"//.*", "", path.read_text(encoding="utf-8"))
                        for path in sorted(headers.rglob("*")) if path.suffix in SOURCES)
    for folder in ("include", "examples", "tests", "bench"):
        for path in sorted((root / folder).rglob("*")):
            build = path.name == "CMakeLists.txt" or path.suffix == ".cmake"
            if path.suffix not in SOURCES and not build or "lint_cases" in path.relative_to(root).parts:
                continue
            text = path.read_text(encoding="utf-8")
            found = []
            if folder == "include":
                found += lint_header(path.relative_to(headers), text, words)
            if folder == "include" and is_kernel(path.relative_to(headers)):
                found += lint_comments(text, kernels)
            if folder == "examples":
                found += lint_example(path.relative_to(root / folder), text, root)
            if build:
                found += [(match.start(), "source of another folder", match[0]) for match in COMPILED.finditer(text)]
            if text.count("\n") > MAX_LINES[folder]:
                found.append((len(text), "test too long" if folder == "tests" else "too long", f"{text.count(chr(10))} lines, at most {MAX_LINES[folder]}"))
            for offset, rule, detail in sorted(found):
                yield path.relative_to(root), text.count("\n", 0, offset) + 1, rule, detail


def main():
    if len(sys.argv) != 2 or not Path(sys.argv[1], "include", "gnomon").is_dir():
        print("lint.py: one argument expected, the folder that holds include/gnomon", file=sys.stderr)
        sys.exit(2)
    breaches = [f"{path}:{line}: {rule}: {detail}" for path, line, rule, detail in lint(Path(sys.argv[1]))]
    print("\n".join(breaches) if breaches else "no breach")
    sys.exit(1 if breaches else 0)


if __name__ == "__main__":
    main()
