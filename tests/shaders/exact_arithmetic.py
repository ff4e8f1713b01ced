#!/usr/bin/env python3
"""Binds a SPIR-V module's float arithmetic to what its text says.

usage: exact_arithmetic.py MODULE TARGET    with spirv-dis and spirv-as of SPIRV-Tools

Every operation is decorated NoContraction: drivers fuse a b + c wherever they are not told. GLSL's precise would do the
same, but would have to stand in the kernels' text. The entry point gets SignedZeroInfNanPreserve (SPV_KHR_float_controls):
else drivers may take x < x for false, or x + 0 for x, whatever x is.
"""
import re
import subprocess
import sys
from pathlib import Path


def exact(text):
    operations = re.findall(r"^ *(%\w+) = OpF(?:Add|Sub|Mul|Div|Negate)\b", text, re.MULTILINE)
    already = set(re.findall(r"OpDecorate (%\w+) NoContraction", text))
    decorations = "".join(f"OpDecorate {result} NoContraction\n" for result in operations if result not in already)
    entry = re.search(r"OpEntryPoint \w+ (%\w+)", text)[1]
    for before, line in [
        (r"^ *%\w+ = OpExtInstImport", 'OpCapability SignedZeroInfNanPreserve\nOpExtension "SPV_KHR_float_controls"\n'),
        (r"^ *OpExecutionMode ", f"OpExecutionMode {entry} SignedZeroInfNanPreserve 32\n"),
        (r"^ *%\w+ = OpType", decorations),
    ]:
        at = re.search(before, text, re.MULTILINE).start()
        text = text[:at] + line + text[at:]
    return text


def rewrite(module, target):
    dis = subprocess.run(["spirv-dis", "--raw-id", module], capture_output=True, text=True, check=True)
    aside = Path(f"{target}.part")
    subprocess.run(["spirv-as", "--preserve-numeric-ids", "--target-env", "spv1.3", "-o", aside, "-"], input=exact(dis.stdout),
                   text=True, check=True)
    aside.replace(target)


if __name__ == "__main__":
    rewrite(*map(Path, sys.argv[1:]))
