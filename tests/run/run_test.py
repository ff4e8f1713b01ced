#!/usr/bin/env python3
"""Gives ./run right and wrong words on a machine whose cmake and dpkg-query only take notes: run_test.py"""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NOTING = '#!/bin/sh\necho "$0 $*" >> "$NOTES"\nexit 1\n'


class Run(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        for name in ("run", "examples/evaluation/help.txt", *(path.relative_to(ROOT) for path in ROOT.glob("examples/lessons/*.cpp"))):
            copy = self.folder / "clone" / name
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, copy)
        for tool in ("cmake", "ctest", "ninja", "apt-get", "dpkg-query", "sudo"):
            noting = self.folder / "bin" / tool
            noting.parent.mkdir(exist_ok=True)
            noting.write_text(NOTING)
            noting.chmod(0o755)

    def answer(self, words):
        """The answer to ./run WORDS, and what was to be built or installed for it."""
        notes = self.folder / "notes"
        notes.write_text("")
        environment = os.environ | {"PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}", "NOTES": str(notes)}
        environment.pop("GNOMON_HAVE_PACKAGES", None)
        done = subprocess.run([self.folder / "clone" / "run", *words], env=environment, cwd=self.folder, capture_output=True,
                              text=True, check=False)
        return done, notes.read_text()

    def test_help_builds_nothing(self):
        help_text = (ROOT / "examples/evaluation/help.txt").read_text()
        for words in (["demo", "--help"], ["demo", "-h"], ["demo", "bounds", "--help"]):
            done, notes = self.answer(words)
            self.assertEqual((done.returncode, done.stdout, done.stderr, notes), (0, help_text, "", ""), words)
        for words in (["--help"], ["-h"], ["test", "--help"], ["lesson", "--help"], ["bench", "--help"], ["check", "--help"]):
            done, notes = self.answer(words)
            self.assertTrue(done.stdout.startswith("usage: ./run demo"), words)
            self.assertEqual((done.returncode, notes), (0, ""), words)

    def test_wrong_words_build_nothing(self):
        for words, answer in {
                "demo --hlep": "demo: unknown '--hlep'; did you mean '--help'? known: --help --full",
                "demo --ful": "did you mean '--full'?",
                "demo --modle=x": "unknown '--modle'; did you mean '--model'?",
                "demo -x": "demo: unknown '-x'",
                "demo hard_shadow": "unknown 'hard_shadow'; did you mean 'hard_shadows'? known: hard_shadows contact",
                "demo bounds xyzzy": "demo: unknown 'xyzzy'; known: hard_shadows",
                "demo --model": "demo: --model needs a value",
                "demo --model --full": "demo: --model needs a value",
                "demo --model absent.obj": "demo: no file 'absent.obj'",
                "demo --model=absent.obj": "demo: no file 'absent.obj'",
                "lesson nope": "lesson: unknown 'nope'; known: one_texel",
                "lesson on_vulkn": "did you mean 'on_vulkan'?",
                "lesson 1 2": "lesson: one name expected, not '1 2'",
                "test --al": "test: unknown '--al'; did you mean '--all'? known: --all --long",
                "test --all --long": "test: --all, --long or nothing expected, not '--all --long'",
                "bench x": "bench: takes no 'x'",
                "check x": "check: takes no 'x'",
                "tset": "unknown 'tset'; did you mean 'test'? known: demo lesson test bench check --help",
                "xyzzy": "unknown 'xyzzy'; known: demo"}.items():
            done, notes = self.answer(words.split())
            self.assertIn(answer, done.stderr, words)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n"), notes), (2, "", 1, ""), words)

    def test_right_words_build(self):
        (self.folder / "clone" / "cube.obj").write_text("v 0 0 0\n")
        for words in ("demo", "demo bounds contact --full", "demo --model cube.obj --animation slide --shutter 0,1",
                      "demo --model=cube.obj --animation= --out x", "demo --registry", "demo --hlsl",
                      "lesson 1", "lesson 02_hard_shadow_map", "lesson one_texel", "test", "test --all", "test --long", "bench", "check"):
            _, notes = self.answer(words.split())
            self.assertNotEqual(notes, "", words)

    def test_lessons_are_listed(self):
        done, notes = self.answer(["lesson"])
        lessons = sorted(path.stem for path in ROOT.glob("examples/lessons/*.cpp"))
        self.assertEqual([line.split()[0] for line in done.stdout.splitlines()], lessons)
        self.assertEqual(notes, "")


if __name__ == "__main__":
    unittest.main()
