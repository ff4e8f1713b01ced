#!/usr/bin/env python3
"""Decorates every float operation of a SPIR-V module NoContraction: drivers fuse a b + c wherever they are not told.

usage: no_contraction.py MODULE...    rewrites the modules in place, with spirv-dis and spirv-as of SPIRV-Tools

GLSL's precise would do the same, but would have to stand in the kernels' text, and does not reach through functions on
every driver.
"""
import re
import subprocess
import sys
from pathlib import Path


def decorated(text):
    results = re.findall(r"^ *(%\w+) = OpF(?:Add|Sub|Mul|Div|Negate)\b", text, re.MULTILINE)
    already = set(re.findall(r"OpDecorate (%\w+) NoContraction", text))
    lines = "".join(f"OpDecorate {result} NoContraction\n" for result in results if result not in already)
    # Decorations come before the first type.
    head = re.search(r"^ *%\w+ = OpType", text, re.MULTILINE).start()
    return text[:head] + lines + text[head:]


def rewrite(module):
    dis = subprocess.run(["spirv-dis", "--raw-id", module], capture_output=True, text=True, check=True)
    aside = Path(f"{module}.part")
    # Ids keep their numbers, or a debugger's view of the module would change.
    subprocess.run(["spirv-as", "--preserve-numeric-ids", "--target-env", "spv1.3", "-o", aside, "-"],
                   input=decorated(dis.stdout), text=True, check=True)
    aside.replace(module)


if __name__ == "__main__":
    for name in sys.argv[1:]:
        rewrite(Path(name))
