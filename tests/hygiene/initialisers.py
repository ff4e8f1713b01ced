#!/usr/bin/env python3
"""A unit that includes headers has nothing to run before main and nothing that can be written to.

usage: initialisers.py COMPILER [OPTION...]    compiles an empty unit with these options at -O0; exit code 1 if it has either
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

WRITABLE = re.compile(r"^[0-9a-f]+ (?!.{5}d).*\s(\.(?:init_array|ctors|data|bss|tdata|tbss)(?!\.rel\.ro|\S*\.DW\.ref)\S*|\*COM\*)\s.*$"
                      r"|^.*_GLOBAL__sub_I.*$", re.MULTILINE)


def found(command):
    """Symbols of an empty unit that are initialised at run time, or writable."""
    with tempfile.TemporaryDirectory() as folder:
        unit = Path(folder) / "unit.o"
        subprocess.run([*command, "-O0", "-c", "-x", "c++", "/dev/null", "-o", unit], check=True)
        table = subprocess.run(["objdump", "-t", "-C", unit], check=True, capture_output=True, text=True).stdout
    return [match[0] for match in WRITABLE.finditer(table)]


def main():
    compiler, *options = sys.argv[1:]
    if not found([compiler, "-std=c++20", "-include", "iostream"]):
        print("iostream has an initialiser that was not found")
        sys.exit(1)
    symbols = found([compiler, *options])
    print("\n".join(symbols) or "none")
    sys.exit(bool(symbols))


if __name__ == "__main__":
    main()
