#!/usr/bin/env python3
"""Writes docs/reference (a page per header of the kernel dialect) and docs/equations.md from the comments of the headers.

usage: reference.py [--check]    run from anywhere; with --check writes nothing and prints what differs; exit code 1 if anything does

Fields of comments are Domain, NaN, Error and Source. A source is a work of docs/bibliography.md, its Eq., Alg., Sec. or
App. after a comma; several are separated by "; ". Every work that a comment of include/ or a page of docs/ cites must be
in the bibliography, every work in it must be cited, and every link between pages must lead somewhere.
"""
import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path += [str(ROOT / "shaders"), str(ROOT / "tests/support")]
import kernels
from dialect import DEFINED, DialectError
from helpers import parts
from package import Packager

DOCS, INCLUDE = ROOT / "docs", ROOT / "include/gnomon"
MEND = "python3 docs/reference.py"
ROOMS = ["numerics", "moments", "filters", "motion/triangle", "motion/range", "motion/receiver", "motion/layers", "storage", "soft",
         "scattering", "comparators"]
FIELDS = ["Domain", "NaN", "Error", "Source"]
OPERATIONS = ["addition", "multiplication", "division", "square root", "comparison", "selection", "minimum or maximum"]
COLUMNS = ["+ −", "×", "÷", "√", "< ≤ =", "select", "min max"]
WORK = re.compile(r"^- \*\*(.+?)\*\*: (.+?)\. \*(.+?)\*\. (.+), (\d{4})\.$", re.MULTILINE)
NAME = r"[A-Z][A-Za-z]*[a-z](?:-[A-Z][a-z]+)?"
CITED = re.compile(rf"\b({NAME}(?:, {NAME})*(?: & {NAME}| et al\.)?) \(?((?:19|20)\d\d)\b")
SOURCE = re.compile(r"([^;]+ \d{4})(?:, (Eq\.|Alg\.|Sec\.|App\.) ([\dA-Z]+(?:\.\d+)*))?")
CONSTANT = re.compile(r"^GNOMON_CONSTANT\((\w+),\s*([^;]*)\);(?: *//<? ?(.*))?", re.MULTILINE)
GENERATED = "<!-- Written by docs/reference.py from the comments of the headers: change those. -->\n"


class Mistake(Exception):
    pass


@dataclass
class Entry:
    """A kernel or struct with its comment."""
    name: str
    signature: str
    about: list # lines of the comment before the fields
    fields: dict # name: lines


def entries(block):
    """The kernels and structs of a block of a header."""
    about, fields, lines, field = [], {}, [], None
    for line in block.splitlines():
        if not line.startswith("///"):
            lines.append(line)
            continue
        text = line[4:]
        found = re.match(rf"({'|'.join(FIELDS)}): ?(.*)", text)
        if found:
            field, text = found.groups()
            fields[field] = []
        (fields[field] if field else about).append(text)
    code = "\n".join(lines)
    found = DEFINED.search(code)
    code = code[found.start():] if found else ""
    if code and not code.startswith("GNOMON_CONSTANT"):
        yield Entry(found[1], signature(code), about, fields)


def signature(code):
    """The head of a kernel or a whole struct, without macros."""
    code = re.sub(r"GNOMON_(?:LIST_)?T\((\w+)\)", r"\1", code).replace("GNOMON_SETTING", "Real").replace("GNOMON_MASK", "bool")
    if struct := re.match(r"GNOMON_(?:LIST_)?STRUCT\((\w+)\)\s*(\{.*?\};)", code, re.DOTALL):
        return f"struct {struct[1]} {struct[2]}".replace("GNOMON_CAPACITY", "capacity")
    head = re.sub(r"\s+", " ", re.match(r"GNOMON_\w+\s+(\w+\s+\w+\((?:[^()]|\(\w+\))*\))", code)[1])
    return head if len(head) <= 100 else head.replace("(", "(\n    ", 1)


