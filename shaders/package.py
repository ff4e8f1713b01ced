#!/usr/bin/env python3
"""Writes the shader packages: the kernels of include/gnomon as files of one language each, that include nothing.

Without an argument, every package anew, into shaders/packages. With techniques, one file that holds them all, in each
language: package.py moments4 variance --language wgsl writes moments4_variance.wgsl. docs/architecture.md says how
packages come about.
"""
import argparse
import difflib
import itertools
import os
import re
import sys
from pathlib import Path

import wgsl
from dialect import CONSTANT, DEFINED, DialectError, Header, Prelude
from helpers import internal
from layout import laid_out

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = ROOT / "shaders/packages"
VERSION = re.compile(r"^#define GNOMON_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", re.MULTILINE)
PREFIX = re.compile(r"(?!gl_)[A-Za-z][A-Za-z0-9]*(?:_[A-Za-z0-9]+)*_?") # no language reserves a name that begins so

# Ending of the packages: prelude, the language's name, and how the preprocessor tells another language.
LANGUAGES = {
    "glsl": ("glsl.h", "GLSL", "defined(__cplusplus) || defined(__HLSL_VERSION) || defined(__OPENCL_C_VERSION__)"),
    "hlsl": ("hlsl.h", "HLSL", "defined(GL_ES) || defined(__METAL_VERSION__) || defined(__OPENCL_C_VERSION__)"),
    "metal": ("msl.h", "Metal", "!defined(__METAL_VERSION__)"),
    "cl": ("opencl.h", "OpenCL C", "!defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)"),
    "cuh": ("cpp.h", "CUDA and C++20", "!defined(__cplusplus) || defined(__METAL_VERSION__)"),
}
ENDINGS = [*LANGUAGES, "wgsl"] # which is the GLSL, translated

# Technique: the headers that it starts from, and for moments how many of them. What else it takes follows from the
# headers' includes. A header below one of FOLDERS is a technique by itself, with its storage formats.
TECHNIQUES = {
    "moments4": (["moments/quantization.h", "moments/affine.h", "storage/moments4.h", "storage/moments4_within.h",
                  "storage/moments4_blended.h", "moments/hamburger4.h"], "4"),
    "moments6": (["moments/quantization.h", "moments/affine.h", "storage/moments6.h", "storage/moments6_blended.h",
                  "moments/hamburger6.h"], "6"),
    "absorbance": (["storage/absorbance4.h"], "4"),
    "moments4_summed": (["storage/moments4_summed.h", "storage/moments4_summed_within.h"], "4"),
    "moments6_summed": (["storage/moments6_summed.h"], "6"),
    "variance_summed": (["storage/variance_summed.h"], ""),
    "two_point": (["moments/two_point.h"], ""),
    "depth": (["moments/depth.h"], ""),
}
FOLDERS = ["filters", "soft", "scattering", "motion", "comparators"]

HEADING = """\
// Gnomon {version}, {name}: shadow filtering in {language}, this file alone.
// Copyright (c) 2026 the Gnomon authors. SPDX-License-Identifier: MIT
// Written by shaders/package.py from the kernels in include/gnomon: change them there.
"""

CHECKS = """\
#if {other}
#error "gnomon: {name} is {language}; another language's compiler reads it"
#elif defined(GNOMON_PORTABLE_H)
#error "gnomon: {name} and the headers of include/gnomon exclude one another"
#elif defined(GNOMON_PACKAGE) && GNOMON_PACKAGE != {number}
#error "gnomon: {name} is not of the same version as a package before it"
#endif
#define GNOMON_PACKAGE {number} // major, minor and patch, two digits each

"""


def closure(headers, names):
    """The headers named and all that they include, each after what it includes."""
    ordered = []

    def visit(name):
        if name not in headers:
            raise DialectError(f"{name}: no such header of the kernel dialect below include/gnomon")
        if name not in ordered:
            for include in headers[name].includes:
                visit(include)
            ordered.append(name)

    for name in names:
        visit(name)
    return [headers[name] for name in ordered if headers[name].blocks]


def count_of(block):
    """4 or 6 where a block is about that many moments, by the names of what it defines."""
    counts = {count for name in DEFINED.findall(block) for count in re.findall(r"^[a-z]+([46])(?:_|$)", name)}
    return counts.pop() if len(counts) == 1 else ""


def one_count_each(block):
    """The block, or its lines by count where they are constants of four and of six moments, one after the other."""
    lines = block.splitlines(keepends=True)
    if not all(CONSTANT.match(line) for line in lines):
        return [block]
    return ["".join(group) for _, group in itertools.groupby(lines, count_of)]


