#!/usr/bin/env python3
"""Channels where moments are expected, and the reverse, do not compile: a forgotten transform is found by the compiler.

usage: channel_types.py LANGUAGE INCLUDE    prints one line for each case that is answered otherwise; exit code 1 if there is any

LANGUAGE is a key of languages.ROUTES, INCLUDE the folder that holds gnomon/.
"""
import sys
import tempfile
from pathlib import Path

from languages import ROUTES

# Statements over channels c, moments b, channels e and moments d, and whether they are right.
CASES = {
    "moments4_unorm16_intensity(c, 0.5f)": True,
    "moments4_unorm16_intensity(b, 0.5f)": False,
    "moments4_float_intensity(channels4_from_moments(b), 0.5f)": True,
    "moments4_float_intensity(b, 0.5f)": False,
    "theta4_inverse(theta4(b))": True,
    "theta4(c)": False,
    "theta4_inverse(b)": False,
    "theta4(theta4(b))": False,
    "hankel4_from_moments(theta4_inverse(c))": True,
    "hankel4_from_moments(c)": False,
    "moments6_unorm16_intensity(e, 0.5f)": True,
    "moments6_unorm16_intensity(d, 0.5f)": False,
    "moments6_unorm16_intensity(c, 0.5f)": False,
    "theta6(e)": False,
}
TYPES = {"c": "channels4", "b": "moments4", "e": "channels6", "d": "moments6"}


def main():
    language, route, include = sys.argv[1], ROUTES[sys.argv[1]], Path(sys.argv[2])
    header = f'{route.begin}#include "gnomon/gnomon.h"\n'
    using = "using namespace gnomon;\n" if language in ("c++", "metal") else ""
    real = "<float>" if language == "c++" else ""
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        for statement, right in CASES.items():
            struct = "struct " if language == "opencl" else ""
            variables = "".join(f"{struct}{type_}{real} {name}; {' '.join(members(type_, name))}" for name, type_ in TYPES.items())
            run = route.compiled(header + using + route.main.format(f"{variables}{statement};"), Path(folder) / "unit.out", include)
            if (run.returncode == 0) != right:
                wrong += 1
                print(f"{language}: {statement}: {'refused' if right else 'compiles'}\n{(run.stdout + run.stderr)[:400] if right else ''}")
    print(f"{language}: {len(CASES)} cases, {wrong} wrong")
    sys.exit(wrong > 0)


def members(type_, name):
    """Assignments to every member, so that no language warns of a variable without a value."""
    letter = "c" if type_.startswith("channels") else "b"
    return [f"{name}.{letter}{k} = 0.5f;" for k in range(1, int(type_[-1]) + 1)]


main()
