#!/usr/bin/env python3
"""Runs every bench and writes their rows.

usage: run.py FOLDER OUTPUT    runs FOLDER/bench_*, writes their rows as one Google Benchmark JSON to OUTPUT, prints a table

The columns of the table are the time per iteration and the counters, among them ratios to a baseline of the same run.
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

# The fields that Google Benchmark writes into every row. All others are counters.
STANDARD = {"name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions", "repetition_index",
            "threads", "iterations", "real_time", "cpu_time", "time_unit", "label", "aggregate_name", "aggregate_unit",
            "error_occurred", "error_message"}


def rows_of(program):
    with tempfile.NamedTemporaryFile(suffix=".json") as target:
        subprocess.run([program, f"--benchmark_out={target.name}", "--benchmark_out_format=json"],
                       check=True, stdin=subprocess.DEVNULL, stdout=sys.stderr)
        return json.loads(target.read())


def merged(programs):
    result = {"context": None, "benchmarks": []}
    for number, program in enumerate(programs, 1):
        print(f"{program.name} ({number} of {len(programs)})", file=sys.stderr)
        one = rows_of(program)
        result["context"] = result["context"] or one["context"]
        result["benchmarks"] += one["benchmarks"]
    return result


def table(rows):
    counters = list(dict.fromkeys(key for row in rows for key in row if key not in STANDARD))
    cells = [["", "time", *counters]]
    for row in rows:
        name, manual, _ = row["name"].partition("/iterations:1/manual_time")
        kind = "real_time" if manual else "cpu_time"
        time = f"{row[kind]:.4g} {row['time_unit']}" if kind in row else row.get("error_message", "")
        cells.append([name, time, *(f"{row[counter]:.3g}" if counter in row else "" for counter in counters)])
    widths = [max(map(len, column)) for column in zip(*cells)]
    return "\n".join("  ".join([line[0].ljust(widths[0])] + [cell.rjust(width) for cell, width in zip(line[1:], widths[1:])])
                     .rstrip() for line in cells)


def main():
    if len(sys.argv) != 3:
        print("run.py: two arguments expected, the folder of the benches and the file to write", file=sys.stderr)
        sys.exit(2)
    folder, output = map(Path, sys.argv[1:])
    programs = sorted(path for path in folder.glob("bench_*") if os.access(path, os.X_OK) and path.is_file())
    if not programs:
        print(f"run.py: no bench in {folder}", file=sys.stderr)
        sys.exit(2)
    try:
        result = merged(programs)
    except subprocess.CalledProcessError as error:
        print(f"run.py: {error.cmd[0]} ended with {error.returncode}; {output} is unchanged", file=sys.stderr)
        sys.exit(2)
    output.parent.mkdir(parents=True, exist_ok=True)
    aside = output.with_suffix(".part")
    aside.write_text(json.dumps(result, indent=1) + "\n")
    aside.replace(output)
    print(table(result["benchmarks"]))
    print(f"rows: {output}")


if __name__ == "__main__":
    main()
