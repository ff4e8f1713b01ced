#!/usr/bin/env python3
"""A unit that no compiler can get right is answered in the library's words, and these come first.

usage: mistakes.py INCLUDE PACKAGES    prints one line for each mistake that is answered otherwise; exit code 1 if there is any

INCLUDE is the folder that holds gnomon/, PACKAGES the one that shaders/package.py wrote.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from languages import INCLUDES, ROUTES, complaints

EVERYTHING = '#include "gnomon/gnomon.h"\n'
CPP_ONLY = "gnomon: a .hpp is C++ only"
LANGUAGE = "gnomon: unknown language"
C = ["gcc", "-x", "c", "-fsyntax-only"]
CPP = ["g++", "-x", "c++", "-fsyntax-only"]
OPENCL = ROUTES["opencl"].compiler
PREPROCESS = ["glslangValidator", "-E", "-S", "frag"]


def compiler_says(command, ending, text, include, folder):
    unit = folder / f"unit{ending}"
    unit.write_text(text)
    run = subprocess.run([*command, f"-I{include}", str(unit)], capture_output=True, text=True, cwd=folder)
    return complaints(run)[0] if run.returncode else "nothing"


def mistakes(include, packages):
    """(what, compiler, ending, text, answer)"""
    for path in sorted(include.rglob("*.hpp")):
        name = path.relative_to(include).as_posix()
        for language in ("glsl", "hlsl", "opencl", "metal"):
            route = ROUTES[language]
            yield f"{name} in {language}", route.compiler, route.ending, f'{route.begin}#include "{name}"\n', CPP_ONLY

    yield "C", C, ".c", EVERYTHING, LANGUAGE
    yield "a macro Real", [*CPP, "-std=c++20"], ".cpp", "#define Real float\n" + EVERYTHING, "gnomon: a macro named Real"
    yield "C++17", [*CPP, "-std=c++17"], ".cpp", EVERYTHING, "gnomon: C++20 needed"
    yield "C++ -ffast-math", [*CPP, "-std=c++20", "-ffast-math"], ".cpp", EVERYTHING, "gnomon: fast mathematics voids"
    yield "OpenCL C 1.1", [*OPENCL, "-cl-std=CL1.1"], ".cl", EVERYTHING, "gnomon: -cl-std=CL1.2 or later"
    for flag in ("-cl-fast-relaxed-math", "-cl-finite-math-only"):
        yield f"OpenCL, {flag}", [*OPENCL, flag], ".cl", EVERYTHING, "gnomon: -cl-fast-relaxed-math and -cl-finite-math-only void"
    yield "Metal, fast", [*ROUTES["metal"].compiler, "-ffast-math"], ".metal", EVERYTHING, "gnomon: fast mathematics voids"
    yield "OpenCL, embedded", [*OPENCL, "-D__EMBEDDED_PROFILE__"], ".cl", EVERYTHING, "gnomon: the full profile needed"
    for version, answer in {"150": "gnomon: #version 330", "100": "gnomon: #version 300 es"}.items():
        begin = f"#version {version}\n"
        yield f"#version {version}", PREPROCESS, ".frag", begin + INCLUDES + EVERYTHING, answer
        for package in sorted(packages.glob("*.glsl")):
            yield f"{package.name}, #version {version}", PREPROCESS, ".frag", begin + package.read_text(), answer
    yield ("GLSL without the extension for #include", ROUTES["glsl"].compiler, ".comp", "#version 450\n" + EVERYTHING,
           "required extension not requested: GL_GOOGLE_include_directive")
    moments4 = (packages / "moments4.glsl").read_text()
    variance = (packages / "variance.glsl").read_text()
    glsl = ROUTES["glsl"]
    older = re.sub(r"GNOMON_PACKAGE (!= )?\d+", r"GNOMON_PACKAGE \g<1>1", variance)
    for what, text, answer in [
            ("packages of two versions", moments4 + older, "gnomon: variance.glsl is not of the same version"),
            ("a header behind a package", variance + EVERYTHING, "gnomon: a shader package is included already"),
            ("a package behind a header", EVERYTHING + variance, "gnomon: variance.glsl and the headers")]:
        yield what, glsl.compiler, ".comp", glsl.begin + text, answer
    for ending, other in {"glsl": "opencl", "hlsl": "essl310", "metal": "c++", "cl": "c++", "cuh": "metal"}.items():
        route = ROUTES[other]
        yield (f"variance.{ending} in {other}", route.compiler, route.ending,
               route.begin + (packages / f"variance.{ending}").read_text(), f"gnomon: variance.{ending} is ")
    yield "HLSL by a compiler that defines no macro", ["cpp", "-undef"], ".hlsl", EVERYTHING, LANGUAGE


def main():
    include, packages = map(Path, sys.argv[1:])
    count = wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        for what, command, ending, text, answer in mistakes(include.resolve(), packages):
            said = compiler_says(command, ending, text, include.resolve(), Path(folder))
            count += 1
            if answer not in said:
                wrong += 1
                print(f"{what}: '{answer}' expected, not '{said}'")
    print(f"{count} mistakes, {wrong} with a wrong answer")
    sys.exit(wrong > 0)


main()
