#!/usr/bin/env python3
"""lint.py on lint_cases: each file there must be reported once, for the rule that its first line names, or not at all."""
import shutil
import tempfile
from collections import defaultdict
from pathlib import Path

import lint

CASES = Path(__file__).parent / "lint_cases"


def expectation(path):
    rule = path.read_text(encoding="utf-8").partition("\n")[0].removeprefix("// expect: ")
    return [] if rule == "nothing" else [rule]


def with_long_file(folder):
    """The cases and one file that is written here, since a file of that length is no pleasure to keep."""
    shutil.copytree(CASES, folder)
    for lines, name in ((lint.MAX_LINES, "longest.cpp"), (lint.MAX_LINES + 1, "too_long.cpp")):
        expected = "nothing" if lines <= lint.MAX_LINES else "too long"
        path = folder / "tests" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"// expect: {expected}\n" + "\n" * (lines - 1))
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
