#!/usr/bin/env python3
"""Makes the gallery, a front page and a page per driver, from what the demo's drivers left in a folder."""

import argparse
import os
import sys
from html import escape
from pathlib import Path
from string import Template
from urllib.parse import quote

from blocks import Page, chart, render
from drawings import all_files
from facts import Damaged, read, size_of_png
from markup import figure, grid, inline, paragraphs, picture

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]

# Where to go from the front page: files of the repository, and why.
PLACES = (("README.md", "README", "what is in the library, and how to build the demo"),
          ("docs/lessons.md", "Lessons", "short programs, from one texel to a shadow map on the GPU"),
          ("docs/choosing.md", "Choosing", "which filter suits which scene"),
          ("docs/stability.md", "Stability", "where each method fails, why, and what to use instead"),
          ("docs/reference/README.md", "Reference", "every kernel: domain, error, source, languages"),
          ("docs/shaders.md", "Shaders", "one file per language and technique to copy into an engine"))


class Driver:
    def __init__(self, folder):
        self.folder, self.id = folder, folder.name
        self.file = folder / "facts.json"
        self.facts = read(self.file)
        self.title = escape(self.facts["title"])

    def link(self, prefix):
        return f'<a href="{prefix}{quote(self.id)}/index.html">{self.title}</a>'


def page_of(driver, drivers, frame):
    """The page of a driver, and the drawings that it needs."""
    page, blocks = Page(driver.folder), driver.facts["blocks"]
    parts = [f'<section id="part{i + 1}">{render(block, page, f"{driver.file}: facts.blocks[{i}]")}</section>'
             for i, block in enumerate(blocks)]
    titles = "".join(f'<li><a href="#part{i + 1}">{escape(block["title"])}</a></li>'
                     for i, block in enumerate(blocks) if block.get("title") and not block.get("folded"))
    others = " ".join(other.link("../") for other in drivers if other is not driver)
    head = (f'<nav aria-label="Gallery"><a href="../index.html">Gnomon</a> {others}</nav>\n<h1>{driver.title}</h1>\n'
            f'<p class="summary">{escape(driver.facts["summary"])}</p>\n')
    if titles.count("<li>") > 3:
        head += f'<nav aria-label="On this page"><ul class="contents">{titles}</ul></nav>'
    text = frame.substitute(
        title=driver.title, up="../", head=head,
        body="\n".join(parts),
        foot='All numbers and pictures come from one run of the demo: <a href="facts.json">facts of this page</a>, '
             '<a href="../../report.json">report.json</a>.')
    return text, page.drawings


def cards(drivers):
    """One picture per family, with what it shows: that of the family's first driver that has one."""
    shown = {}
    for driver in drivers:
        if "front" in driver.facts:
            shown.setdefault(driver.facts["family"], driver)
    parts = []
    for driver in shown.values():
        front, prefix = driver.facts["front"], f"{quote(driver.id)}/"
        size = size_of_png(driver.folder / front["picture"])
        caption = inline(front["caption"], f"{driver.file}: facts.front.caption", prefix)
        shown_picture = picture(front["picture"], front["alt"], size, prefix)
        parts.append(figure(shown_picture, f"<b>{driver.link('')}</b>. {caption}"))
    return grid(parts, min(len(parts), 3), 17) if parts else ""


def front_chart(drivers):
    """The chart that a driver marks for the front page; its drawings are those of the driver's own page."""
    for driver in drivers:
        for i, block in enumerate(driver.facts["blocks"]):
            if block.get("front"):
                where, page = f"{driver.file}: facts.blocks[{i}]", Page(driver.folder, f"{quote(driver.id)}/")
                return (f"<h2>{escape(block.get('title', driver.facts['title']))}</h2>\n"
                        f'<div class="two"><div>{chart({**block, "caption": ""}, page, where, only_first=True)}</div>'
                        f'<div>{paragraphs(block.get("text", ""), f"{where}.text", page.prefix)}'
                        f'{paragraphs(block.get("caption", ""), f"{where}.caption", page.prefix)}'
                        f"<p>From: {driver.link('')}.</p></div></div>")
    return ""


def front_page(drivers, gallery, frame):
    pages = "".join(f"<li>{driver.link('')}: {escape(driver.facts['summary'])}</li>" for driver in drivers)
    places = "".join(f'<li><a href="{quote(os.path.relpath(ROOT / file, gallery))}">{name}</a>: {why}</li>'
                     for file, name, why in PLACES if (ROOT / file).exists())
    return frame.substitute(
        title="Gnomon: the gallery", up="",
        head="""<h1>Gnomon</h1>
<p class="summary">Gnomon is a header-only C++ library of shadow filters: small functions, the same in C++ and in every
shader language, that tell from a filtered shadow map how dark a point is, each with a stated domain, error and cost.</p>""",
        body=f"""<section>{cards(drivers)}</section>
<section>{front_chart(drivers)}</section>
<section><h2>Where to go</h2>
<div class="two"><div><h3>In this gallery</h3><ul>{pages}</ul></div>
<div><h3>In the repository</h3><ul>{places}</ul></div></div></section>""",
        foot='A gnomon is the part of a sundial that casts the shadow. All numbers and pictures come from one run of the '
             'demo: <a href="../report.json">report.json</a>.')


def write_all(files):
    """Writes all files aside, then renames them."""
    parts = [(file, file.with_name(f"{file.name}.part")) for file, _ in files]
    try:
        for (_, part), (_, content) in zip(parts, files):
            part.write_bytes(content)
        for file, part in parts:
            part.replace(file)
    except OSError as error:
        raise Damaged(f"{error.filename}: {error.strerror}") from None
    finally:
        for _, part in parts:
            part.unlink(missing_ok=True)


def make(out):
    gallery = out / "gallery"
    found = sorted(gallery.glob("*/facts.json"))
    drivers = [Driver(file.parent) for file in found]
    if not found:
        raise Damaged(f"{gallery}: no driver has left anything here; run the demo first")
    drivers.sort(key=lambda driver: driver.facts.get("order", float("inf")))
    if not (out / "report.json").is_file():
        raise Damaged(f"{out / 'report.json'}: no such file; run the demo again")
    frame = Template((HERE / "page.html").read_text(encoding="utf-8"))
    files = [(gallery / name, (HERE / name).read_bytes()) for name in ("style.css", "page.js")]
    drawings = []
    for driver in drivers:
        text, needed = page_of(driver, drivers, frame)
        files.append((driver.folder / "index.html", text.encode()))
        drawings += needed
    files.append((gallery / "index.html", front_page(drivers, gallery, frame).encode()))
    write_all(all_files(drawings) + files)


class Arguments(argparse.ArgumentParser):
    def error(self, message):
        raise Damaged(message)


def main(words=None):
    arguments = Arguments(description=__doc__)
    arguments.add_argument("--out", type=Path, default=Path("out"), help="the demo's folder (default: %(default)s)")
    try:
        make(arguments.parse_args(words).out)
    except Damaged as damage:
        print(f"gallery: {damage}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
