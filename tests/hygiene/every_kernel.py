#!/usr/bin/env python3
"""usage: every_kernel.py OUTPUT HEADER...    writes KERNEL(name) for every kernel that the headers define"""
import re
import sys
from pathlib import Path

RESULT = r"(?:GNOMON_T\(\w+\)|\w+)"


def kernels(headers):
    return [name for header in headers
            for name in re.findall(rf"^GNOMON_KERNEL\s+{RESULT}\s+(\w+)\(", Path(header).read_text(), re.MULTILINE)]


def main():
    output, *headers = sys.argv[1:]
    names = kernels(headers)
    heads = sum(len(re.findall(r"^GNOMON_KERNEL\b", Path(header).read_text(), re.MULTILINE)) for header in headers)
    if len(names) != heads or len(set(names)) != heads:
        print(f"every_kernel.py: {heads} kernels, {len(set(names))} names understood", file=sys.stderr)
        sys.exit(2)
    Path(output).write_text("".join(f"KERNEL({name})\n" for name in names))


if __name__ == "__main__":
    main()