def operation_counts(headers):
    """The numbers of OPERATIONS of each kernel, counted by running it."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [str(INCLUDE / name) for name in headers]
        table = str(ROOT / "tests/support/kernels.txt")
        made = subprocess.run([sys.executable, "-B", kernels.__file__, f"{folder}/kernels.hpp", table, *paths])
        if made.returncode:
            raise Mistake("the kernel table and the headers disagree")
        program = f"{folder}/operations"
        subprocess.run([os.environ.get("CXX", "c++"), "-std=c++20", "-O0", f"-I{ROOT / 'include'}", f"-I{ROOT / 'bench'}",
                        f"-I{folder}", str(ROOT / "tests/support/operations.cpp"), "-o", program], check=True)
        lines = subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()
    return {name: list(map(int, numbers)) for name, *numbers in map(str.split, lines)}


class Reference:
    def __init__(self):
        self.packager = packager = Packager()
        self.headers = {header.name: header for header in packager.techniques["gnomon"][0]} # in the order of the flow
        self.packages = {name: sorted(package for package, (headers, _) in packager.techniques.items()
                                      if any(header.name == name for header in headers) and package != "gnomon")
                         for name in self.headers}
        self.entries = {name: [entry for block in header.blocks for entry in entries(block)]
                        for name, header in self.headers.items()}
        self.details = parts(self.headers.values())
        self.public = {name: [entry for entry in found if entry.name not in self.details]
                       for name, found in self.entries.items()}
        self.home = {entry.name: name for name, found in self.public.items() for entry in found}
        self.operations = operation_counts(self.headers)
        self.works = {key: (authors, title, venue, year)
                      for key, authors, title, venue, year in WORK.findall((DOCS / "bibliography.md").read_text())}
        self.mistakes = list(self.check_citations())

    def check_citations(self):
        """Citations of works that the bibliography lacks, works that nobody cites, and an order that is not the alphabet's."""
        cited = set()
        surnames = {key: re.findall(NAME, key) for key in self.works}
        paths = [*ROOT.glob("include/**/*.h*"), *DOCS.glob("*.md"), *DOCS.glob("decisions/*.md"), ROOT / "README.md"]
        for path in sorted(paths):
            if path.name in ("bibliography.md", "equations.md"):
                continue
            text = re.sub(r"\s*\n *(?://+ ?)?", " ", path.read_text())
            for names, year in CITED.findall(text):
                first = re.match(NAME, names)[0]
                found = [key for key in self.works if key.endswith(year) and surnames[key][0] == first]
                if not found:
                    yield f"{path.relative_to(ROOT)}: {names} {year} is no work of docs/bibliography.md"
                cited.update(found)
        for found in self.entries.values():
            for entry in found:
                for work, _, _ in self.sources(entry):
                    if work not in self.works:
                        yield f"{entry.name}: Source: {work} is no work of docs/bibliography.md"
                    cited.add(work)
        for key in self.works.keys() - cited:
            yield f"docs/bibliography.md: nothing cites {key}"
        listed = re.findall(r"^- ", (DOCS / "bibliography.md").read_text(), re.MULTILINE)
        if len(listed) != len(self.works) or list(self.works) != sorted(self.works):
            yield "docs/bibliography.md: works are lines '- **KEY**: AUTHORS. *TITLE*. VENUE, YEAR.', sorted by key"

    def sources(self, entry):
        """(work, kind, number) of an entry's Source."""
        for source in " ".join(entry.fields.get("Source", [])).split("; "):
            found = SOURCE.fullmatch(source.rstrip("."))
            if found:
                yield found[1], found[2] or "", found[3] or ""
            elif source:
                raise Mistake(f"{entry.name}: Source: '{source}' is not of the form 'Author year, Eq. 3'")

    def linked(self, text, page):
        """Text of a comment in Markdown, with links to what it names."""
        text = text.replace("*", r"\*").replace("<", "&lt;").replace("](", r"]\(")

        def link(word):
            if word[0] in self.home and re.search(r"[_\d]", word[0]):
                return f"[`{word[0]}`]({self.path(self.home[word[0]], page)}#{word[0]})"
            return f"`{word[0]}`" if word[0] in self.details else word[0]

        return re.sub(r"(?<![\w/.])[a-z]\w*\b(?!\.h|/)", link, text)

    def path(self, header, page):
        target = f"reference/{Path(header).with_suffix('.md')}"
        return os.path.relpath(target, Path(page).parent)

    def prose(self, lines, page, indent=""):
        """Lines of a comment as paragraphs; what is indented there stays as it is."""
        text, code = [], False
        for line in lines:
            indentation = len(line) - len(line.lstrip())
            indented = indentation >= 2
            if text and indented != code and line.strip():
                text.append("")
            code = indented if line.strip() else code
            if not indented: # a sum that goes on is no list
                line = re.sub(r"^(?=[+>#] )" if text and text[-1] else r"^(?=[>#] )", r"\\", line)
            text.append((indent + (" " * (4 - indentation) + line if indented else self.linked(line, page))).rstrip())
        return re.sub(r"\n{3,}", "\n\n", "\n".join(text).strip("\n"))

    def page(self, name):
        header, page = self.headers[name], f"reference/{Path(name).with_suffix('.md')}"
        comment = [line[3:] for line in header.comment.splitlines()]
        text = f"{GENERATED}# {name}\n\n{self.prose(comment, page)}\n\n"
        packages = ", ".join(f"`{package}`" for package in ["gnomon", *self.packages[name]])
        source = os.path.relpath(f"../include/gnomon/{name}", Path(page).parent)
        text += f"[Source]({source}). Every language; packages {packages}.\n"
        public = self.public[name]
        counted = [entry for entry in public if entry.name in self.operations]
        if counted:
            text += f"\n| kernel | {' | '.join(COLUMNS)} |\n| --- |{' ---: |' * len(COLUMNS)}\n"
            for entry in counted:
                numbers = " | ".join(str(number or "") for number in self.operations[entry.name])
                text += f"| [`{entry.name}`](#{entry.name}) | {numbers} |\n"
        for entry in public:
            text += f"\n## {entry.name}\n\n" + "".join(f"    {line}\n" for line in entry.signature.splitlines())
            if entry.about:
                text += f"\n{self.prose(entry.about, page)}\n"
            fields = [f"- **{field}:** {self.prose(entry.fields[field], page, '  ').strip()}\n"
                      for field in FIELDS if field in entry.fields and field != "Source"]
            if "Source" in entry.fields:
                fields.append(f"- **Source:** {'; '.join(self.citation(*source, page) for source in self.sources(entry))}\n")
            if entry.name in self.packager.internal:
                fields.append(f"- **In packages** of languages without namespaces: `{self.packager.name(entry.name)}`\n")
            text += "\n" * bool(fields) + "".join(fields)
        constants = [(constant, value, comment) for constant, value, comment in CONSTANT.findall("\n".join(header.blocks))
                     if constant not in self.packager.internal]
        if constants:
            text += "\n## Constants\n\n| constant | value | |\n| --- | --- | --- |\n"
            for constant, value, comment in constants:
                text += f"| `{constant}` | {value} | {self.linked(comment, page)} |\n"
        return text

    def citation(self, work, kind, number, page):
        anchor = os.path.relpath("bibliography.md", Path(page).parent)
        return f"[{work}]({anchor})" + (f", {kind} {number}" if kind else "")

    def index(self):
        page = "reference/README.md"
        text = f"""{GENERATED}# Reference

A page for each header of the kernel dialect, in the order of the flow. Every kernel is there in C++, CUDA, GLSL, HLSL, Metal,
OpenCL C and WGSL ([how](../shaders.md)); signatures are as a shader sees them. In C++ a `Real` is a template parameter: float,
double or a pack.

A kernel takes any bits: outside of its **Domain** it does what stands there, and **NaN** says what it makes of one. **Error** is
what tests hold it to. **Source** leads to the [bibliography](../bibliography.md); [equations](../equations.md) go the other
way. Conventions of depth, moments and intensity have [a page](../conventions.md). Tables count the operations of one call in
float without a fused multiply-add, where every lane needs everything that a branch might skip; what constants alone determine
is not counted; lists have their usual capacity. Registers on a GPU need nvcc: where there is one, the test `parity/cuda/registers` leaves them in
`build/release/tests/shaders/cuda_registers.json`.

Helpers, marked `GNOMON_DETAIL_KERNEL` in the headers, are left out.
"""
        rooms = dict.fromkeys(str(Path(name).parent) for name in self.headers)
        for room in sorted(rooms, key=lambda room: ROOMS.index(room) if room in ROOMS else len(ROOMS)):
            text += f"\n## {room}\n\n| header | holds | |\n| --- | --- | --- |\n"
            for name, header in self.headers.items():
                if str(Path(name).parent) == room:
                    public = ", ".join(f"[`{entry.name}`]({self.path(name, page)}#{entry.name})"
                                       for entry in self.public[name] if entry.name in self.operations)
                    text += f"| [{Path(name).name}]({self.path(name, page)}) | {self.first_sentence(header.comment)} | {public} |\n"
        text += "\n## C++ only\n\n| header | holds |\n| --- | --- |\n"
        for path in sorted(INCLUDE.rglob("*.hpp")):
            name = path.relative_to(INCLUDE).as_posix()
            comment = re.match(r"(?:// ?.*\n)+", path.read_text())[0]
            text += f"| [{name}](../../include/gnomon/{name}) | {self.first_sentence(comment)} |\n"
        return text

    def first_sentence(self, comment):
        lines = [line[3:] for line in comment.splitlines()]
        text = " ".join(re.split(r"\n\s*\n|\n {3,}", "\n".join(lines))[0].split())
        sentence = re.match(r".*?(?:\.(?= [A-Z])(?<!al\.)(?<!Eq\.)(?<!Alg\.)(?<!Sec\.)(?<!App\.)|$)", text)[0]
        sentence = re.sub(r"(?<!\.)[.:]?$", ".", sentence)
        return self.linked(sentence, "reference/README.md").replace("|", r"\|")

    def equations(self):
        page, rows = "equations.md", {}
        for name, found in self.entries.items():
            for entry in found:
                for work, kind, number in self.sources(entry):
                    rows.setdefault((work, kind, number), []).append(
                        f"[`{entry.name}`](" + (f"../include/gnomon/{name}" if entry.name in self.details else
                                                f"{self.path(name, page)}#{entry.name}") + ")")
        text = f"""{GENERATED}# Equations

The kernels that compute what a work states, from the `Source:` fields of their comments. Works are those of the
[bibliography](bibliography.md). A helper's name leads to its header, a public kernel's to its page.

| work | place | kernels |
| --- | --- | --- |
"""
        kinds = ["", "Eq.", "Alg.", "Sec.", "App."]
        works = list(self.works)
        natural = lambda number: [(part.isdigit(), int(part) if part.isdigit() else 0, part) for part in number.split(".")]
        for (work, kind, number), found in sorted(rows.items(), key=lambda row: (
                works.index(row[0][0]) if row[0][0] in works else len(works), kinds.index(row[0][1]), natural(row[0][2]))):
            text += f"| {work} | {kind} {number} | {', '.join(dict.fromkeys(found))} |\n".replace("|   |", "| |")
        return text

    def files(self):
        yield "equations.md", self.equations()
        yield "reference/README.md", self.index()
        for name in self.headers:
            yield f"reference/{Path(name).with_suffix('.md')}", self.page(name)


