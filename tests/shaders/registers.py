#!/usr/bin/env python3
"""Registers and spills of every CUDA kernel, from what nvcc -Xptxas -v had to say.

usage: registers.py LOG TABLE OUTPUT    prints the most, writes a row per kernel as JSON; exit code 1 if any kernel is missing
    or spills
"""
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "support"))
import kernels

FUNCTION = re.compile(r"entry function 'parity_(\w+)' for '(\w+)'.*?(\d+) bytes spill stores, (\d+) bytes spill loads"
                      r".*?Used (\d+) registers", re.DOTALL)


def main():
    log, table, output = map(Path, sys.argv[1:])
    if not log.exists():
        print("no nvcc here: nothing was compiled for CUDA")
        sys.exit(77)
    rows = [{"kernel": name, "target": target, "registers": int(registers), "spilled_bytes": int(stores) + int(loads)}
            for name, target, stores, loads, registers in FUNCTION.findall(log.read_text())]
    aside = output.with_suffix(".part")
    aside.write_text(json.dumps(rows, indent=1) + "\n")
    aside.replace(output)
    missing = kernels.table(table).keys() - {row["kernel"] for row in rows}
    complaints = [f"{kernel}: not compiled" for kernel in sorted(missing)]
    complaints += [f"{row['kernel']}: spills {row['spilled_bytes']} bytes" for row in rows if row["spilled_bytes"]]
    most = max(rows, key=lambda row: row["registers"], default={"kernel": "none", "registers": 0})
    print("\n".join(complaints + [f"{len(rows)} kernels, at most {most['registers']} registers ({most['kernel']})"]))
    sys.exit(bool(complaints))


if __name__ == "__main__":
    main()
