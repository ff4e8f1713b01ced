"""Makes GLSL precise throughout: OpenGL's compilers may contract, cancel and reorder whatever is not, and have no
NoContraction to be told by. The functions' own text stays; only variables and results are declared anew."""
import re
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "shaders"))
from wgsl import FUNCTION

VARIABLE = re.compile(r"^( +)(?!return\b|precise\b)(\w+) (\w+)(?=;| =)", re.MULTILINE)
RETURN = re.compile(r"\breturn ([^;]*);")


def function(found):
    result, name, parameters, body = found.groups()
    parameters = re.sub(r"(?<!\w)(?=\w+ \w+)", "precise ", parameters)
    body = RETURN.sub(rf"{{ precise {result} returned = \1; return returned; }}", VARIABLE.sub(r"\1precise \2 \3", body))
    return f"{result} {name}({parameters}){body}"


def precise(text):
    return FUNCTION.sub(function, text)
