"""Runs a lesson in an empty folder; reads what it printed and drew."""

import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import matplotlib.image
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = Path(sys.argv.pop(1)).resolve()
HALF_CODE = 0.5 / 255
SIZE = (540, 960, 3)

# Of the picture of the fence: ground on which no shadow falls, and ground that the sign board shadows.
LIT = (slice(440, 530), slice(640, 940))
SHADOWED = (slice(415, 445), slice(420, 500))


def name_of(number):
    return next((ROOT / "examples" / "lessons").glob(f"{number:02}_*.cpp")).stem


def run(number, folder):
    """The output of a lesson, whose pictures are below the folder."""
    program = PROGRAMS / f"lesson_{name_of(number)}"
    done = subprocess.run([program], cwd=folder, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, ""), (done.returncode, done.stderr)
    return done.stdout


def picture(number, folder):
    return matplotlib.image.imread(Path(folder) / "out" / "lessons" / f"{name_of(number)}.png")[..., :3]


def linear(srgb):
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def rows(text):
    """The numbers of each line that begins with one."""
    found = [re.findall(r"[-+]?\d+(?:\.\d+)?", line) for line in text.splitlines() if re.match(r"\s*[-+]?\d", line)]
    return [[float(word) for word in line] for line in found]


def source(number):
    return (ROOT / "examples" / "lessons" / f"{name_of(number)}.cpp").read_text(encoding="utf-8")


class Lesson(unittest.TestCase):
    """Runs lesson NUMBER once; self.printed is its output."""

    NUMBER = 0

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.printed = run(cls.NUMBER, cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def drawn(self):
        return picture(self.NUMBER, self.folder.name)

    def check_document(self, name):
        shown = matplotlib.image.imread(ROOT / "docs" / "images" / f"{name}.png")[..., :3]
        self.assertLess(np.abs(shown - self.drawn()).mean(), HALF_CODE)

    def check_fence(self, seen):
        """The light of sun and sky on open ground, that of the sky alone (stage.cpp, shading.hpp) below the sign."""
        self.assertEqual(seen.shape, SIZE)
        albedo, sky, sun = np.array([[0.40, 0.43, 0.34], [0.30, 0.35, 0.44], [1.0, 0.94, 0.84]])
        cosine = 0.55 / np.sqrt(0.75**2 + 0.55**2 + 0.25**2)
        self.assertLess(np.abs(linear(seen[LIT]) - albedo * (sky + cosine * sun)).max(), 0.005) # no acne anywhere
        self.assertLess(np.abs(linear(seen[SHADOWED]) - albedo * sky).max(), 0.03) # next to no light leaks
