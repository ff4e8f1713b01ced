#!/usr/bin/env python3
"""Compiles kernel headers, one unit each, in every language that a compiler at hand speaks.

usage: languages.py LANGUAGE INCLUDE    prints one line for each header that a compiler refuses; exit code 1 if there is any

LANGUAGE is a key of ROUTES. INCLUDE is the folder that holds gnomon/.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

GLSLANG = ["glslangValidator", "-V", "--target-env", "vulkan1.1", "-o", "/dev/null"]
COMPUTE = '#extension GL_GOOGLE_include_directive : require\n#include "{}"\nlayout(local_size_x = 1) in;\nvoid main() {{}}\n'

# The unit's text and ending, and the compiler's command line before -I and the unit.
ROUTES = {
    "glsl": ("#version 450\n" + COMPUTE, ".comp", GLSLANG),
    "essl": ("#version 320 es\nprecision highp float;\n" + COMPUTE, ".comp", GLSLANG),
    "hlsl": ('#include "{}"\n[numthreads(1, 1, 1)] void main() {{}}\n', ".hlsl",
             GLSLANG + ["-D", "-DGNOMON_HLSL", "-e", "main", "-S", "comp"]),
    "opencl": ('#include "{}"\n', ".cl",
               ["clang", "-x", "cl", "-cl-std=CL1.2", "-Xclang", "-finclude-default-header", "-target", "spir64", "-Werror",
                "-fsyntax-only"]),
    # Apple's compiler is not to be had here: clang, with the few names of metal_stdlib that the prelude uses.
    "metal": ('#include "{}"\n', ".metal",
              ["clang++", "-x", "c++", "-std=c++14", "-D__METAL_VERSION__=300", "-Wall", "-Wextra", "-Werror", "-fsyntax-only",
               f"-I{Path(__file__).parent / 'metal'}"]),
}


def main():
    language, include = sys.argv[1], Path(sys.argv[2])
    text, ending, compiler = ROUTES[language]
    headers = sorted(h for h in include.rglob("*.h") if h.parent.name != "portable")
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        unit = Path(folder) / ("unit" + ending)
        for header in headers:
            name = header.relative_to(include).as_posix()
            unit.write_text(text.format(name))
            run = subprocess.run(compiler + [f"-I{include}", str(unit)], capture_output=True, text=True)
            if run.returncode:
                failed += 1
                complaint = [line for line in (run.stdout + run.stderr).splitlines() if "error" in line.lower()]
                print(f"{name}: {complaint[0] if complaint else 'refused without a word'}")
    print(f"{language}: {len(headers)} headers, {failed} refused")
    sys.exit(failed > 0 or not headers)


main()
