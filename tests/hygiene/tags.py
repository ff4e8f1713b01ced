#!/usr/bin/env python3
"""ctags, with .ctags.d/gnomon.ctags, finds every kernel, struct and constant of the headers by its name, where it stands.

usage: tags.py ROOT    prints one line for each name that is found elsewhere or not at all; exit code 1 if there is any,
    77 where there is no Universal Ctags
"""
import re
import subprocess
import sys
from pathlib import Path

KINDS = {"KERNEL": "f", "STRUCT": "s", "CONSTANT": "v"}
DEFINED = re.compile(r"^GNOMON_(?:DETAIL_)?(?:LIST_)?(KERNEL|STRUCT|CONSTANT)\b(?:\s+(?:GNOMON_(?:LIST_)?T\(\w+\)|\w+)\s+|\()(\w+)",
                     re.MULTILINE)


def main():
    root = Path(sys.argv[1])
    try:
        version = subprocess.run(["ctags", "--version"], capture_output=True, text=True).stdout
    except FileNotFoundError:
        version = ""
    if not version.startswith("Universal Ctags"):
        print("no Universal Ctags here")
        sys.exit(77)
    run = subprocess.run(["ctags", "-R", "--sort=no", "--fields=+n", "-f", "-", "include"], cwd=root, check=True,
                         capture_output=True, text=True)
    tags = set(re.findall(r'^(\S+)\t(\S+)\t.*;"\t(\w)\tline:(\d+)', run.stdout, re.MULTILINE))
    names = wrong = 0
    for path in sorted(root.glob("include/**/*.h")):
        if path.parent.name == "portable":
            continue
        text = path.read_text()
        for found in DEFINED.finditer(text):
            tag = found[2], path.relative_to(root).as_posix(), KINDS[found[1]], str(text.count("\n", 0, found.start(2)) + 1)
            names += 1
            if tag not in tags:
                wrong += 1
                print(f"{tag[1]}:{tag[3]}: ctags does not find {tag[0]} here")
    for name, path, kind, line in sorted(tags):
        if name.startswith("GNOMON_") and kind != "d":
            wrong += 1
            print(f"{path}:{line}: ctags takes {name} for a name")
    print(f"{names} names, {wrong} not found by ctags")
    sys.exit(wrong > 0 or names == 0)


main()
