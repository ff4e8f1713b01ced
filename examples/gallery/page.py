"""What the gallery's sections are made of."""

from html import escape


def picture(file, caption=""):
    caption = f"<figcaption>{caption}</figcaption>" if caption else ""
    return f'<figure><a href="{file}"><img src="{file}" alt="" loading="lazy"></a>{caption}</figure>'


def chart(folder, name, caption):
    return picture(f"{folder}/{name}.svg", f'{caption} (<a href="{folder}/{name}.png">PNG</a>)')


def table(heads, rows):
    """Heads are HTML; a row's cells are (key to sort by, HTML), or the two and whether to mark it as the best."""
    def cell(key, text, best=False):
        mark = ' class="best"' if best else ""
        return f'<td data-key="{escape(str(key))}"{mark}>{text}</td>'

    head = "".join(f"<th>{text}</th>" for text in heads)
    body = "\n".join("<tr>" + "".join(cell(*c) for c in row) + "</tr>" for row in rows)
    return f'<div class="scroll"><table><thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody></table></div>'


def legend_of_errors(facts):
    return f"""Errors of visibility: <b style="color:#2a62cc">blue</b> is light that leaks, <b style="color:#c8232c">red</b> is
acne, saturated at {facts["error_scale"]:g}."""
