#!/usr/bin/env python3
"""Exact products and differences, rounding and NaN under the flags that projects compile with.

usage: flags.py COMPILER INCLUDE    prints one line for each fault; exit code 1 if there is any, 77 without the compiler

COMPILER is g++ or clang++. INCLUDE is the folder that holds gnomon/. Under each set of flags exact.cpp either does not
compile, with one error that has the library's words, or prints the bits of a build without liberties.
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from builds import Build

# Sets of flags under which the library compiles.
HELD = """
-O0
-Og
-O3 -ffp-contract=fast
-O2 -fno-math-errno -fno-trapping-math
-O2 -frounding-math -ftrapping-math
-O2 -mfma
-O3 -mavx2 -mfma
-O3 -mavx2 -mfma -ffp-contract=off
-O3 -mavx2 -mfma -ffp-contract=fast
-O2 -mavx2 -mfma -mrecip
-O2 -mfma -ffp-contract=fast -DGNOMON_TEST_REAL=test::plain
-O2 -mavx2 -mfma -ffp-contract=fast -DGNOMON_TEST_REAL=xsimd::batch
""", {"g++": """
-O2 -fno-signed-zeros
-O2 -fsignaling-nans
-O2 -fexcess-precision=fast
-O2 -mlong-double-64
""", "clang++": """
-O2 -ffp-model=precise -mfma
-O2 -ffp-model=strict
-O2 -fdenormal-fp-math=positive-zero
"""}

# Those that some version must refuse and another may hold.
EITHER = "", {"g++": "", "clang++": """
-O2 -fno-signed-zeros
-O2 -fapprox-func
-O2 -fno-honor-infinities
-O2 -fno-honor-nans
-O3 -mavx2 -mfma -fno-honor-nans -ffp-contract=fast
"""}

# Those that it refuses. The last are what MSVC and NVRTC define.
REFUSED = """
-O2 -ffast-math
-Ofast
-O2 -ffinite-math-only
-O2 -funsafe-math-optimizations
-O2 -fassociative-math -fno-signed-zeros -fno-trapping-math
-O2 -ffast-math -fno-finite-math-only
-O2 -freciprocal-math
-D_M_FP_FAST=1
-D_M_IX86_FP=1
-D__CUDA_PREC_DIV=0
-D__CUDA_PREC_SQRT=0
""", {"g++": """
-O2 -fsingle-precision-constant
-O2 -mfpmath=387
-O2 -mfpmath=sse,387
-include fast_math_pragma.hpp
""", "clang++": """
-O2 -ffp-model=fast
-O2 -funsafe-math-optimizations -DGNOMON_TEST_REAL=xsimd::batch
"""}


def families(table, compiler):
    return [line.split() for line in (table[0] + table[1][compiler]).splitlines() if line]


def flush_at_start(compiler):
    """The flags for a program that starts as one that GCC links with -ffast-math: denormal numbers are zero."""
    run = subprocess.run([compiler, "-print-file-name=crtfastmath.o"], capture_output=True, text=True)
    return [["-O2", run.stdout.strip()]] if run.stdout.startswith("/") else []


def main():
    compiler, include = sys.argv[1], Path(sys.argv[2])
    if not shutil.which(compiler):
        print(f"{compiler} is not there")
        sys.exit(1 if os.environ.get("CI") == "true" else 77)
    has_fma = " fma " in Path("/proc/cpuinfo").read_text()
    faults, count = [], 0
    with tempfile.TemporaryDirectory() as folder:
        right = Build.by([compiler, "-O1", "-ffp-contract=off"], [include], folder)
        faults += right.errors
        for table in (HELD, EITHER, REFUSED):
            for flags in families(table, compiler) + (flush_at_start(compiler) if table is HELD else []):
                if "-mfma" in flags and not has_fma:
                    continue
                count += 1
                build = Build.by([compiler, *flags], [include], folder)
                if build.refusal() and table is not HELD:
                    continue
                wrong = build.errors if build.errors else ["compiles"] if table is REFUSED else build.differences(right)
                faults += [f"{' '.join(flags)}: {sentence}" for sentence in wrong]
    print("\n".join(faults + [f"{compiler}: {count} sets of flags, {len(faults)} faults"]))
    sys.exit(bool(faults))


main()
