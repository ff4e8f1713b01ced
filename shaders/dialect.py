"""Kernel headers and preludes as the packager reads them: macros, includes, blocks of text, and what becomes of them."""
import re
from collections import Counter
from dataclasses import dataclass, field

from layout import laid_out

HEAD = r"(?P<comment>(?://[^\n]*\n)+)#ifndef (?P<guard>\w+)\n#define (?P=guard)\n"
HEADER = re.compile(HEAD + r"(?P<includes>(?:#include [^\n]*\n|\n)*)"
                    r"(?:GNOMON_NAMESPACE_BEGIN\n\n(?P<body>.*)\nGNOMON_NAMESPACE_END\n)?#endif\n", re.DOTALL)
PRELUDE = re.compile(HEAD + r"(?P<rest>.*)#endif\n", re.DOTALL)
MACRO = re.compile(r"#define (GNOMON_\w+|Real)(?:\(([^)]*)\))?(?: (.*))?")
SAME = re.compile(r"^#define (GNOMON_\w+) (GNOMON_\w+)$", re.MULTILINE) # a word that is another one in every language
NUMBER = r"-?\d+(?:\.\d*)?(?:e[+-]?\d+)?"
CONSTANT = re.compile(r"^GNOMON_CONSTANT\((\w+),.*\n", re.MULTILINE)
DEFINED = re.compile(r"^GNOMON_(?:(?:DETAIL_)?(?:LIST_)?KERNEL\s+(?:GNOMON_(?:LIST_)?T\(\w+\)|\w+)\s+"
                     r"|(?:LIST_)?STRUCT\(|CONSTANT\()(\w+)", re.MULTILINE)
DECIDED = re.compile(r"^( *)if \((?:(true|false)|(\d+) > (\d+))\) \{\n(.*?)^\1\}(?: else \{\n(.*?)^\1\})?\n",
                     re.DOTALL | re.MULTILINE)


class DialectError(Exception):
    pass


def parsed(pattern, path):
    found = pattern.fullmatch(path.read_text())
    if not found:
        raise DialectError(f"{path}: not of the form comment, include guard, includes, namespace, body")
    return found


def blocks(text):
    """The text cut at the blank lines between definitions."""
    depth, block = 0, ""
    for line in text.splitlines(keepends=True):
        code = line.partition("//")[0]
        depth += code.count("{") - code.count("}")
        if line.strip() or depth:
            block += line
        elif block:
            yield block
            block = ""
    if block:
        yield block


@dataclass
class Header:
    """A header of the kernel dialect, by its path below include/gnomon; gnomon.h has includes alone."""
    name: str
    comment: str
    guard: str
    includes: list[str]
    blocks: list[str]

    @staticmethod
    def read(root, name):
        path = root / name
        file = parsed(HEADER, path)
        includes = [(path.parent / include).resolve().relative_to(root.resolve()).as_posix()
                    for include in re.findall(r'^#include "(.*)"', file["includes"], re.MULTILINE)]
        return Header(name, file["comment"], file["guard"], [include for include in includes if include != "portable.h"],
                      list(blocks(file["body"] or "")))


def code_words(text):
    """How often each word stands outside comments."""
    return Counter(re.findall(r"\b[A-Za-z_]\w*", re.sub(r"//.*", "", text)))


def with_includes(text, folder):
    """A prelude's text with what it shares with others in the places of the includes."""
    def included(name):
        return with_includes(parsed(PRELUDE, folder / name[1])["rest"], folder).strip() + "\n"

    return re.sub(r'^#include "(.*)"\n', included, text, flags=re.MULTILINE)


def fold(text):
    """The text with each branch on a number that the language fixes replaced by the part that it takes."""
    def taken(found):
        _, word, left, right, first, second = found.groups()
        holds = word == "true" if word else int(left) > int(right)
        return re.sub(r"^    ", "", (first if holds else second) or "", flags=re.MULTILINE)

    return DECIDED.sub(taken, text)


def with_value(code, name, parameters, value):
    """The code with one macro replaced; no argument holds brackets."""
    if parameters is None:
        return re.sub(rf"\b{name}\b", value, code)

    def applied(call):
        arguments = dict(zip(parameters, call[1].split(", ")))
        return re.sub(r"\w+", lambda word: arguments.get(word[0], word[0]), value)

    return re.sub(rf"\b{name}\(([^()]*)\)", applied, code)


