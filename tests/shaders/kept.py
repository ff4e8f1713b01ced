"""Keeps every operation of a text in GLSL or WGSL as it is written, where nothing else can: WGSL knows neither precise nor
NoContraction, and SwiftShader makes x of (x - y) + y, -x of 0 - x, and more. Results go through gnomon_kept, which
nothing is rewritten across; the functions of the prelude, which has it, stay."""
import re

TOKEN = re.compile(r"\s*(\w[\w.]*(?:(?<=\de)[+-]\d+)?|[<>=!]=|&&|\|\||.)")
LEVELS = [["||"], ["&&"], ["==", "!="], ["<", "<=", ">", ">="], ["+", "-"], ["*", "/"]]
EXPRESSION = re.compile(r"(^ +(?:\w+ )?\w+(?: \w+)?(?:\.\w+|\[[^\]]*\])* = |\breturn )([^;]*)(?=;)", re.MULTILINE)
KERNELS = re.compile(r"^// \w+/", re.MULTILINE)


class Parser:
    def __init__(self, text, comparison):
        self.tokens = TOKEN.findall(text.strip()) + [""]
        self.comparison = comparison

    def take(self):
        return self.tokens.pop(0)

    def binary(self, level=0):
        if level == len(LEVELS):
            return self.unary()
        left = self.binary(level + 1)
        while self.tokens[0] in LEVELS[level]:
            operator = self.take()
            left = f"{left} {operator} {self.binary(level + 1)}"
            form = "gnomon_kept({})" if operator in "+-*/" else "({})" if operator in ("&&", "||") else self.comparison
            left = form.format(left)
        return left

    def unary(self):
        if self.tokens[0] in ("-", "!"):
            return self.take() + self.unary()
        if self.tokens[0] == "(":
            return self.bracketed() + self.members()
        name = self.take()
        return name + (self.bracketed() if self.tokens[0] == "(" else "") + self.members()

    def members(self):
        members = ""
        while self.tokens[0] in (".", "["):
            members += self.take() + self.take()
            while members.count("[") > members.count("]"): # whole numbers stay as they are
                members += self.take()
        return members

    def bracketed(self):
        parts = []
        while self.take() in ("(", ","):
            parts.append(self.binary())
        return f"({', '.join(parts)})"


def expression(found, comparison):
    parser = Parser(found[2], comparison)
    text = parser.binary()
    if parser.tokens != [""]:
        raise ValueError(f"kept.py: cannot read {found[2]}")
    return found[1] + text


def kept(text, comparison="({})"):
    start = KERNELS.search(text).start()
    return text[:start] + EXPRESSION.sub(lambda found: expression(found, comparison), text[start:])
