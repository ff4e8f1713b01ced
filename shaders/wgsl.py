"""From a package in GLSL to the same package in WGSL, statement by statement: the kernel dialect has few kinds of them.

A compiler's way, from GLSL to SPIR-V to WGSL, loses comments and the names of variables; tests/shaders goes that way
too, and compares.
"""
import re
import struct
from fractions import Fraction
from pathlib import Path

from dialect import DialectError
from layout import laid_out, wrapped

LANGUAGE = Path(__file__).with_name("portable.wgsl")
TYPES = {"float": "f32", "int": "i32"}
PRELUDE = re.compile(r"(?<=^// the language )(-+\n).*?(?=^// \S+ -+\n)", re.MULTILINE | re.DOTALL)
GUARDS = re.compile(r"^#ifndef \w+\n#define \w+\n|\n#endif\n", re.MULTILINE)
CAPACITY = re.compile(r"^#ifndef (\w+)\n#define \1 (\d+)\n#endif$", re.MULTILINE)
CONSTANT = re.compile(r"^const float (\w+) = (\S+);(?: +// (.*))?", re.MULTILINE)
STRUCT = re.compile(r"^struct (\w+)(\s+\{)(.*?)\};", re.MULTILINE | re.DOTALL)
MEMBERS = re.compile(r"\b(\w+) (\w+(?:,\s+\w+)*)(?:\[(\w+)\])?;")
FUNCTION = re.compile(r"^(\w+) (\w+)\(([^()]*)\)( \{[^\n]*\}$|\n\{.*?^\})", re.MULTILINE | re.DOTALL)
DECLARATION = re.compile(r"^( *)(?!return\b)(\w+) (\w+)(;| =)", re.MULTILINE)
STATEMENTS = [(re.compile(pattern, re.MULTILINE), replacement) for pattern, replacement in [
    (r"\bfloat\(", "f32("),
    (r"\bint\(", "i32("),
    (r"\bfor \(int (\w+) = (.*); \+\+\1\)", r"for (var \1 = \2; \1++)"),
    (r"^( *(?:for|if) \(.*\)) ([^{;]*;)$", r"\1 { \2 }"),
]]
IN_CODE = re.compile(r"(\.?)\b([A-Za-z]\w*\d)\b")
IN_COMMENT = re.compile(r"()\b([A-Za-z]\w*\d)\b(?!\.\w)") # a file's name stays
NOT_WGSL = re.compile(r"^#.*|.*(?:\?|\+\+\w|[^.\w]\w+\[|\b(?:bool|float|int) \w|\b(?:do|while)\b|\belse [^{i]).*", re.MULTILINE)


def spelled(name):
    """A name that a user may write, as WGSL has it: naga would put this underscore, and Bevy's composer then refuses the name."""
    return name + "_" if name[-1].isdigit() else name


def all_spelled(text):
    """The text with all names so: of what it defines, in comments too, and of members where they are read."""
    names = set(re.findall(r"^(?:const|fn|struct) (\w*\d)\b", text, re.MULTILINE))

    def name(found):
        dot, word = found.groups()
        return dot + (spelled(word) if dot or word in names else word)

    parts = re.split(r"(//.*)", text)
    return "".join((IN_COMMENT if part.startswith("//") else IN_CODE).sub(name, part) for part in parts)


def type_of(word):
    return TYPES.get(word, word)


def constant(found):
    """By its bits where no float is that number: WGSL leaves it to the compiler on which side to round."""
    name, decimal, comment = found.groups()
    nearest = struct.unpack("f", struct.pack("f", float(decimal)))[0]
    value = decimal
    if Fraction(decimal) != Fraction(nearest):
        digits, exponent = nearest.hex().split("p")
        value = f"{digits.rstrip('0')}p{exponent}"
        comment = ", ".join(filter(None, [decimal, comment]))
    return f"const {name}: f32 = {value};" + (f" // {comment}" if comment else "")


def structure(found):
    name, opening, text = found.groups()

    def typed(some):
        type_ = type_of(some[1]) if not some[3] else f"array<{type_of(some[1])}, {some[3]}>"
        return re.sub(r"\w+", lambda word: f"{spelled(word[0])}: {type_}", some[2]) + ","

    members = MEMBERS.sub(typed, text)
    return "\n".join(wrapped(f"struct {name}{opening}{re.sub(', $', ' ', members)}}}"))


def function(found):
    result, name, parameters, body = found.groups()
    parameters = [parameter.split() for parameter in re.split(r",\s*", parameters)]
    assigned = set(re.findall(r"(?:^ *|\) )(\w+)(?:\.\w+|\[[^\]]*\])* = ", body, re.MULTILINE))
    assigned |= set(re.findall(r"(\w+)(?:\.\w+)*\[[a-z]", body)) # naga before 23 indexes nothing else by a variable

    def declaration(found):
        indent, kind, word, rest = found.groups()
        if rest == ";":
            return f"{indent}var {word}: {type_of(kind)};"
        return f"{indent}{'var' if word in assigned else 'let'} {word} ="

    body = DECLARATION.sub(declaration, body)
    for pattern, replacement in STATEMENTS:
        body = pattern.sub(replacement, body)
    for kind, word in parameters: # a parameter of WGSL cannot be assigned to
        if word in assigned:
            body = body.replace("{\n", f"{{\n    var {word} = given_{word};\n", 1)
    head = ", ".join(f"{'given_' * (word in assigned)}{word}: {type_of(kind)}" for kind, word in parameters)
    return f"fn {name}({head}) -> {type_of(result)}{body}"


def translated(glsl):
    for name in dict(CAPACITY.findall(glsl)): # a constant, to be changed where it stands
        glsl = CAPACITY.sub(r"const \1: i32 = \2;", glsl, 1).replace(name, name.lower())
    text = GUARDS.sub("", PRELUDE.sub(lambda rule: f"{rule[1]}{LANGUAGE.read_text()}\n", glsl))
    text = text.replace(" in GLSL,", " in WGSL,", 1).replace(".glsl:", ".wgsl:", 1)
    text = STRUCT.sub(structure, laid_out(all_spelled(FUNCTION.sub(function, CONSTANT.sub(constant, text)))))
    code = re.sub(r"//.*", "", text)
    if left := NOT_WGSL.search(code):
        raise DialectError(f"wgsl.py: cannot say in WGSL: {left[0].strip()}")
    words = set(re.findall(r"\bgnomon_\w+", code)) - set(re.findall(r"(?:fn|const|struct) (gnomon_\w+)", code))
    if words:
        raise DialectError(f"{LANGUAGE}: lacks {', '.join(sorted(words))}")
    return text
