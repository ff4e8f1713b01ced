#!/usr/bin/env python3
"""Compiles the examples of README.md, docs/lessons.md and docs/shaders.md, so that what a newcomer copies works.

usage: examples.py ROOT PACKAGES               prints what a compiler has against an example; exit code 1 if there is any
       examples.py ROOT PACKAGES CHECKER...    the example in WGSL by a checker that takes a folder

ROOT holds README.md, PACKAGES the shader packages. An example is the indented text of a section.
"""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from languages import GLSLANG, ROUTES, complaints

CXX = ["-std=c++20", "-Wall", "-Wextra", "-Werror"]
# Where there is no CUDA, a C++ compiler, for which two words and the built-in names mean something plain.
CUDA = ["nvcc", "-std=c++20", "-Werror", "all-warnings"] if shutil.which("nvcc") else [
    "g++", *CXX, "-x", "c++", "-D__global__=", "-include", str(Path(__file__).parent / "cuda_stand_in.hpp")]
# Document: section: the example's ending and compiler.
EXAMPLES = {
    "README.md": {
        "Use it in C++": (".cpp", ["g++", *CXX, "-c"]),
        "Use it in GLSL": (".frag", GLSLANG),
    },
    "docs/lessons.md": {
        "A filter of your own": (".cpp", ["g++", *CXX, "-c"]),
    },
    "docs/shaders.md": {
        "Vulkan": (".frag", GLSLANG),
        "OpenGL and OpenGL ES": (".frag", [*GLSLANG, "--auto-map-bindings", "--auto-map-locations"]),
        "Direct3D": (".hlsl", [*GLSLANG, "-D", "-S", "frag", "-e", "main"]),
        "Metal": (".metal", ROUTES["metal"].compiler),
        "CUDA": (".cu", [*CUDA, "-c"]),
        "OpenCL": (".cl", ROUTES["opencl"].compiler),
    },
}


def example_in(root, document, section):
    page = (root / document).read_text().split(f"## {section}\n")[1].split("\n## ")[0]
    return "\n".join(re.findall(r"^    (.*)$|^$", page, re.MULTILINE)).lstrip()


def pasted(text, packages):
    """The text as an engine without #include hands it on."""
    return re.sub(r'^#include "(.*)"\n', lambda include: (packages / include[1]).read_text(), text, flags=re.MULTILINE)


def checked_wgsl(root, packages, checker):
    with tempfile.TemporaryDirectory() as folder:
        text = (packages / "moments4.wgsl").read_text() + example_in(root, "docs/shaders.md", "WebGPU")
        (Path(folder) / "example.wgsl").write_text(text)
        return subprocess.run([*checker, folder]).returncode


def main():
    root, packages = Path(sys.argv[1]), Path(sys.argv[2])
    if sys.argv[3:]:
        sys.exit(checked_wgsl(root, packages, sys.argv[3:]))
    count = failed = 0
    for document, sections in EXAMPLES.items():
        for section, (ending, compiler) in sections.items():
            example = example_in(root, document, section)
            if "OpenGL" in section:
                example = pasted(example, packages)
            with tempfile.TemporaryDirectory() as folder:
                unit = Path(folder) / f"example{ending}"
                unit.write_text(example)
                run = subprocess.run([*compiler, f"-I{root / 'include'}", f"-I{packages}", "-o", f"{folder}/out", str(unit)],
                                     capture_output=True, text=True)
            count += 1
            if run.returncode:
                failed += 1
                print(f"{document}, {section}: {complaints(run)[0]}")
    words = re.findall(r"`(\w+)`", (root / "docs/shaders.md").read_text())
    unnamed = {path.stem for path in packages.glob("*.glsl")} - set(words)
    for name in sorted(unnamed):
        print(f"docs/shaders.md: does not name the package {name}")
    print(f"{count} examples, {failed} refused")
    sys.exit(bool(failed or unnamed))


main()
