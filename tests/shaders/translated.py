#!/usr/bin/env python3
"""Modules of SPIR-V as translators write them for other compilers: no text of theirs has the word precise.

usage: translated.py ROUTE MODULES OUTPUT [NODE]    ROUTE is a key of ROUTES, MODULES what shaders.py wrote, for glsl_fragment if
                                                    the route has fragment shaders alone, else for glsl; NODE is the command
                                                    that runs dawn/translate.mjs for naga

essl300, glsl330: OUTPUT/KERNEL.frag. essl310: OUTPUT/KERNEL.comp. hlsl: OUTPUT/KERNEL.hlsl, and KERNEL.spv, which glslang makes
of it. msl: OUTPUT/translated.metal, a namespace for each kernel with its entry point, and FOR_EACH_TRANSLATED, which names them;
kernels with arrays, whose address spaces no C++ compiler knows, are left out. Last, OUTPUT/modules, the kernels' names.
"""
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

GLSLANG = ["glslangValidator", "-V", "--target-env", "vulkan1.1", "-D", "-Od", "-e", "main", "-S", "comp"]
METAL_HEAD = re.compile(r"^(?:#.*|using .*;)\n", re.MULTILINE)
METAL_ARRAYS = re.compile(r"\bspvUnsafeArray\b|\buint2\b")
# A function's parameters, which glslang puts into its name, spelled out by naga: longer than glslang reads.
SPELLED_OUT = re.compile(r"_u0028_\w*")


class Route(NamedTuple):
    ending: str
    options: list # of SPIRV-Cross
    target: str # of naga


ROUTES = {
    "essl310": Route(".comp", ["--es", "--version", "310"], "310 es"),
    "essl300": Route(".frag", ["--es", "--version", "300"], "300 es"),
    "glsl330": Route(".frag", ["--no-es", "--version", "330", "--no-420pack-extension"], "330"), # bindings are of 4.2
    "hlsl": Route(".hlsl", ["--hlsl", "--shader-model", "60"], "hlsl"),
    "msl": Route(".metal", ["--msl"], "msl"),
}


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise ValueError(f"{' '.join(map(str, command))}: {(done.stderr + done.stdout).strip()[:400]}")


def namespaces(output, names):
    """All texts in Metal as one, each in a namespace of its own."""
    texts = {name: METAL_HEAD.sub("", (output / f"{name}.metal").read_text()) for name in names}
    texts = {name: text for name, text in texts.items() if not METAL_ARRAYS.search(text)}
    spaces = "".join(f"namespace translated_{name} {{\n{text}}}\n" for name, text in texts.items())
    every = " ".join(f"DO({name})" for name in texts)
    (output / "translated.metal").write_text(f"{spaces}#define FOR_EACH_TRANSLATED(DO) {every}\n")


def main():
    name, modules, output, *node = sys.argv[1:]
    route, modules, output = ROUTES[name], Path(modules), Path(output)
    output.mkdir(parents=True, exist_ok=True)
    names = (modules / "modules").read_text().split()
    targets = {kernel: output / (kernel + route.ending) for kernel in names}
    with ThreadPoolExecutor() as pool:
        if node:
            run(*node, route.target, modules, output, route.ending, *names)
            for text in targets.values():
                text.write_text(SPELLED_OUT.sub("_", text.read_text()))
        else:
            list(pool.map(lambda kernel: run("spirv-cross", *route.options, modules / f"{kernel}.spv", "--output", targets[kernel]), names))
        if name == "hlsl":
            list(pool.map(lambda text: run(*GLSLANG, "-o", text.with_suffix(".spv"), text), targets.values()))
    if name == "msl":
        namespaces(output, names)
    (output / "modules").write_text("".join(f"{kernel}\n" for kernel in names))


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError) as error:
        print(f"translated.py: {error}", file=sys.stderr)
        sys.exit(2)
