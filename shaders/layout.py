"""Lines of at most WIDTH columns for text whose words have changed their lengths: joins what was broken, breaks anew."""
import re

WIDTH = 120
TEMPLATE = re.compile(r"(template <(?:[^<>]|<[^<>]*>)*>) (.*)")
FUNCTION = re.compile(r"(\w.*\)) \{ (.*;) \}")
PLACE = re.compile(r"(?<!<Real), |(?<= [+\-*/=]) |(?<= &&) ")
COMMENT = re.compile(r" *//+<? ")
ENDS = re.compile(r" |$|- |\w+: ") # of a paragraph of comment: what its next line begins with
ONE_STATEMENT = re.compile(r"^(\w.*\))\n\{\n    (return [^;]*;)\n\}\n", re.MULTILINE)


def depth(code):
    return code.count("(") - code.count(")")


def wrapped(line):
    """The line, broken where the fewest brackets are open, each further part beginning below what it belongs to."""
    if len(line) <= WIDTH:
        return [line]
    if template := TEMPLATE.fullmatch(line):
        return [template[1], *wrapped(template[2])]
    if function := FUNCTION.fullmatch(line):
        return [*wrapped(function[1]), "{", *wrapped("    " + function[2]), "}"]
    if "//" in line: # a comment behind code that leaves it no room goes before
        code, _, comment = line.partition("//")
        return [" " * (len(line) - len(line.lstrip())) + "//" + comment, *wrapped(code.rstrip())]
    lines, opened, rest = [], [], line
    begins = re.match(r".*?(?: = |\breturn )", line)
    while len(rest) > WIDTH:
        indent = len(rest) - len(rest.lstrip())
        places = [place.end() for place in PLACE.finditer(rest, indent, WIDTH + 1)]
        if not places:
            break
        end = min(reversed(places), key=lambda place: (rest[place - 2] == "=", depth(rest[:place])))
        for column, character in enumerate(rest[:end]):
            if character == "(":
                opened.append(column + 1)
            elif character == ")":
                opened.pop()
        lines.append(rest[:end].rstrip())
        rest = " " * (opened[-1] if opened else begins.end() if begins else 4) + rest[end:]
    lines.append(rest)
    if line.startswith(" ") or max(map(len, lines)) <= WIDTH:
        return lines
    name = line.rindex(" ", 0, line.index("(")) # a head too wide for that breaks behind its result
    return [line[:name], *wrapped("    " + line[name + 1:])]


def laid_out(text):
    """The text with each statement, each head of a function and each function of one statement on one line, where it fits."""
    lines, statement = [], []
    for line in [*reflowed(text.splitlines()), ""]:
        code = line.partition("//")[0].rstrip()
        if code == "{" and statement: # what came before was the head of a function
            lines += joined(statement)
            statement = []
        if code and not code.startswith("#"):
            statement.append(line)
        if statement and (not code or code.endswith((";", "{", "}")) and not depth("".join(statement))):
            lines += joined(statement)
            statement = []
        elif not code or code.startswith("#"):
            lines.append(line)
    return ONE_STATEMENT.sub(shortened, "\n".join(lines))


def reflowed(lines):
    """The lines, words of comments that reach beyond WIDTH moved to the next line, or to one of their own where the text ends."""
    rest, mark = "", ""
    for line in lines:
        goes_on = rest and line.startswith(mark) and not ENDS.match(line, len(mark))
        if goes_on:
            line = f"{mark}{rest} {line[len(mark):]}"
        elif rest:
            yield mark + rest
        rest = ""
        if len(line) > WIDTH and (found := COMMENT.match(line)):
            end, mark = line.rindex(" ", 0, WIDTH + 1), found[0]
            line, rest = line[:end], line[end + 1:]
        yield line
    if rest:
        yield mark + rest


def joined(statement):
    if any("//" in part for part in statement[:-1]):
        return statement
    line = re.sub(r"\( ", "(", " ".join([statement[0], *map(str.strip, statement[1:])]))
    hangs = any(part.endswith("(") for part in statement) and max(map(len, statement)) <= WIDTH
    return statement if hangs and len(line) > WIDTH else wrapped(line)


def shortened(function):
    line = f"{function[1]} {{ {function[2]} }}"
    return line + "\n" if len(line) <= WIDTH else function[0]
