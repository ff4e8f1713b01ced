#!/usr/bin/env python3
"""Compiles kernel headers, one unit each, in every language that a compiler at hand speaks.

usage: languages.py LANGUAGE INCLUDE    prints one line for each header that a compiler refuses; exit code 1 if there is any

LANGUAGE is a key of ROUTES. INCLUDE is the folder that holds gnomon/.
"""
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

INCLUDES = "#extension GL_GOOGLE_include_directive : require\n"
GLSLANG = ["glslangValidator", "-V", "--target-env", "vulkan1.1"]


@dataclass(frozen=True)
class Route:
    """How a language's units begin and what their main looks like, and the compiler's command line before -I, -o and unit."""
    package: str # the ending of the shader packages
    ending: str
    begin: str
    main: str
    compiler: list[str]
    writes: bool = True # false where the compiler reads this version and has no code for it

    def compiled(self, text, output, include=None):
        """The compiler's run on a unit of this text."""
        unit = output.with_suffix(self.ending)
        unit.write_text(text)
        options = [f"-I{include}"] if include else []
        options += ["-o", str(output)] if self.writes else []
        return subprocess.run([*self.compiler, *options, str(unit)], capture_output=True, text=True)


def complaints(run):
    """What a compiler had against a unit, less the echo of its name."""
    lines = [line for line in (run.stdout + run.stderr).splitlines() if re.search(r"\berror\b", line, re.IGNORECASE)]
    return lines or ["refused without a word"]


C_MAIN = "void calls(void);\nvoid calls(void) {{{}}}\n"
LLVM = ["-O1", "-ffp-contract=off", "-S", "-emit-llvm", "-Wall", "-Wextra", "-Werror", "-Wno-unused"]
ROUTES = {
    "glsl": Route("glsl", ".comp", "#version 450\n" + INCLUDES,
                  "layout(local_size_x = 1) in;\nvoid main() {{{}}}\n", GLSLANG),
    "glsl330": Route("glsl", ".frag", "#version 330\n" + INCLUDES, "void main() {{{}}}\n", ["glslangValidator", "-G"]),
    "glsl400": Route("glsl", ".frag", "#version 400\n" + INCLUDES, "void main() {{{}}}\n", ["glslangValidator", "-G"]),
    "essl300": Route("glsl", ".frag", "#version 300 es\n" + INCLUDES, "void main() {{{}}}\n", ["glslangValidator", "-l"], writes=False),
    "essl310": Route("glsl", ".frag", "#version 310 es\n" + INCLUDES, "void main() {{{}}}\n", GLSLANG),
    "essl320": Route("glsl", ".frag", "#version 320 es\n" + INCLUDES, "void main() {{{}}}\n", GLSLANG),
    "hlsl": Route("hlsl", ".hlsl", "", "[numthreads(1, 1, 1)] void main() {{{}}}\n",
                  GLSLANG + ["-D", "-Od", "-e", "main", "-S", "comp"]),
    "opencl": Route("cl", ".cl", "", C_MAIN,
                    ["clang", "-x", "cl", "-cl-std=CL1.2", "-Xclang", "-finclude-default-header", "-target", "spir64", *LLVM]),
    # Apple's compiler is not to be had here: clang, with the few names of metal_stdlib that the prelude uses.
    "metal": Route("metal", ".metal", "", C_MAIN,
                   ["clang++", "-x", "c++", "-std=c++14", "-D__METAL_VERSION__=300", f"-I{Path(__file__).parent / 'metal'}",
                    *LLVM]),
    "c++": Route("cuh", ".cpp", "", C_MAIN, ["clang++", "-std=c++20", *LLVM]),
}


def main():
    route, include = ROUTES[sys.argv[1]], Path(sys.argv[2])
    headers = sorted(h for h in include.rglob("*.h") if h.parent.name != "portable")
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        for header in headers:
            name = header.relative_to(include).as_posix()
            text = f'{route.begin}#include "{name}"\n{route.main.format("")}'
            run = route.compiled(text, Path(folder) / "unit.out", include)
            if run.returncode:
                failed += 1
                print(f"{name}: {complaints(run)[0]}")
    print(f"{sys.argv[1]}: {len(headers)} headers, {failed} refused")
    sys.exit(failed > 0 or not headers)


if __name__ == "__main__":
    main()
