#!/usr/bin/env python3
"""Compiles the C++ and the GLSL example of README.md, so that what a newcomer copies works.

usage: readme.py ROOT
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

root = Path(sys.argv[1])
text = (root / "README.md").read_text()
commands = {
    "C++": (".cpp", ["g++", "-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only"]),
    "GLSL": (".frag", ["glslangValidator", "-V", "--target-env", "vulkan1.1", "-o", "/dev/null"]),
}
for language, (ending, command) in commands.items():
    section = text.split(f"## Use it in {language}\n")[1].split("\n## ")[0]
    example = "\n".join(re.findall(r"^    (.*)$|^$", section, re.MULTILINE))
    with tempfile.TemporaryDirectory() as folder:
        unit = Path(folder) / ("example" + ending)
        unit.write_text(example)
        subprocess.run(command + [f"-I{root / 'include'}", str(unit)], check=True)
