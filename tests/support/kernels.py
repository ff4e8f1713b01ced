#!/usr/bin/env python3
"""Joins the kernels of the headers with their lines in kernels.txt to the table that tests and benches share.

usage: kernels.py OUTPUT TABLE HEADER...    writes a C++ header that includes all headers and defines
    GNOMON_FOR_EACH_KERNEL(KERNEL) as KERNEL(name, inputs, outputs, "FAMILY...", unit) for every kernel: how many numbers go
    in and come out, from which families they come, and whether the results are in [0, 1] whatever they are
"""
import re
import sys
from pathlib import Path
from typing import NamedTuple

TYPE = r"(?:GNOMON_(?:LIST_)?T\(\w+\)|\w+)"
HEAD = r"GNOMON_(DETAIL_)?(?:LIST_)?KERNEL"
CAPACITY = r"^#define GNOMON_\w+_CAPACITY (\d+)"


class Kernel(NamedTuple):
    name: str
    header: str # as it is included
    result: str # a struct's name or Real
    parameters: list # of the same


class Line(NamedTuple):
    place: str # FILE:NUMBER
    families: list
    unit: bool


class Headers:
    """The structs of some headers, member by member as (type, name), their public kernels, and the parts of these."""

    def __init__(self, headers):
        self.structs, self.kernels, self.details = {}, [], []
        for header in sorted(headers):
            text = re.sub(r"//.*", "", Path(header).read_text())
            name = re.fullmatch(r".*/(gnomon/.*)", Path(header).as_posix())[1] # the clone may be in a folder named gnomon as well
            for struct, body in re.findall(r"^GNOMON_(?:LIST_)?STRUCT\((\w+)\)\s*\{([^}]*)\}", text, re.MULTILINE):
                capacity = re.search(CAPACITY, text, re.MULTILINE)
                self.structs[struct] = [(type_name(member_type), element)
                                        for member_type, members in re.findall(rf"({TYPE})\s+([\w\s,\[\]]+);", body)
                                        for member in members.split(",")
                                        for element in elements(member.strip(), capacity)]
            found = re.findall(rf"^{HEAD}\s+({TYPE})\s+(\w+)\(((?:[^()]|\(\w+\))*)\)", text, re.MULTILINE)
            if len(found) != len(re.findall(rf"^{HEAD}\b", text, re.MULTILINE)):
                raise ValueError(f"{header}: a kernel's head that is not understood")
            for detail, result, kernel, parameters in found:
                types = [type_name(parameter.split()[0]) for parameter in parameters.split(",")]
                if "GNOMON_MASK" in [result, *types] and not detail:
                    raise ValueError(f"{header}: {kernel} has a mask, which no table can hold: make it a GNOMON_DETAIL_KERNEL")
                (self.details if detail else self.kernels).append(Kernel(kernel, name, type_name(result), types))

    def numbers(self, type_):
        """The numbers of a type as member accesses, such as .phase.cosine, or the empty access for a Real."""
        if type_ == "Real":
            return [""]
        return [f".{member}{rest}" for member_type, member in self.structs[type_] for rest in self.numbers(member_type)]

    def inputs(self, kernel):
        return sum(len(self.numbers(parameter)) for parameter in kernel.parameters)


def elements(member, capacity):
    """The name of a member, or of each element of an array with the default capacity."""
    name = member.removesuffix("[GNOMON_CAPACITY]")
    return [member] if name == member else [f"{name}[{i}]" for i in range(int(capacity[1]))]


def type_name(text):
    name = re.sub(r"GNOMON_(?:LIST_)?T\((\w+)\)", r"\1", text)
    return "Real" if name == "GNOMON_SETTING" else name


def table(path):
    lines = {}
    for number, text in enumerate(Path(path).read_text().splitlines(), 1):
        if not text or text.startswith("#"):
            continue
        if text.startswith("include "):
            more = table(Path(path).parent / text.removeprefix("include "))
        else:
            match = re.fullmatch(r"(\w+):((?: \w+)+)( -> unit)?", text)
            more = match and {match[1]: Line(f"{path}:{number}", match[2].split(), bool(match[3]))}
        if not more or more.keys() & lines.keys():
            raise ValueError(f"{path}:{number}: KERNEL: FAMILY... [-> unit] expected, once per kernel")
        lines |= more
    return lines


def read(path, headers):
    """The contents of the headers and the lines of the table, which must name the same public kernels."""
    found, lines = Headers(headers), table(path)
    names, details = ({kernel.name for kernel in kernels} for kernels in (found.kernels, found.details))
    for kernel in found.kernels:
        if kernel.name not in lines:
            raise ValueError(f"{path}: no line for {kernel.name} ({kernel.header})")
    for name, line in lines.items():
        if name in details:
            raise ValueError(f"{line.place}: {name} is a GNOMON_DETAIL_KERNEL, which runs as a part of others: no line")
        if name not in names:
            raise ValueError(f"{line.place}: no header defines {name}")
    return found, lines


def main():
    output, path, *headers = sys.argv[1:]
    try:
        found, lines = read(path, headers)
    except (OSError, ValueError) as error:
        print(f"kernels.py: {error}", file=sys.stderr)
        sys.exit(2)
    includes = dict.fromkeys(f"#include <{kernel.header}>\n" for kernel in found.kernels)
    rows = [f'KERNEL({kernel.name}, {found.inputs(kernel)}, {len(found.numbers(kernel.result))}, '
            f'"{" ".join(lines[kernel.name].families)}", {str(lines[kernel.name].unit).lower()})' for kernel in found.kernels]
    Path(output).write_text("#pragma once\n" + "".join(includes) + "#define GNOMON_FOR_EACH_KERNEL(KERNEL) \\\n    " +
                            " \\\n    ".join(rows) + "\n")


if __name__ == "__main__":
    main()
