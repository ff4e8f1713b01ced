"""What the gallery's sections are made of."""

from html import escape


def picture(file, caption=""):
    caption = f"<figcaption>{caption}</figcaption>" if caption else ""
    return f'<figure><a href="{file}"><img src="{file}" alt="" loading="lazy"></a>{caption}</figure>'


def chart(folder, name, caption):
    return picture(f"{folder}/{name}.svg", f'{caption} (<a href="{folder}/{name}.png">PNG</a>)')


def table(heads, rows, words=2):
    """Heads are HTML; a row's cells are (key to sort by, HTML), or the two and whether to mark it as the best. The first
    `words` columns hold words, all others numbers."""
    def classes(column, best=False):
        return ' class="word"' if column < words else ' class="best"' if best else ""

    def cell(column, key, text, *best):
        return f'<td data-key="{escape(str(key))}"{classes(column, *best)}>{text}</td>'

    head = "".join(f"<th{classes(i)}>{text}</th>" for i, text in enumerate(heads))
    body = "\n".join("<tr>" + "".join(cell(i, *c) for i, c in enumerate(row)) + "</tr>" for row in rows)
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody></table></div>'


def legend_of_errors(facts):
    return f"""Errors of visibility: <b style="color:#2a62cc">blue</b> is light that leaks, <b style="color:#c8232c">red</b> is
acne, saturated at {facts["error_scale"]:g}."""
