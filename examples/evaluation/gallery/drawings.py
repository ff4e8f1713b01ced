"""Writes the figures of charts and maps: vectors for each scheme, and pixels."""

import io
import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

import matplotlib

import charts
import colours

PIXELS_PER_INCH, OF_SHEETS = 144, 96


@dataclass
class Drawing:
    stem: Path  # of its files
    make: tuple  # the function that makes the figure, and its arguments
    used: tuple = ()  # colours that differ in the dark scheme, apart from the page's own
    sheet: bool = False  # large: in pixels alone, and in fewer


def files_of(drawing):
    """The files of a drawing, as [(file, content)]."""
    make, *arguments = drawing.make
    figure, stem = make(*arguments), drawing.stem
    vectors, pixels = io.StringIO(), io.BytesIO()
    with matplotlib.rc_context(charts.STYLE):
        density = OF_SHEETS if drawing.sheet else PIXELS_PER_INCH
        figure.savefig(pixels, format="png", dpi=density, metadata={"Software": None})
        files = [(stem.with_name(f"{stem.name}.png"), pixels.getvalue())]
        if not drawing.sheet:
            figure.savefig(vectors, format="svg", dpi=density, metadata={"Date": None})
            light = vectors.getvalue()
            night = colours.darkened(light, {*colours.SCHEME, *drawing.used})
            files += [(stem.with_name(f"{stem.name}.svg"), light.encode()),
                      (stem.with_name(f"{stem.name}-dark.svg"), night.encode())]
    return files


def all_files(drawings):
    """The files of all drawings, on all cores."""
    workers = min(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count(), len(drawings))
    if workers < 2:
        return [file for drawing in drawings for file in files_of(drawing)]
    with ProcessPoolExecutor(workers, get_context("fork")) as pool:
        return [file for files in pool.map(files_of, drawings) for file in files]
