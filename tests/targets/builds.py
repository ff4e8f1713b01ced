"""Builds of exact.cpp or every_kernel.cpp by some compiler, and how their lines differ from those of another build."""
import re
import struct
import subprocess
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).parent
NEAR = 2**-20, 2**-49 # relative to the larger of the value and 1


@dataclass
class Build:
    """What a command made of a program: the lines that it prints, or the errors of the compiler, with their source lines."""
    lines: list[str]
    errors: list[str]

    @staticmethod
    def by(command, includes, folder, runner=(), program="exact"):
        source, program = HERE / f"{program}.cpp", Path(folder) / program
        compile = [*command, "-std=c++20", *[f"-I{path}" for path in (*includes, HERE.parent)], str(source), "-o", str(program)]
        run = subprocess.run(compile, capture_output=True, text=True)
        if run.returncode:
            return Build([], re.findall(r"error: .*\n.*", run.stderr) or [f"error: without a word: {run.stderr[:200]}"])
        run = subprocess.run([*runner, str(program)], capture_output=True, text=True)
        if run.returncode:
            return Build([], [f"error: the program ended with {run.returncode}: {run.stderr[:200]}"])
        return Build(run.stdout.splitlines(), [])

    def refusal(self):
        """True if the one error is in the library's words."""
        return len(self.errors) == 1 and "gnomon: " in self.errors[0]

    def differences(self, right, signed_zeros=True):
        """A sentence for each line that differs from that of another build, in more than the sign of a zero if that may be."""
        if len(self.lines) != len(right.lines):
            return [f"{len(self.lines)} lines instead of {len(right.lines)}"]
        sentences = []
        for line, other in zip(self.lines, right.lines):
            kind, name, *results = line.split()
            expected = other.split()[2:]
            same = (lambda x, y: x == y) if kind == "exact" else (lambda x, y: near(x, y, "<64>" in name))
            wrong = [(x, y) for x, y in zip(results, expected, strict=True)
                     if not same(x, y) and (signed_zeros or {x.strip("0"), y.strip("0")} - {"", "8"})]
            if wrong:
                sentences.append(f"{name}: {len(wrong)} of {len(results)} differ, first {wrong[0][0]}, not {wrong[0][1]}")
        return sentences


def near(x, y, double):
    """True if two numbers differ by a few roundings; the numbers are given by their bits in hexadecimal."""
    x, y = (struct.unpack(*(("d", struct.pack("Q", int(b, 16))) if double else ("f", struct.pack("I", int(b, 16)))))[0]
            for b in (x, y))
    return abs(x - y) <= NEAR[double] * max(1, abs(y))
