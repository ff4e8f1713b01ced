"""From a package in GLSL to the same package in WGSL, statement by statement: the kernel dialect has few kinds of them.

A compiler's way, from GLSL to SPIR-V to WGSL, loses comments and the names of variables; tests/shaders goes that way
too, and compares.
"""
import re
import struct
from fractions import Fraction

from dialect import DialectError
from layout import laid_out

LANGUAGE = """\
// WGSL has neither preprocessor nor include guard: put this text, once, before the shader's own.
// The same bits as on the CPU come wherever / and sqrt are rounded correctly and no multiplication is fused with an
// addition. WGSL can ask for neither: where a compiler fuses, the exact products lose some of their low parts.
"""
TYPES = {"float": "f32", "int": "i32"}
PRELUDE = re.compile(r"(?<=^// the language )(-+\n)(?://.*\n)*", re.MULTILINE)
GUARDS = re.compile(r"^#ifndef \w+\n#define \w+\n|\n#endif\n", re.MULTILINE)
CONSTANT = re.compile(r"^const float (\w+) = (\S+);(?: +// (.*))?", re.MULTILINE)
STRUCT = re.compile(r"^struct (\w+) \{ (.*?) \};", re.MULTILINE | re.DOTALL)
FUNCTION = re.compile(r"^(\w+) (\w+)\(([^()]*)\)( \{.*\}$|\n\{.*?^\})", re.MULTILINE | re.DOTALL)
DECLARATION = re.compile(r"^( *)(?:precise )?(?!return\b)(\w+) (\w+)(;| =)", re.MULTILINE)
STATEMENTS = [(re.compile(pattern, re.MULTILINE), replacement) for pattern, replacement in [
    (r"\breturn ([^;]*?) \? (\w+) : (\w+);", r"return select(\3, \2, \1);"),
    (r"\bintBitsToFloat\(", "bitcast<f32>("),
    (r"\bfloat\(", "f32("),
    (r"\bint\(", "i32("),
    (r"\bfor \(int (\w+) = (.*); \+\+\1\)", r"for (var \1 = \2; \1++)"),
    (r"^( *(?:for|if) \(.*\)) ([^{]*;)$", r"\1 { \2 }"),
]]
NOT_WGSL = re.compile(r"^#.*|.*(?:\?|\+\+\w|\[|\b(?:bool|float|int|precise) \w|\b(?:do|while)\b|\belse [^{i]).*", re.MULTILINE)


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
    name, text = found.groups()
    members = [f"{member}: {type_of(kind)}" for kind, some in re.findall(r"(\w+) ([^;]+)", text)
               for member in re.split(r",\s*", some)]
    return f"struct {name} {{ {', '.join(members)} }};"


def function(found):
    result, name, parameters, body = found.groups()
    parameters = [parameter.split() for parameter in re.split(r",\s*", parameters)]
    assigned = set(re.findall(r"^ *(\w+)(?:\.\w+)* = ", body, re.MULTILINE))

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
    text = PRELUDE.sub(rf"\1{LANGUAGE}", GUARDS.sub("", glsl))
    text = text.replace(" in GLSL,", " in WGSL,", 1).replace(".glsl:", ".wgsl:", 1)
    for pattern, change in ((CONSTANT, constant), (STRUCT, structure), (FUNCTION, function)):
        text = pattern.sub(change, text)
    if left := NOT_WGSL.search(re.sub(r"//.*", "", text)):
        raise DialectError(f"wgsl.py: cannot say in WGSL: {left[0].strip()}")
    return laid_out(text)
