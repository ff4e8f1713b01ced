#!/usr/bin/env python3
"""lint.py on lint_cases: each file there must be reported once, for the rule that its first line names, or not at all."""
import shutil
import tempfile
from collections import defaultdict
from pathlib import Path

import lint

CASES = Path(__file__).parent / "lint_cases"


def expectation(path):
    rule = path.read_text(encoding="utf-8").partition("\n")[0].lstrip("/#").removeprefix(" expect: ")
    return [] if rule == "nothing" else [rule]


def with_long_file(folder):
    """The cases and files that are written here, since files of that length are no pleasure to keep."""
    shutil.copytree(CASES, folder)
    for room, rule in (("tests", "test too long"), ("bench", "too long")):
        most = lint.MAX_LINES[room]
        (folder / room).mkdir(exist_ok=True)
        for lines, name, expected in ((most, "longest.cpp", "nothing"), (most + 1, "too_long.cpp", rule)):
            (folder / room / name).write_text(f"// expect: {expected}\n" + "\n" * (lines - 1))
    return folder


with tempfile.TemporaryDirectory() as scratch:
    root = with_long_file(Path(scratch) / "cases")
    reported = defaultdict(list)
    for path, _, rule, _ in lint.lint(root):
        reported[path].append(rule)
    files = sorted(path.relative_to(root) for path in root.rglob("*") if path.is_file())
    expected = {path: expectation(root / path) for path in files}

wrong = [f"{path}: expected {expected[path]}, reported {reported[path]}" for path in files if reported[path] != expected[path]]
untried = set(lint.RULES) - {rule for rules in expected.values() for rule in rules}
wrong += [f"no case for the rule '{rule}'" for rule in sorted(untried)]
print("\n".join(wrong) or f"{len(files)} cases, {len(lint.RULES)} rules")
raise SystemExit(bool(wrong))
