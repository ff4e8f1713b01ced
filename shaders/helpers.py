"""Which names of the headers are a user's. The others get a prefix in packages of languages that have no namespaces."""
import re
from pathlib import Path

from dialect import DEFINED, DialectError, code_words

STRUCT = re.compile(r"GNOMON_(?:LIST_)?STRUCT\(.*?\{(.*?)\}", re.DOTALL)
DETAIL = re.compile(r"GNOMON_DETAIL_(?:LIST_)?KERNEL\b")
KERNEL = re.compile(r"GNOMON_(?:DETAIL_)?(?:LIST_)?KERNEL\b")


def definitions(headers):
    """(name, text without comments) of everything that the headers define, in their order."""
    for header in headers:
        text = re.sub(r"//.*", "", "\n".join(header.blocks))
        found = list(DEFINED.finditer(text))
        for this, following in zip(found, [*found[1:], None]):
            yield this[1], text[this.start():following.start() if following else len(text)]


def technique_first(headers):
    """The pattern of a name that begins with its technique: a header's name, then a number or a word, unless it has two."""
    stems = {re.sub(r"\d+$", "", Path(header.name).stem) for header in headers if not header.name.startswith("numerics/")}
    return re.compile(rf"(?:{'|'.join(stems)})(?:\d+|\d*_\w+)|{'|'.join(stem for stem in stems if '_' in stem)}")


def parts(headers, also=lambda name: False):
    """Names of detail kernels, and of structs and constants that these alone use; or of others, if so wanted."""
    defined = dict(definitions(headers))
    users = {name: set() for name, text in defined.items() if not KERNEL.match(text)}
    for name, text in defined.items():
        for word in code_words(text):
            if word in users and word != name:
                users[word].add(name)
    names = {name for name, text in defined.items() if DETAIL.match(text)}
    while True: # a struct may be used by structs
        more = {name for name, by in users.items() if also(name) or by and by <= names} - names
        if not more:
            return names
        names |= more


def internal(headers):
    """Names that get a prefix: of parts, and of structs and constants that do not begin with a technique."""
    first = technique_first(headers)
    names = parts(headers, lambda name: not first.fullmatch(name))
    for name, text in definitions(headers):
        for member in re.findall(r"\w+(?=[,;\[])", "".join(STRUCT.findall(text))):
            if member in names:
                raise DialectError(f"{name}: its member {member} has the name of a helper, which gets a prefix in packages")
    return names
