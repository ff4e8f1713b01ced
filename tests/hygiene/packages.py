#!/usr/bin/env python3
"""The shader packages of one language: each by itself, all in one unit, and the same code as the headers have. Files of some
techniques together are among them.

usage: packages.py LANGUAGE INCLUDE PACKAGES             prints one line for each fault; exit code 1 if there is any
       packages.py LANGUAGE INCLUDE --prefix PREFIX      the same of packages that are written with another prefix

LANGUAGE is a key of languages.ROUTES, INCLUDE the folder that holds gnomon/, PACKAGES the one that shaders/package.py
wrote. Every unit makes the compiler go through every kernel in it. What is compared, function by function, is SPIR-V or
LLVM's code, after undoing what the packager may do: take a branch whose condition the language decides, and, where the
language has no namespaces, prefix a name. No other name may be there without one than a kernel's of the table, and a struct's
or a constant's that begins with a technique.
"""
import re
import struct
import subprocess
import sys
import tempfile
from fractions import Fraction
from functools import lru_cache
from pathlib import Path

from languages import ROUTES, complaints

sys.path += [str(Path(__file__).parents[1] / "support"), str(Path(__file__).parents[2] / "shaders")]
from kernels import Headers
from package import Packager

SPIRV_PASSES = ["--eliminate-dead-branches", "--merge-blocks", "--eliminate-local-single-block",
                "--eliminate-local-single-store", "--ssa-rewrite", "--eliminate-dead-code-aggressive"]


NAMESPACES = ("c++", "metal")
SUBSETS = [["moments4", "variance"], ["moments6", "moments4"]]
DEFINED = re.compile(r"^GNOMON_(?:(?:LIST_)?STRUCT|CONSTANT)\((\w+)", re.MULTILINE)
GLOBAL = re.compile(r"^(?:typedef )?(?:static inline |__constant |static |const )*(?!return|else|precision)\w+ (\w+)(\(| = |\s*\{)",
                    re.MULTILINE)


@lru_cache(maxsize=4)
def words_of(text):
    return frozenset(re.findall(r"\w+", text))


class Refused(Exception):
    pass


class Names:
    """What the headers define, and what it is called in a package."""

    def __init__(self, include, prefix):
        self.prefix = prefix
        self.headers = [path for path in (include / "gnomon").rglob("*.h") if path.parent.name != "portable"]
        found = Headers(self.headers)
        self.public = found.kernels
        self.kernels = self.public + [kernel for kernel in found.details
                                      if "GNOMON_MASK" not in [kernel.result, *kernel.parameters]]
        self.all = {kernel.name for kernel in self.public + found.details} | {
            name for path in self.headers for name in DEFINED.findall(path.read_text())}
        self.techniques = {re.match("[a-z]+", path.stem)[0] for path in self.headers if path.parent.name != "numerics"}

    def packaged(self, name, text):
        """The name as the package of this text has it."""
        return self.prefix + name if self.prefix + name in words_of(text) else name

    def plain(self, text):
        """The text with the headers' own names."""
        return re.sub(rf"\b{self.prefix}(\w+)", lambda word: word[1] if word[1] in self.all else word[0], text)

    def at_large(self, text):
        """Names of a package that a user's own might meet."""
        public = {kernel.name for kernel in self.public}
        for name, after in GLOBAL.findall(re.sub("//.*", "", text)):
            technique = re.match("[a-z]*", name)[0] in self.techniques and re.search(r"[_\d]", name)
            if not name.startswith((self.prefix, "gnomon_")) and name not in public and (after == "(" or not technique):
                yield name


def touch(language, kernels, named):
    """(definitions, statements) that make a compiler go through these kernels."""
    if language in ("opencl", "metal"): # functions with neither static nor inline are compiled in any case
        return "", ""
    if language == "c++":
        instances = [f"template {typed(kernel.result, real)} {kernel.name}<{real}>"
                     f"({', '.join(typed(parameter, real) for parameter in kernel.parameters)});\n"
                     for kernel in kernels for real in ("float", "double")]
        return f"namespace gnomon {{\n{''.join(instances)}}}\n", ""
    calls = []
    for kernel in kernels:
        names = [f"a{i}" for i in range(len(kernel.parameters))]
        declared = "".join(f"{'float' if type_ == 'Real' else named(type_)} {name}; "
                           for type_, name in zip(kernel.parameters, names))
        calls.append(f"{{ {declared}{named(kernel.name)}({', '.join(names)}); }}\n")
    return "", "".join(calls)


def typed(type_, real):
    return real if type_ == "Real" else f"{type_}<{real}>"


def code(language, text, kernels, folder, names, include=None):
    """The code that a unit becomes, by function."""
    route = ROUTES[language]
    definitions, statements = touch(language, kernels, lambda name: names.packaged(name, text))
    plain = "#define static\n#define inline\n" if language in ("opencl", "metal") else ""
    output = folder / "unit.out"
    run = route.compiled(route.begin + plain + text + definitions + route.main.format(statements), output, include)
    if run.returncode:
        raise Refused(complaints(run)[0])
    if not route.writes:
        return {}
    if route.compiler[0] == "glslangValidator":
        return spirv_functions(output, names.plain, validated=bool(include))
    return llvm_functions(names.plain(output.read_text()))


