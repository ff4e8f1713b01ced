"""Pieces of HTML that blocks are made of."""

import re
from html import escape
from urllib.parse import quote

import colours
from facts import fail

TOKEN = re.compile(r'</?(?:b|i|sub|sup)>|<a href="([^"<>]*)">|</a>|&(?:[a-z][a-z0-9]*|#[0-9]+|#x[0-9a-f]+);', re.IGNORECASE)


def inline(text, where, prefix=""):
    """Text with the tags that facts may use; all else is shown as it is. prefix: of the addresses in it."""
    done, end, opened = [], 0, []
    for match in TOKEN.finditer(text):
        done.append(escape(text[end:match.start()], quote=False))
        end = match.end()
        token = match[0].lower() if match[1] is None else match[0]
        if token.startswith("&"):
            done.append(match[0])
            continue
        name = re.match(r"</?([a-z]+)", token)[1]
        if token.startswith("</"):
            if not opened or opened.pop() != name:
                fail(where, f"{token} closes nothing")
        else:
            opened.append(name)
        done.append(token if match[1] is None else f'<a href="{address(match[1], where, prefix)}">')
    if opened:
        fail(where, f"<{opened[-1]}> is not closed")
    return "".join(done) + escape(text[end:], quote=False)


def address(target, where, prefix):
    """An address in a page that is read from a disk: relative, to a place in the page, or by https."""
    if target.startswith("https://"):
        return target
    if re.match(r"[a-z][a-z0-9+.-]*:|//|/", target, re.IGNORECASE):
        fail(where, "an address is relative or begins with https://")
    return target if target.startswith("#") else prefix + target


def paragraphs(text, where, prefix=""):
    parts = [part for part in re.split(r"\n\s*\n", text.strip()) if part]
    return "".join(f"<p>{inline(part, where, prefix)}</p>\n" for part in parts)


def both(colour):
    """Style that gives an element the colour in each scheme."""
    light = colours.readable(colour)
    return f'style="--light: {light}; --dark: {colours.dark(light)}"'


def swatch(colour):
    return f'<span class="swatch" {both(colour)}></span>'


def picture(file, alt, size, prefix=""):
    """A picture that leads to itself at its full size."""
    source, (width, height) = prefix + quote(str(file)), size
    return (f'<a href="{source}"><img src="{source}" alt="{escape(alt)}" width="{width}" height="{height}" '
            'loading="lazy"></a>')


def drawing(stem, alt, size, prefix=""):
    """A chart by vectors, in the scheme of the page, and in pixels where vectors are not shown."""
    source, (width, height) = prefix + stem, size
    return (f'<a href="{source}.svg"><picture>'
            f'<source type="image/svg+xml" media="(prefers-color-scheme: dark)" srcset="{source}-dark.svg">'
            f'<source type="image/svg+xml" srcset="{source}.svg">'
            f'<img src="{source}.png" alt="{escape(alt)}" width="{width}" height="{height}" loading="lazy">'
            "</picture></a>")


def figure(content, caption="", alt=None):
    """alt: of several pictures together."""
    group = f' role="group" aria-label="{escape(alt)}"' if alt else ""
    return f"<figure{group}>{content}{f'<figcaption>{caption}</figcaption>' if caption else ''}</figure>"


def grid(cells, columns, least):
    """Cells in so many columns, in fewer where one would be narrower than `least`, in rem."""
    return f'<div class="grid" style="--columns: {columns}; --least: {least}rem">{"".join(cells)}</div>'
