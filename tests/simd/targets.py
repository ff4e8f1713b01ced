#!/usr/bin/env python3
"""Packs on some target, by some version of xsimd: the bits of scalars.

usage: targets.py words TARGET XSIMD INCLUDE...            packs.cpp, every word of the dialect
       targets.py kernels TARGET XSIMD HOST INCLUDE...     every_kernel.cpp, against what the program HOST writes
       targets.py headers TARGET XSIMD INCLUDE...          every header that needs no other library compiles
       targets.py refuses TARGET XSIMD INCLUDE...          a batch of floats as Real, which is not rounded correctly there

XSIMD is a folder that holds xsimd/, or "none". The folders of INCLUDE hold the headers of the library, of the tests, and
those that the build writes. Exit code 1 if anything differs, 77 where the target or this xsimd is not at hand.
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
# One file: node has a fetch, which finds no second.
EMSCRIPTEN = "em++ -sSINGLE_FILE=1 -sNODERAWFS=1 -sALLOW_MEMORY_GROWTH=1"

# A compiler with its options, and what runs its programs.
TARGETS = {
    "x86-64": ("g++", ""),
    "x86-64-v3": ("g++ -march=x86-64-v3", ""),
    "native": ("g++ -march=native -Wno-uninitialized -Wno-maybe-uninitialized", ""), # GCC bug 105593
    "std_simd": ("g++ -march=x86-64-v3 -DGNOMON_TEST_STD_SIMD -DGNOMON_TEST_FLOAT", ""),
    "aarch64": ("aarch64-linux-gnu-g++", "qemu-aarch64 -L /usr/aarch64-linux-gnu"),
    "sve": ("aarch64-linux-gnu-g++ -march=armv8-a+sve -msve-vector-bits=256",
            "qemu-aarch64 -cpu max,sve256=on -L /usr/aarch64-linux-gnu"),
    "armhf": ("arm-linux-gnueabihf-g++ -mfpu=neon-vfpv4 -Wno-psabi", "qemu-arm -L /usr/arm-linux-gnueabihf"),
    "wasm": (f"{EMSCRIPTEN} -DGNOMON_TEST_FLOAT", "node"),
    "wasm-simd128": (f"{EMSCRIPTEN} -DGNOMON_TEST_FLOAT -msimd128", "node"),
}
WARNINGS = "-Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion -Werror".split()


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(1 if os.environ.get("CI") == "true" else 77)


def run(command):
    result = subprocess.run(command)
    if result.returncode:
        sys.exit(f"exit code {result.returncode}: {' '.join(map(str, command))}")


def main():
    if len(sys.argv) < 5 or sys.argv[1] not in ("words", "kernels", "headers", "refuses") or sys.argv[2] not in TARGETS:
        sys.exit(__doc__)
    what, target, xsimd, *include = sys.argv[1:]
    compiler, runner = (words.split() for words in TARGETS[target])
    for program in compiler[0], *runner[:1]:
        if not shutil.which(program):
            skip(f"no {program} here")
    if xsimd != "none" and not Path(xsimd, "xsimd").exists():
        skip(f"no xsimd in {xsimd}: tests/simd/newer_xsimd.sh fetches it from Debian")
    host = include.pop(0) if what == "kernels" else None
    compile = [*compiler, *WARNINGS, "-std=c++20", "-O1", "-ffp-contract=off", *(f"-I{folder}" for folder in include)]
    if xsimd != "none":
        compile += ["-isystem", xsimd]
    if what == "headers":
        compile = [word for word in compile if word[:2] != "-s" or word[:4] == "-std"] # Emscripten's options for linking
        run([*compile, "-fsyntax-only", "-include", "own_headers.hpp", "-x", "c++", os.devnull])
        return
    if what == "refuses":
        compile += ["-fsyntax-only", "-include", "gnomon/simd/xsimd.hpp", HERE.parent / "hygiene" / "must_not_compile.cpp"]
        run([*compile, "-DREAL=gnomon::pack<xsimd::batch<float>>"])
        refused = subprocess.run([*compile, "-DREAL=xsimd::batch<float>"], capture_output=True, text=True)
        if not refused.returncode or "gnomon: Real must be" not in refused.stderr:
            sys.exit(f"xsimd's own batch is not refused in the library's words:\n{refused.stderr}")
        return
    with tempfile.TemporaryDirectory() as folder:
        program, rows = Path(folder, "program.js"), Path(folder, "rows")
        run([*compile, HERE / ("packs.cpp" if what == "words" else "every_kernel.cpp"), "-o", program])
        if host:
            run([host, "write", rows])
        run([*runner, program, *(["read", rows] if host else [])])


if __name__ == "__main__":
    main()
