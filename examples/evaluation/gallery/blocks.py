"""Renders the blocks of a driver's facts."""

from html import escape

import charts
import colours
import maps
from drawings import Drawing
from facts import size_of_png
from legends import legend
from markup import drawing, figure, grid, inline, paragraphs, picture, swatch
from tables import table


class Page:
    """Where blocks are shown: their files' folder, the way there from the page, and the drawings they need."""

    def __init__(self, folder, prefix=""):
        self.folder, self.prefix = folder, prefix
        self.drawings = []

    def draw(self, name, alt, inches, make, used=()):
        """make: the function that makes the figure, and its arguments. used: the colours in it that differ in the dark
        scheme, apart from the page's own."""
        self.drawings.append(Drawing(self.folder / name, make, used))
        return drawing(name, alt, [round(charts.DPI * inch) for inch in inches], self.prefix)

    def caption(self, entry, where):
        return inline(entry.get("caption", ""), f"{where}.caption", self.prefix)


def text(block, page, where):
    return ""


def pictures(block, page, where):
    def one(i, entry):
        shown = picture(entry["file"], entry["alt"], size_of_png(page.folder / entry["file"]), page.prefix)
        return figure(shown, page.caption(entry, f"{where}.pictures[{i}]"))

    entries = block["pictures"]
    columns = block.get("columns", min(len(entries), 3))
    content = grid([one(i, entry) for i, entry in enumerate(entries)], columns, 15 if columns < 4 else 9)
    if block.get("pixelated"):
        content = f'<div class="pixelated">{content}</div>'
    if block.get("compare"):
        first, second = block.get("shown", (0, 1))[:2]
        content = f'<div class="compare" data-first="{first}" data-second="{second}">{content}</div>'
    key = "".join(f"<li>{swatch(entry['colour'])}{escape(entry['label'])}</li>" for entry in block.get("key", ()))
    return content + (f'<ul class="legend">{key}</ul>' if key else "") + "\n"


def chart(block, page, where, only_first=False):
    """only_first: the first panel alone, as on the front page."""
    panels = block["panels"]
    looks, area = charts.looks(panels), charts.Areas(panels)
    used = [shade for look in looks.values() for shade in (look.colour, colours.readable(look.colour, colours.TEXT))]
    shown = panels[:1] if only_first else panels

    def one(i, panel):
        name = f"{block['name']}-{i + 1}" if len(panels) > 1 else block["name"]
        title = " ".join(panel.get("title", "").split()) or f"{panel['y']['label']} against {panel['x']['label']}"
        alt = title if len(shown) > 1 else block["alt"]
        return page.draw(name, alt, (charts.WIDTH, charts.HEIGHT), (charts.draw, panel, looks, area), used)

    content = grid([one(i, panel) for i, panel in enumerate(shown)], min(len(shown), 3), 20)
    alt = block["alt"] if len(shown) > 1 else None
    return figure(content + legend(shown, looks, area), page.caption(block, where), alt) + "\n"


def heat_map(block, page, where):
    shades, several = maps.Shades(block), len(block["maps"]) > 1

    def one(i, shown):
        failing, known = maps.failures(shown, block["threshold"])
        said = f"{failing} of {known} cells fail"
        name = f"{block['name']}-{i + 1}" if several else block["name"]
        alt = f"{shown['label']}: {said}"
        return figure(page.draw(name, alt, (maps.WIDTH, maps.HEIGHT), (maps.draw, block, shown, shades)), said)

    alt = f"Colours of {block['label']}; a value above {block['threshold']:g} fails"
    key = page.draw(f"{block['name']}-key", alt, (maps.WIDTH, maps.KEY_HEIGHT), (maps.draw_key, block, shades))
    cells = grid([one(i, shown) for i, shown in enumerate(block["maps"])], min(len(block["maps"]), 4), 15)
    caption = page.caption(block, where)
    if several:
        sheet = f"{block['name']}-all"
        page.drawings.append(Drawing(page.folder / sheet, (maps.draw_sheet, block, shades), sheet=True))
        caption += f' <a href="{page.prefix}{sheet}.png">All maps in one picture.</a>'
    return figure(f'<div class="key">{key}</div>{cells}', caption, block["alt"]) + "\n"


RENDERERS = {"text": text, "table": table, "pictures": pictures, "chart": chart, "map": heat_map}


def render(block, page, where):
    """A block as HTML. page: where it is shown, which collects the drawings; where: its place in the facts."""
    content = RENDERERS[block["type"]](block, page, where)
    prose = paragraphs(block.get("text", ""), f"{where}.text", page.prefix)
    title = escape(block.get("title", ""))
    if block.get("folded"):
        return f"<details><summary>{title}</summary>\n{prose}{content}</details>\n"
    return (f"<h2>{title}</h2>\n" if title else "") + prose + content
