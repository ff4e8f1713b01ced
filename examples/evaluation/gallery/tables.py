"""Renders table blocks: sorted by a press on a head, the best of a column marked."""

from html import escape

from legends import spoken
from markup import swatch

ROW_HEAD = 'th scope="row"'
STAR = '<span class="star" aria-hidden="true">★</span><b>{}</b><span class="unseen"> (best)</span>'


def is_number(value):
    return isinstance(value, (int, float))


def shown(value, column):
    """How a table shows a value, the same text for values that it cannot tell apart."""
    if value is None:
        return "–"
    if isinstance(value, str):
        return value
    value *= column.get("scale", 1)
    return f"{value:,.{column['digits']}f}" if "digits" in column else spoken(value)


class Column:
    """A column with the values of its rows: whether they are numbers, and how the best of them is shown."""

    def __init__(self, column, rows):
        self.facts, self.key = column, column["key"]
        self.kind = "word" if any(isinstance(row[self.key], str) for row in rows) else "number"
        values = [row[self.key] for row in rows if is_number(row[self.key]) and not row.get("aside")]
        self.best = None
        if "best" in column and values:
            least = (column["best"] == "low") == (column.get("scale", 1) > 0)
            best = shown(min(values) if least else max(values), column)
            # A value that most rows have marks out none.
            if 2 * sum(shown(value, column) == best for value in values) <= len(values) or len(values) < 3:
                self.best = best

    def head(self):
        label = (swatch(self.facts["colour"]) if "colour" in self.facts else "") + escape(self.facts["label"])
        return f'<th scope="col" class="{self.kind}"><button type="button">{label}</button></th>'

    def cell(self, row, tag="td", sign=""):
        """sign: what stands before the value."""
        value = row[self.key]
        text = shown(value, self.facts)
        sort_by = text if isinstance(value, str) else "" if value is None else repr(value * self.facts.get("scale", 1))
        best = is_number(value) and text == self.best and not row.get("aside")
        kind = f"{self.kind} best" if best else self.kind
        content = sign + (STAR.format(escape(text)) if best else escape(text))
        return f'<{tag} class="{kind}" data-key="{escape(sort_by)}">{content}</{tag.split()[0]}>'


def table(block, page, where):
    rows = block["rows"]
    first, *others = (Column(column, rows) for column in block["columns"])

    def line(row):
        sign = swatch(row["colour"]) if "colour" in row else ""
        return f"<tr>{first.cell(row, ROW_HEAD, sign)}{''.join(column.cell(row) for column in others)}</tr>"

    heads = "".join(column.head() for column in (first, *others))
    body = "\n".join(map(line, rows))
    notes = "".join(f"<div><dt>{escape(column['label'])}</dt><dd>{escape(column['hint'])}</dd></div>"
                    for column in block["columns"] if column.get("hint"))
    notes = f'<dl class="notes">{notes}</dl>' if notes else ""
    name = escape(block.get("title") or "Table")
    return (f'<div class="scroll" role="region" tabindex="0" aria-label="{name}"><table>\n'
            f"<thead><tr>{heads}</tr></thead>\n<tbody>\n{body}\n</tbody></table></div>{notes}\n")