def llvm_functions(text):
    text = re.sub(r"(?:, )?!\w+(?: !\d+)?| #\d+|;.*|(?<=\w)\.\d+(?=\")", "", text) # numbers given per unit
    return {head[1]: body for body, head in
            ((body, re.search(r"@(\w+)\(", body)) for body in re.findall(r"^define .*?^}", text, re.MULTILINE | re.DOTALL))}


def spirv_functions(path, plain, validated):
    """Functions by name; in each, types and constants are spelled out, and ids counted from 0. The headers' module is validated,
    which takes most of the time, and functions of packages are the same."""
    optimised = path.with_suffix(".opt")
    options = [] if validated else ["--skip-validation"]
    subprocess.run(["spirv-opt", *options, *SPIRV_PASSES, str(path), "-o", str(optimised)], check=True)
    run = subprocess.run(["spirv-dis", "--raw-id", "--no-color", "--no-indent", "--no-header", str(optimised)],
                         check=True, capture_output=True, text=True)
    head, *functions = re.split(r"\n(?=%\d+ = OpFunction )", run.stdout)
    names = dict(re.findall(r'^OpName (%\d+) "(@?\w+)', plain(head), re.MULTILINE))
    spelled = {}
    for name, text in re.findall(r"^(%\d+) = (Op(?:Type|Constant|Variable|Undef).*)", head, re.MULTILINE):
        spelled[name] = f"({re.sub(r'%[0-9]+', lambda word: spelled[word[0]], text)} {names.get(name, '')})"
    decorated = {}
    for name, text in re.findall(r"^OpDecorate (%\d+) (.*)", head, re.MULTILINE):
        decorated[name] = decorated.get(name, "") + f" {text}"

    def function(text):
        local = {}

        def word(found):
            name = found[0]
            if name in callees or name in spelled:
                return callees.get(name) or spelled[name]
            return local.setdefault(name, f"%{len(local)}{decorated.get(name, '')}")

        return re.sub(r"%\d+", word, text).strip()

    callees = {text.split(" ", 1)[0]: names[text.split(" ", 1)[0]] for text in functions}
    return {callees[text.split(" ", 1)[0]]: function(text) for text in functions}


def rounds_once(decimal):
    """Whether a number becomes the same float at once and by way of double, as in C++: not where a tie arises on the way."""
    double = float(decimal)
    low_bits = struct.unpack("Q", struct.pack("d", double))[0] & 0x1fffffff
    return low_bits != 0x10000000 or Fraction(decimal) == Fraction(double)


def main():
    language, include, packages = sys.argv[1], *map(Path, sys.argv[2:4])
    prefix = (sys.argv[4:] or ["gnomon_"])[0]
    names = Names(include, prefix)
    kernels = names.kernels
    packager = Packager(include, prefix)
    files = {path.name: path.read_text() for path in sorted(packages.glob("*"))}
    if sys.argv[4:]:
        files = dict(packager.files())
    for techniques in SUBSETS:
        files |= dict(packager.file(techniques, [ROUTES[language].package]))
    texts = {Path(name).stem: text for name, text in files.items() if name.endswith("." + ROUTES[language].package)}
    faults, functions = [], {}
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)

        def compiled(what, text, wanted, include=None):
            try:
                functions[what] = code(language, text, wanted, folder, names, include)
            except Refused as refused:
                faults.append(f"{what}: {refused}")

        headers = "".join(f'#include "{header}"\n' for header in sorted({kernel.header for kernel in kernels}))
        compiled("headers", headers, kernels, include)
        compiled("all packages", "\n".join([*texts.values()] * 2), kernels)
        for name, text in texts.items():
            heads = re.findall(r"^(?:\w[^(\n]*\b|    )(\w+)\(", text, re.MULTILINE)
            compiled(name, text, [kernel for kernel in kernels if names.packaged(kernel.name, text) in heads])
            if language not in NAMESPACES:
                faults += [f"{name}: {word} is a helper without a prefix" for word in names.at_large(text)]
            if name == "gnomon":
                faults += [f"{name}: {kernel.name} is missing" for kernel in names.public if kernel.name not in heads]
            faults += [f"{name}: {number} is rounded to another float by way of double"
                       for number in set(re.findall(r"\d+\.\d*(?:e[+-]?\d+)?|\d+e[+-]?\d+", re.sub("//.*", "", text)))
                       if not rounds_once(number)]
            for macro in set(re.findall(r"^ *# *define +(?!GNOMON_)(\w+)", text, re.MULTILINE)):
                faults.append(f"{name}: defines {macro}")
    for what, found in functions.items():
        faults += [f"{what}: {name} is other code than in the headers" for name, text in found.items()
                   if "main" not in name and functions["headers"].get(name) != text]
    missing = set(functions.get("headers", {})) - set(functions.get("gnomon", {}))
    faults += [f"gnomon: {name} is missing" for name in missing if "gnomon_fma" not in name]
    print("\n".join(faults))
    print(f"{language}: {len(texts)} packages, {len(kernels)} kernels, {len(faults)} faults")
    sys.exit(bool(faults) or not texts)


main()