def section(title, guard, comment, text):
    return f"// {title} {'-' * (116 - len(title))}\n{comment}#ifndef {guard}\n#define {guard}\n{text}#endif\n\n"


class Packager:
    """The packages of the kernels in a folder that holds gnomon/."""

    def __init__(self, include=ROOT / "include", prefix="gnomon_"):
        self.root = include / "gnomon"
        version = VERSION.findall((self.root / "version.h").read_text())
        self.version, self.number = ".".join(version), int("".join(part.zfill(2) for part in version))
        names = sorted(path.relative_to(self.root).as_posix() for path in self.root.rglob("*.h"))
        names = [name for name in names if not name.startswith(("portable", "version"))]
        self.headers = {name: Header.read(self.root, name) for name in names}
        everything = closure(self.headers, ["gnomon.h", *names])
        self.starts = TECHNIQUES | {Path(name).stem: (self.with_storage(name), "") for name in names
                                    if Path(name).parts[0] in FOLDERS}
        self.techniques = {technique: (closure(self.headers, start), count) for technique, (start, count) in self.starts.items()}
        counts = {count for _, count in self.techniques.values() if count}
        self.shared = [header for header in everything if all(any(count == c and header in headers for headers, c in
                                                                  self.techniques.values()) for count in counts)]
        for header in everything:
            if not any(header in headers for headers, _ in self.techniques.values()):
                raise DialectError(f"{self.root / header.name}: in no technique of package.py")
        self.starts["gnomon"], self.techniques["gnomon"] = (["gnomon.h", *names], ""), (everything, "")
        self.prefix, self.internal, self.preludes = prefix, internal(everything), {}

    def with_storage(self, name):
        """The header of a technique and that of its storage formats, which includes it."""
        storage = f"storage/{Path(name).name}"
        return [storage] if name.startswith("filters/") and storage in self.headers else [name]

    def files(self, endings=ENDINGS):
        """(name, text) of the package of every technique, and of the one that holds them all."""
        for technique in self.techniques:
            yield from self.file([technique], endings)

    def file(self, techniques, endings=ENDINGS):
        """(name, text) of one package that holds these techniques, in each language."""
        package = "_".join(techniques)
        headers = closure(self.headers, [start for technique in techniques for start in self.starts[technique][0]])
        parts = [(header, [part for part in self.parts(header) if self.wanted(techniques, header, part[0])]) for header in headers]
        for ending, (prelude, language, other) in LANGUAGES.items():
            if ending in endings or ending == "glsl" and "wgsl" in endings:
                name = f"{package}.{ending}"
                checks = CHECKS.format(name=name, language=language, other=other, number=self.number)
                text = self.package(name, language, checks, self.prelude(prelude), parts)
                if ending in endings:
                    yield name, text
                if ending == "glsl" and "wgsl" in endings:
                    yield f"{package}.wgsl", wgsl.translated(text)

    def prelude(self, name):
        if name not in self.preludes:
            prelude = Prelude.read(self.root / "portable" / name)
            prelude.forget_unused(self.headers.values())
            if not prelude.has_namespaces:
                prelude.names, prelude.prefix = self.internal, self.prefix
            self.preludes[name] = prelude
        return self.preludes[name]

    def name(self, name):
        """A name of the headers as it is in packages of languages without namespaces."""
        return self.prefix + name if name in self.internal else name

    def package(self, name, language, checks, prelude, parts):
        guard = "GNOMON_" + re.sub(r"\W", "_", name).upper()
        text = HEADING.format(version=self.version, name=name, language=language)
        text += f"#ifndef {guard}\n#define {guard}\n\n" + "".join(f"{block}\n" for block in prelude.frame)
        text += section("the language", prelude.guard, prelude.comment + checks, prelude.own_text())
        for header, some in parts:
            comment = laid_out(prelude.prefixed(header.comment))
            for _, title, part_guard, blocks in some:
                text += section(title, part_guard, comment, prelude.spelled(blocks, text))
                comment = ""
        undone = dict.fromkeys(re.findall(r"#define (\w+)", "".join(prelude.frame)))
        return text + "".join(f"#undef {macro}\n" for macro in undone) + "#endif\n"

    def wanted(self, techniques, header, about):
        """Whether one of the techniques takes the part of a header that is about so many moments."""
        return any(header in headers and (not count or about in ("", count))
                   for headers, count in (self.techniques[technique] for technique in techniques))

    def parts(self, header):
        """(count, title, guard, blocks) of a header: one part, or one per count where a technique takes but its own."""
        if header not in self.shared:
            return [("", header.name, header.guard, header.blocks)]
        taken = {"": [], "4": [], "6": []}
        for block in header.blocks:
            for part in one_count_each(block):
                taken[count_of(part)].append(part)
        title = {"": "", "4": ", four moments", "6": ", six moments"} if taken["4"] and taken["6"] else dict.fromkeys(taken, "")
        return [(count, header.name + title[count], re.sub("H$", count or "H", header.guard), blocks)
                for count, blocks in taken.items() if blocks]


