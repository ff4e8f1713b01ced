#!/usr/bin/env python3
"""Kernels compiled for another processor, run by qemu, against this machine's.

usage: targets.py TARGET INCLUDE TABLE REFERENCES    prints one line for each fault; exit code 1 if there is any, 77 without the
    cross compiler or qemu

TARGET is a key of TARGETS, INCLUDE the folder that holds gnomon/, TABLE the one that holds kernels.hpp, REFERENCES the one
with this machine's builds of every_kernel.cpp. Without contraction every kernel has this machine's bits; with whatever
contraction the compiler likes exact.cpp has, by clang as well, and intensities are in [0, 1].
"""
import os
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from builds import Build


@dataclass
class Target:
    triple: str
    qemu: str
    flags: list[str] = field(default_factory=list) # that the library needs there
    fused: bool = True
    held: list[list[str]] = field(default_factory=list) # further flags under which exact products hold
    refused: list[list[str]] = field(default_factory=list) # those without which, or with which, the library is refused
    thorough: bool = False # all kernels by clang too, and contracted, for [0, 1]


TARGETS = {
    "aarch64": Target("aarch64-linux-gnu", "qemu-aarch64", thorough=True),
    "riscv64": Target("riscv64-linux-gnu", "qemu-riscv64"),
    "ppc64le": Target("powerpc64le-linux-gnu", "qemu-ppc64le"),
    "i386": Target("i686-linux-gnu", "qemu-i386", ["-msse2", "-mfpmath=sse"], fused=False,
                   refused=[[], ["-mno-sse", "-mfpmath=387"]]),
    "armhf": Target("arm-linux-gnueabihf", "qemu-arm", ["-mfpu=neon-vfpv4"], held=[["-mfpu=vfpv3-d16"]]),
}


def faults_of_all_kernels(target, includes, references, folder):
    """Faults of every kernel, which takes half a minute to compile."""
    flags = [*target.flags, "-static", "-O1"]
    gcc, clang = [f"{target.triple}-g++"], ["clang++", f"--target={target.triple}"]
    reference = references / ("target_fused" if target.fused else "target_split")
    expected = subprocess.run([str(reference)], capture_output=True, text=True, check=True).stdout.splitlines()
    for compiler in [gcc, clang] if target.thorough and shutil.which("clang++") else [gcc]:
        build = Build.by([*compiler, *flags, "-ffp-contract=off"], includes, folder, [target.qemu], "every_kernel")
        yield from build.errors
        if build.lines and len(build.lines) != len(expected):
            yield f"{compiler[0]}: {len(build.lines)} kernels instead of {len(expected)}"
        for line, right in zip(build.lines, expected):
            if line != right:
                yield f"{compiler[0]}, {line.split()[0]}: not the bits of this machine"
    if target.thorough:
        build = Build.by([*gcc, *flags], includes, folder, [target.qemu], "every_kernel")
        yield from build.errors
        for line in build.lines:
            if not line.endswith(" 0"):
                yield f"{line.split()[0]}, contracted: {line.split()[2]} results are not in [0, 1]"


def faults_of_exact_products(target, includes, right, folder):
    compilers = [[f"{target.triple}-g++"]]
    if shutil.which("clang++"):
        compilers.append(["clang++", f"--target={target.triple}"])
    for compiler in compilers:
        for flags in [target.flags, *target.held]:
            for liberty in ["-O2", "-O3 -ffp-contract=fast", "-O2 -fno-signed-zeros", "-O2 -funsafe-math-optimizations"]:
                command = [*compiler, "-static", *flags, *liberty.split()]
                build = Build.by(command, includes, folder, [target.qemu])
                refusable = "-fno-signed-zeros" in command or "-funsafe-math-optimizations" in command
                if not (refusable and build.refusal()):
                    yield from (f"{' '.join(command)}: {fault}" for fault in build.errors or build.differences(right, signed_zeros=not refusable))
        for flags in target.refused:
            command = [*compiler, "-static", *flags]
            if not Build.by(command, includes, folder, [target.qemu]).refusal():
                yield f"{' '.join(command)}: not refused, or not in one line of the library"


def main():
    name, *paths = sys.argv[1:]
    target, (include, table, references) = TARGETS[name], map(Path, paths)
    missing = [tool for tool in (f"{target.triple}-g++", target.qemu, references / "target_split") if not shutil.which(tool)]
    if missing:
        print(f"{name}: {missing[0]} is not there")
        sys.exit(1 if os.environ.get("CI") == "true" else 77)
    with tempfile.TemporaryDirectory() as folder:
        right = Build.by(["g++", "-O1", "-ffp-contract=off"], [include], folder)
        faults = [*right.errors, *faults_of_exact_products(target, [include], right, folder),
                  *faults_of_all_kernels(target, [include, table], references, folder)]
    print("\n".join(faults[:20] + [f"{name}: {len(faults)} faults"]))
    sys.exit(bool(faults))


main()
