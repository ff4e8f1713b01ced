#!/usr/bin/env python3
"""Writes the shader packages: the kernels of include/gnomon as files of one language each, that include nothing.

usage: package.py INCLUDE VERSION OUTPUT [PREFIX]    writes gnomon.ENDING and TECHNIQUE.ENDING into the folder OUTPUT

INCLUDE is the folder that holds gnomon/, VERSION is like 0.1.0. PREFIX, or else gnomon_, begins the names of helpers where
the language has no namespaces. docs/architecture.md says how packages come about.
"""
import itertools
import os
import re
import sys
from pathlib import Path

import wgsl
from dialect import CONSTANT, DEFINED, DialectError, Header, Prelude
from helpers import internal
from layout import laid_out

# Ending of the packages: prelude, the language's name, and how the preprocessor tells another language.
LANGUAGES = {
    "glsl": ("glsl.h", "GLSL", "defined(__cplusplus) || defined(__HLSL_VERSION) || defined(__OPENCL_C_VERSION__)"),
    "hlsl": ("hlsl.h", "HLSL", "defined(GL_ES) || defined(__METAL_VERSION__) || defined(__OPENCL_C_VERSION__)"),
    "metal": ("msl.h", "Metal", "!defined(__METAL_VERSION__)"),
    "cl": ("opencl.h", "OpenCL C", "!defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)"),
    "cuh": ("cpp.h", "CUDA and C++20", "!defined(__cplusplus) || defined(__METAL_VERSION__)"),
}

# Technique: the headers that it starts from, and for moments how many of them. What else it takes follows from the
# headers' includes. A header below one of FOLDERS is a technique by itself, with its storage formats.
TECHNIQUES = {
    "moments4": (["moments/quantization.h", "moments/affine.h", "storage/moments4.h", "storage/moments4_within.h",
                  "moments/hamburger4.h"], "4"),
    "moments6": (["moments/quantization.h", "moments/affine.h", "storage/moments6.h", "moments/hamburger6.h"], "6"),
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
    def __init__(self, include, version, prefix="gnomon_"):
        self.root = include / "gnomon"
        self.version = version
        self.number = int("".join(f"{int(part):02}" for part in version.split(".")))
        names = sorted(path.relative_to(self.root).as_posix() for path in self.root.rglob("*.h"))
        names = [name for name in names if not name.startswith(("portable", "version"))]
        self.headers = {name: Header.read(self.root, name) for name in names}
        roots = TECHNIQUES | {Path(name).stem: (self.with_storage(name), "") for name in names if Path(name).parts[0] in FOLDERS}
        self.packages = {technique: (closure(self.headers, start), count) for technique, (start, count) in roots.items()}
        counted = [headers for headers, count in self.packages.values() if count]
        self.shared = [header for header in counted[0] if all(header in headers for headers in counted)]
        everything = closure(self.headers, ["gnomon.h", *names])
        for header in everything:
            if not any(header in headers for headers, _ in self.packages.values()):
                raise DialectError(f"{self.root / header.name}: in no technique of package.py")
        self.packages["gnomon"] = (everything, "")
        self.prefix, self.internal = prefix, internal(everything)

    def with_storage(self, name):
        """The header of a technique and that of its storage formats, which includes it."""
        storage = f"storage/{Path(name).name}"
        return [storage] if name.startswith("filters/") and storage in self.headers else [name]

    def files(self):
        """(name, text) of every package."""
        for ending, (prelude, language, other) in LANGUAGES.items():
            prelude = Prelude.read(self.root / "portable" / prelude)
            prelude.forget_unused(self.headers.values())
            if not prelude.has_namespaces:
                prelude.names, prelude.prefix = self.internal, self.prefix
            for package, (headers, count) in self.packages.items():
                name = f"{package}.{ending}"
                checks = CHECKS.format(name=name, language=language, other=other, number=self.number)
                text = self.package(name, language, checks, prelude, headers, count)
                yield name, text
                if ending == "glsl":
                    yield f"{package}.wgsl", wgsl.translated(text)

    def name(self, name):
        """A name of the headers as it is in packages of languages without namespaces."""
        return self.prefix + name if name in self.internal else name

    def package(self, name, language, checks, prelude, headers, count):
        guard = "GNOMON_" + re.sub(r"\W", "_", name).upper()
        text = HEADING.format(version=self.version, name=name, language=language)
        text += f"#ifndef {guard}\n#define {guard}\n\n" + "".join(f"{block}\n" for block in prelude.frame)
        text += section("the language", prelude.guard, prelude.comment + checks, prelude.own_text())
        for header in headers:
            comment = laid_out(prelude.prefixed(header.comment))
            for about, title, part_guard, blocks in self.parts(header):
                if not count or about in ("", count):
                    text += section(title, part_guard, comment, prelude.spelled(blocks))
                    comment = ""
        undone = dict.fromkeys(re.findall(r"#define (\w+)", "".join(prelude.frame)))
        return text + "".join(f"#undef {macro}\n" for macro in undone) + "#endif\n"

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


def write(files, output):
    """Each file aside, then under its name; packages of an earlier run that are none any more go."""
    output.mkdir(parents=True, exist_ok=True)
    for name, text in files:
        aside = output / f"{name}.new"
        aside.write_text(text)
        os.replace(aside, output / name)
    for path in output.glob("*.*"):
        if path.name not in dict(files) and "Written by shaders/package.py" in path.read_text():
            path.unlink()


def main():
    if len(sys.argv) not in (4, 5) or not re.fullmatch(r"\d+\.\d+\.\d+", sys.argv[2]):
        print("package.py: INCLUDE, VERSION such as 0.1.0, OUTPUT, and perhaps PREFIX expected", file=sys.stderr)
        sys.exit(2)
    include, version, output = Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
    try:
        write(list(Packager(include, version, *sys.argv[4:]).files()), output)
    except (DialectError, OSError) as error:
        print(f"package.py: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