def write(output, files):
    """Each file aside, then under its name."""
    output.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        aside = output / f"{name}.new"
        aside.write_text(text)
        os.replace(aside, output / name)


def left_over(output, files, endings):
    """Packages in these languages in a folder that are none of the files."""
    return [path for ending in endings for path in sorted(output.glob(f"*.{ending}"))
            if path.name not in files and path.read_text().startswith("// Gnomon ")]


def replace(output, files, endings):
    """The files in place of all packages in these languages that the folder holds."""
    write(output, files)
    for path in left_over(output, files, endings):
        path.unlink()


def check(files):
    """Prints a line for each file of PACKAGES that is not what the kernels say; the number of them."""
    differing = [name for name, text in files.items() if not (PACKAGES / name).exists() or (PACKAGES / name).read_text() != text]
    differing += [path.name for path in left_over(PACKAGES, files, ENDINGS)]
    for name in differing:
        print(f"shaders/packages/{name}: not what include/gnomon says; run: python3 shaders/package.py")
    print(f"{len(files)} packages, {len(differing)} differ")
    return len(differing)


def known(kind, name, names):
    if name not in names:
        near = difflib.get_close_matches(name, names, 1)
        raise ValueError(f"no {kind} '{name}'; " + (f"'{near[0]}' is near" if near else f"there are {', '.join(names)}"))
    return name


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise ValueError(message)


def arguments(words):
    parser = Parser(prog="package.py", allow_abbrev=False, description="Writes shader packages. Without an argument, every "
                    "package in every language, into shaders/packages.")
    parser.add_argument("techniques", nargs="*", metavar="TECHNIQUE", help="one file with all of these; without any, a file for "
                        f"each of: {', '.join(Packager().techniques)}")
    parser.add_argument("--language", action="append", metavar="ENDING", help=f"of {', '.join(ENDINGS)}; may be repeated")
    parser.add_argument("--prefix", metavar="PREFIX", help="of helpers where the language has no namespaces; else gnomon_")
    parser.add_argument("--bevy", action="store_true", help="WGSL for Bevy, which begins with #define_import_path gnomon::NAME")
    parser.add_argument("--output", metavar="FOLDER", type=Path, help="else the folder that you are in")
    parser.add_argument("--check", action="store_true", help="writes nothing; says which files of shaders/packages are not fresh")
    asked, unknown = parser.parse_known_intermixed_args(words)
    for word in unknown:
        known("option", word, [option for action in parser._actions for option in action.option_strings])
    return asked


def run(words):
    asked = arguments(words)
    if asked.check:
        if words != ["--check"]:
            raise ValueError("--check goes alone")
        return check(dict(Packager().files())) > 0
    if asked.bevy and asked.language not in (None, ["wgsl"]):
        raise ValueError(f"--bevy is WGSL, not {asked.language[0]}")
    endings = ["wgsl"] if asked.bevy else [known("language", ending, ENDINGS) for ending in asked.language or ENDINGS]
    if asked.prefix is not None and not PREFIX.fullmatch(asked.prefix):
        raise ValueError(f"'{asked.prefix}' begins no name in every language: letters, digits and single underscores expected")
    packager = Packager(prefix=asked.prefix or "gnomon_")
    techniques = [known("technique", technique, list(packager.techniques)) for technique in dict.fromkeys(asked.techniques)]
    files = dict(packager.file(techniques, endings) if techniques else packager.files(endings))
    if asked.bevy:
        files = {name: f"#define_import_path gnomon::{Path(name).stem}\n\n{text}" for name, text in files.items()}
    output = asked.output or (Path() if words else PACKAGES)
    write(output, files) if techniques else replace(output, files, endings)
    print("\n".join(str(output / name) for name in files) if techniques else f"{len(files)} packages in {output}")
    return 0


def refused(why):
    print(f"package.py: {why}", file=sys.stderr)
    return 2


def main():
    try:
        sys.exit(run(sys.argv[1:]))
    except OSError as error:
        sys.exit(refused(f"{error.filename}: {error.strerror}"))
    except (DialectError, ValueError) as error:
        sys.exit(refused(error))


if __name__ == "__main__":
    main()