@dataclass
class Prelude:
    """A language's spelling of the dialect, taken from its prelude: macros to expand, and what is no macro."""
    comment: str
    guard: str
    frame: list[str] = field(default_factory=list)
    blocks: list[str] = field(default_factory=list)
    macros: dict = field(default_factory=dict)
    unused: set = field(default_factory=set)
    names: set = field(default_factory=set) # that get a prefix
    prefix: str = ""

    @staticmethod
    def read(path):
        file = parsed(PRELUDE, path)
        prelude = Prelude(file["comment"], file["guard"])
        prelude.macros = {name: (None, value) for name, value in SAME.findall((path.parent.parent / "portable.h").read_text())}
        for block in blocks(with_includes(file["rest"], path.parent)):
            code = re.sub(r"^//.*\n", "", block, flags=re.MULTILINE)
            if code.startswith("#if") and "#define GNOMON_" in code:
                prelude.frame.append(block) # on this word the compiler decides: it stays a macro, for as long as the package
                continue
            for name, parameters, value in MACRO.findall(code):
                value = re.sub(r"\bgnomon::", "", value).replace("; ", ";\n") # statements on lines of their own
                prelude.macros[name] = parameters.split(", ") if parameters else None, value
            if re.sub(r"^(#define .*|typedef float Real;)\n", "", code, flags=re.MULTILINE):
                prelude.blocks.append(block)
        return prelude

    def forget_unused(self, headers):
        """Drops from now on what only branches for another precision read: their constants, and functions of the prelude."""
        text = "\n".join(self.expanded(block) for header in headers for block in header.blocks) + self.own_text()
        before, after = code_words(text), code_words(fold(text))
        constants = [name for header in headers for block in header.blocks for name in CONSTANT.findall(block)]
        functions = re.findall(r"\b(gnomon_\w+)\(", self.own_text())
        self.unused = {name for name in constants + functions if before[name] > after[name] == 1}

    def own_text(self):
        """What the prelude says itself, in the package's words."""
        return "\n" + "\n".join(self.without_unused(self.expanded(block)) for block in self.blocks) + "\n"

    def spelled(self, blocks, before):
        """Kernels in the package's words, after the text before them."""
        texts = [self.without_unused(fold(self.expanded(block))) for block in blocks]
        for word in code_words("\n".join(texts)):
            if word.startswith("GNOMON_") and f"#define {word}" not in "\n".join([before, *texts]):
                raise DialectError(f"{word}: a word of the dialect that {self.guard} does not spell")
        texts = [laid_out(self.prefixed(text)) for text in texts if code_words(text)]
        namespace = [self.expanded(f"GNOMON_NAMESPACE_{end}\n") for end in ("BEGIN", "END")]
        namespace[1] = namespace[1].replace("}", "} // namespace gnomon")
        return "\n" + "\n".join(text for text in [namespace[0], *texts, namespace[1]] if text.strip()) + "\n"

    @property
    def has_namespaces(self):
        return bool(self.macros["GNOMON_NAMESPACE_BEGIN"][1])

    def prefixed(self, text):
        """The text with the prefix before helpers' names, in comments too unless they may be words of English there."""
        name = re.compile(rf"(?<![\w.])(?:{'|'.join(self.names) or '$'})\b")
        parts = re.split(r"(//.*)", text)
        for i, part in enumerate(parts):
            plain = re.compile(r"[a-z]+" if part.startswith("//") else "$")
            parts[i] = name.sub(lambda word: word[0] if plain.fullmatch(word[0]) else self.prefix + word[0], part)
        return "".join(parts)

    def without_unused(self, text):
        names = "|".join(self.unused) or "$"
        return re.sub(rf"^(?!//)\w.*\b(?:{names})(?: = |\().*\n", "", text, flags=re.MULTILINE)

    def expanded(self, text):
        parts = re.split(r"(//.*)", text)
        expanded = "".join(self.without_real(part) if part.startswith("//") else self.expanded_code(part) for part in parts)
        return re.sub(r"^ (?=\S)", "", expanded, flags=re.MULTILINE) # what an empty GNOMON_KERNEL leaves

    def expanded_code(self, code):
        before = ""
        while code != before:
            before = code
            for name, (parameters, value) in self.macros.items():
                if name != "Real" and name in code:
                    code = with_value(code, name, parameters, value)
        code = re.sub(rf"(\(float\)|\b(?:Real|float))\(({NUMBER})\)", self.literal, code)
        return self.without_real(code)

    def without_real(self, text):
        return re.sub(r"\bReal\b", "float", text) if "Real" in self.macros else text

    def literal(self, found):
        """A number behind a cast to float as a number of that type, unless the cast is a template's."""
        cast, number = found[1], found[2]
        if cast.strip("()") == "Real" and "Real" not in self.macros:
            return found[0]
        return number + ("" if re.search("[.e]", number) else ".0") + self.suffix

    @property
    def suffix(self):
        """What the prelude writes behind its own numbers."""
        return "f" if re.search(r"\d\.\d+(?:e-\d+)?f;", "".join(self.blocks)) else ""