def broken_links():
    """Links between pages of the repository that lead nowhere."""
    def anchors(page):
        heads = re.findall(r"^#+ (.*)", page.read_text(), re.MULTILINE)
        return {re.sub(r"[^\w -]", "", re.sub(r"\[(.*?)\]\(.*?\)", r"\1", head).lower()).replace(" ", "-") for head in heads}

    for page in sorted([ROOT / "README.md", *DOCS.rglob("*.md"), *ROOT.glob("examples/**/*.md")]):
        text = re.sub(r"^    .*", "", page.read_text(), flags=re.MULTILINE)
        for target, anchor in sorted(set(re.findall(r"(?<!\\)\]\(([^)#:]*)(?:#([^)]*))?\)", text))):
            path = page.parent / target if target else page
            if not path.exists() or anchor and path.suffix == ".md" and anchor not in anchors(path):
                yield f"{page.relative_to(ROOT)}: the link {target}{'#' * bool(anchor)}{anchor} leads nowhere"


def main():
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit("reference.py: --check or nothing expected")
    try:
        reference = Reference()
        files = dict(reference.files())
    except (DialectError, Mistake, OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"reference.py: {error}")
    left = [path for path in DOCS.glob("reference/**/*.md") if path.relative_to(DOCS).as_posix() not in files]
    differing = [name for name, text in files.items() if not (DOCS / name).exists() or (DOCS / name).read_text() != text]
    if check:
        mistakes = [*reference.mistakes, *broken_links()]
        print("\n".join(mistakes), end="\n" * bool(mistakes))
        for name in [*differing, *(path.relative_to(DOCS).as_posix() for path in left)]:
            print(f"docs/{name}: not what the comments say; run: {MEND}")
        print(f"{len(files)} pages, {len(differing) + len(left)} differ, {len(mistakes)} mistakes")
        sys.exit(bool(differing or left or mistakes))
    for name in differing:
        (DOCS / name).parent.mkdir(parents=True, exist_ok=True)
        (DOCS / name).write_text(files[name])
    for path in left:
        path.unlink()
    mistakes = [*reference.mistakes, *broken_links()]
    print("\n".join(mistakes), end="\n" * bool(mistakes))
    sys.exit(bool(mistakes))


if __name__ == "__main__":
    main()
