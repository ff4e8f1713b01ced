#!/usr/bin/env python3
"""The command line of shaders/package.py: what it writes, and that every mistake gets one line and exit code 2.

usage: package_command.py SHADERS    SHADERS is the folder that holds package.py
"""
import contextlib
import io
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, sys.argv[1])
import package

COMMAND = [sys.executable, "-B", str(Path(sys.argv[1]).resolve() / "package.py")]

# Words, and part of what is said.
MISTAKES = [
    (["moment4"], "no technique 'moment4'; 'moments4' is near"),
    (["moments4", "Variance"], "no technique 'Variance'; 'variance' is near"),
    (["qqq"], "no technique 'qqq'; there are moments4, moments6, "),
    (["--language", "wgl"], "no language 'wgl'; 'wgsl' is near"),
    (["--langage", "wgsl"], "no option '--langage'; '--language' is near"),
    (["--language"], "argument --language: expected one argument"),
    *[(["--prefix", prefix], f"'{prefix}' begins no name") for prefix in ("", "1x", "my-", "my__", "_my", "gl_", "a" * 80 + "!")],
    (["--bevy", "--language", "glsl"], "--bevy is WGSL, not glsl"),
    (["variance", "--check"], "--check goes alone"),
    (["variance", "--output", __file__], f"{__file__}: File exists"),
]

# Words, files that they write, and how each begins.
WRITES = [
    (["variance", "moments4", "variance"], [f"variance_moments4.{ending}" for ending in package.ENDINGS], "// Gnomon "),
    (["variance", "--language", "wgsl", "depth", "--language", "cl"], ["variance_depth.cl", "variance_depth.wgsl"], "// Gnomon "),
    (["variance", "--bevy"], ["variance.wgsl"], "#define_import_path gnomon::variance\n\n// Gnomon "),
    (["moments4", "variance", "--bevy"], ["moments4_variance.wgsl"], "#define_import_path gnomon::moments4_variance\n\n"),
    (["--language", "glsl"], [f"{technique}.glsl" for technique in package.Packager().techniques], "// Gnomon "),
]


def faults():
    for words, answer in MISTAKES:
        run = subprocess.run([*COMMAND, *words], capture_output=True, text=True)
        if run.returncode != 2 or run.stdout or run.stderr.count("\n") != 1 or not run.stderr.startswith(f"package.py: {answer}"):
            yield f"{words}: '{answer}' and 2 expected, not '{run.stdout}{run.stderr}' and {run.returncode}"
    for words, names, beginning in WRITES:
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run([*COMMAND, *words], capture_output=True, text=True, cwd=folder)
            written = {path.name: path.read_text() for path in Path(folder).iterdir()}
        if run.returncode or sorted(written) != sorted(names):
            yield f"{words}: {names} expected, not {sorted(written)}{run.stderr}"
        yield from (f"{words}: {name} does not begin so" for name, text in written.items() if not text.startswith(beginning))
    with tempfile.TemporaryDirectory() as folder:
        yield from faults_of_check(Path(folder))


def faults_of_check(folder):
    """A missing file, a changed one and one that is left over are told, a user's own is not, and writing mends all."""
    files = {"kept.glsl": "// Gnomon 1", "missing.glsl": "// Gnomon 2", "changed.wgsl": "// Gnomon 3"}
    package.PACKAGES = folder
    (folder / "kept.glsl").write_text(files["kept.glsl"])
    (folder / "changed.wgsl").write_text("// Gnomon 4")
    (folder / "left.cl").write_text("// Gnomon 5")
    (folder / "mine.cl").write_text("// mine")
    with contextlib.redirect_stdout(io.StringIO()) as said:
        differing = package.check(files)
    if differing != 3 or any(f"/{name}: not what" not in said.getvalue() for name in ("missing.glsl", "changed.wgsl", "left.cl")):
        yield f"check: 3 files expected, not {differing}: {said.getvalue()}"
    package.replace(folder, files, package.ENDINGS)
    if sorted(path.name for path in folder.iterdir()) != ["changed.wgsl", "kept.glsl", "mine.cl", "missing.glsl"]:
        yield f"replace: left {sorted(folder.iterdir())}"


def main():
    found = list(faults())
    print("\n".join(found), end="\n" * bool(found))
    print(f"{len(MISTAKES) + len(WRITES) + 2} cases, {len(found)} wrong")
    sys.exit(bool(found))


main()
