#!/usr/bin/env python3
"""Compiles the examples of README.md and of pages in docs, so that what a newcomer copies works.

usage: examples.py ROOT PACKAGES               prints what a compiler has against an example; exit code 1 if there is any
       examples.py ROOT PACKAGES SECTION CHECKER...    those of a section, by a checker that takes a folder: in WGSL beside packages

ROOT holds README.md, PACKAGES the shader packages. An example is the indented text of a section, up to the next that begins
with an include or a version. Commands are none.
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
COMMANDS = ("cmake ", "python3 ", "./run ")
# Document: section: the example's ending and compiler.
EXAMPLES = {
    "README.md": {
        "Use it in C++": (".cpp", ["g++", *CXX, "-c"]),
        "Use it in GLSL": (".frag", GLSLANG),
    },
    "docs/lessons.md": {
        "A filter of your own": (".cpp", ["g++", *CXX, "-c"]),
    },
    "docs/engines.md": {
        "Translucent occluders": (".frag", GLSLANG),
        "Table of soft shadows": (".comp", GLSLANG),
        "Soft shadows": (".frag", GLSLANG),
        "Resampling for single scattering": (".frag", GLSLANG),
        "Averages along view rays": (".comp", GLSLANG),
        "Single scattering": (".frag", GLSLANG),
    },
    "docs/layered_motion.md": {
        "Passes": (".cpp", ["g++", *CXX, "-c"]),
        "From samples to layers": (".comp", GLSLANG),
        "Look-up": (".frag", GLSLANG),
    },
    "docs/scattering.md": {
        "Passes": (".cpp", ["g++", *CXX, "-c"]),
    },
    "docs/shaders.md": {
        "Vulkan": (".frag", GLSLANG),
        "OpenGL and OpenGL ES": (".frag", ["glslangValidator", "-l"]),
        "OpenGL ES and WebGL without 16-bit UNORM": (".frag", ["glslangValidator", "-l"]),
        "Direct3D": (".hlsl", [*GLSLANG, "-D", "-S", "frag", "-e", "main"]),
        "Metal": (".metal", [*ROUTES["metal"].compiler, "-Wno-unknown-attributes"]),
        "CUDA": (".cu", [*CUDA, "-c"]),
        "OpenCL": (".cl", ROUTES["opencl"].compiler),
    },
}


def examples_in(root, document, section):
    page = (root / document).read_text().split(f"# {section}\n")[1].split("\n#")[0]
    examples = []
    for block in re.findall(r"^    .*\n(?:(?:    .*)?\n)*", page + "\n", re.MULTILINE):
        text = re.sub(r"^    ", "", block, flags=re.MULTILINE)
        if text.startswith(COMMANDS):
            continue
        if not examples or text.startswith("#"):
            examples.append("")
        examples[-1] += text
    return examples


def pasted(text, packages):
    """The text as an engine without #include hands it on."""
    return re.sub(r'^#include "(.*)"\n', lambda include: (packages / include[1]).read_text(), text, flags=re.MULTILINE)


def checked_wgsl(root, packages, section, checker):
    """The examples of a section beside every package in Bevy's form, or beside files that hold two techniques each."""
    sys.path.insert(0, str(root / "shaders"))
    from package import Packager

    examples = examples_in(root, "docs/shaders.md", section)
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        if section == "Bevy":
            subprocess.run([sys.executable, "-B", root / "shaders/package.py", "--bevy", "--output", folder], check=True)
        else:
            examples = [(packages / "moments4.wgsl").read_text() + "".join(examples)]
            packager = Packager()
            techniques = list(packager.techniques)
            for pair in [*zip(techniques, techniques[1:]), ("moments4", "variance")]:
                (name, text), = packager.file(pair, ["wgsl"])
                (folder / name).write_text(text)
        for i, example in enumerate(examples):
            (folder / f"example{i}.wgsl").write_text(example)
        return subprocess.run([*checker, folder]).returncode


def checked_essl(root, packages, section, checker):
    with tempfile.TemporaryDirectory() as folder:
        for i, example in enumerate(examples_in(root, "docs/shaders.md", section)):
            (Path(folder) / f"example{i}.frag").write_text(pasted(example, packages))
        return subprocess.run([*checker, folder]).returncode


def main():
    root, packages = Path(sys.argv[1]), Path(sys.argv[2])
    if sys.argv[3:]:
        checked = checked_essl if "OpenGL" in sys.argv[3] else checked_wgsl
        sys.exit(checked(root, packages, sys.argv[3], sys.argv[4:]))
    count = failed = 0
    for document, sections in EXAMPLES.items():
        for section, (ending, compiler) in sections.items():
            examples = examples_in(root, document, section)
            assert examples, f"{document}, {section}: no example"
            for example in examples:
                if "OpenGL" in section:
                    example = pasted(example, packages)
                with tempfile.TemporaryDirectory() as folder:
                    unit = Path(folder) / f"example{ending}"
                    unit.write_text(example)
                    output = [] if "-l" in compiler else ["-o", f"{folder}/out"] # glslang writes nothing of ESSL 300
                    run = subprocess.run([*compiler, f"-I{root / 'include'}", f"-I{packages}", *output, str(unit)],
                                         capture_output=True, text=True)
                count += 1
                if run.returncode:
                    failed += 1
                    print(f"{document}, {section}: {complaints(run)[0]}")
    words = re.findall(r"`(\w+)`", (root / "docs/shaders.md").read_text())
    header = Path("/usr/include/vulkan/vulkan_core.h")
    unknown = {word for word in words if word.startswith("VK_")} - set(re.findall(r"\w+", header.read_text()))
    for name in sorted(unknown):
        print(f"docs/shaders.md: {name} is not a name of {header}")
    unnamed = {path.stem for path in packages.glob("*.glsl")} - set(words)
    for name in sorted(unnamed):
        print(f"docs/shaders.md: does not name the package {name}")
    print(f"{count} examples, {failed} refused")
    sys.exit(bool(failed or unnamed or unknown))


main()
