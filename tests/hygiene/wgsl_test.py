#!/usr/bin/env python3
"""Tests shaders/wgsl.py: what it makes of each kind of definition and statement, and that it refuses every other kind.

usage: wgsl_test.py SHADERS    SHADERS is the folder that holds wgsl.py
"""
import sys

sys.path.insert(0, sys.argv[1])
from dialect import DialectError
from wgsl import translated

HEAD = "// the language ---\n#error a prelude in another language\n// numerics/a.h ---\n"

# GLSL and what it becomes.
TRANSLATIONS = [
    # A float as it is; by its bits what is none, in both directions of rounding and below 1.
    ("const float a = 0.375;\n", "const a: f32 = 0.375;\n"),
    ("const float a = 1e-1; // a tenth\n", "const a: f32 = 0x1.99999ap-4; // 1e-1, a tenth\n"),
    ("const float a = -0.7;\n", "const a: f32 = -0x1.666666p-1; // -0.7\n"),
    ("struct s { float a, b; t c; };\n", "struct s { a: f32, b: f32, c: t }\n"),
    ("struct s\n{\n    float a; // first\n    t b;\n};\n", "struct s\n{\n    a: f32, // first\n    b: t,\n}\n"),
    ("#ifndef N\n#define N 8\n#endif\nstruct s { t c[N]; float a; };\n", "const n: i32 = 8;\nstruct s { c: array<t, n>, a: f32 }\n"),
    ("s f(s x)\n{\n    for (int i = 0; i < 4; ++i) x.c[i].a = x.c[i + 1].a;\n    return x;\n}\n",
     "fn f(given_x: s) -> s\n{\n    var x = given_x;\n    for (var i = 0; i < 4; i++) { x.c[i].a = x.c[i + 1].a; }\n    return x;\n}\n"),
    ("float f(float x) { return x; }\n", "fn f(x: f32) -> f32 { return x; }\n"),
    # Declared once, assigned later, a struct filled; a parameter that is assigned.
    ("s f(float x)\n{\n    float y = x * 2.0;\n    float z = y;\n    z = y;\n    s r;\n    r.a = z;\n    return r;\n}\n",
     "fn f(x: f32) -> s\n{\n    let y = x * 2.0;\n    var z = y;\n    z = y;\n    var r: s;\n    r.a = z;\n    return r;\n}\n"),
    ("s f(s x)\n{\n    x.a = 1.0;\n    return x;\n}\n",
     "fn f(given_x: s) -> s\n{\n    var x = given_x;\n    x.a = 1.0;\n    return x;\n}\n"),
    ("float f(float x)\n{\n    for (int i = 0; i < 4; ++i) x = x + float(i);\n    return x;\n}\n",
     "fn f(given_x: f32) -> f32\n{\n    var x = given_x;\n    for (var i = 0; i < 4; i++) { x = x + f32(i); }\n    return x;\n}\n"),
    ("float f(float x)\n{\n    bool m = x < 1.0;\n    if (m) {\n        return x;\n    }\n    return 1.0;\n}\n",
     "fn f(x: f32) -> f32\n{\n    let m = x < 1.0;\n    if (m) {\n        return x;\n    }\n    return 1.0;\n}\n"),
    # Names that end in a digit: of what is defined, in comments too, and of members; not of variables, nor of files.
    ("const float a1 = 0.5; // a1 of a1.h, b1\nstruct s4 { float b1, c; };\nfloat f2(s4 x1)\n{\n    float b1 = x1.b1;\n"
     "    return b1 * a1;\n}\n",
     "const a1_: f32 = 0.5; // a1_ of a1.h, b1\nstruct s4_ { b1_: f32, c: f32 }\nfn f2_(x1: s4_) -> f32\n{\n    let b1 = x1.b1_;\n"
     "    return b1 * a1_;\n}\n"),
    # Words beyond 120 columns begin the next line of a comment, unless a field or a list is there.
    (f"/// {'x' * 112} two three\n/// four\nconst float a = 0.5;\n", f"/// {'x' * 112} two\n/// three four\nconst a: f32 = 0.5;\n"),
    (f"/// {'x' * 112} two three\n/// NaN: lit\nconst float a = 0.5;\n",
     f"/// {'x' * 112} two\n/// three\n/// NaN: lit\nconst a: f32 = 0.5;\n"),
    (f"// {'x' * 115} two\nconst float a = 0.5;\n", f"// {'x' * 115}\n// two\nconst a: f32 = 0.5;\n"),
    # A parameter whose elements are read by a variable.
    ("float f(s x)\n{\n    float y = x.c[0];\n    for (int i = 0; i < 4; ++i) y = y + x.c[i].a0;\n    return y;\n}\n",
     "fn f(given_x: s) -> f32\n{\n    var x = given_x;\n    var y = x.c[0];\n"
     "    for (var i = 0; i < 4; i++) { y = y + x.c[i].a0_; }\n    return y;\n}\n"),
]
REFUSED = [
    "float f(float x) { return x < 0.0 ? x : 1.0; }\n",
    "float f(float x[4]) { return x[0]; }\n",
    "float f(float x)\n{\n    while (x < 1.0) x = x + x;\n    return x;\n}\n",
    "float f(float x)\n{\n    float y, z;\n    return x;\n}\n",
    "#define A 1\n",
    "float f(float x) { return gnomon_unknown(x); }\n",
]


def body(text):
    return text.split("// numerics/a.h ---\n")[1]


def main():
    failed = 0
    for glsl, wanted in TRANSLATIONS:
        got = body(translated(HEAD + glsl))
        if got != wanted:
            failed += 1
            print(f"{glsl}became\n{got}not\n{wanted}")
    for glsl in REFUSED:
        try:
            print(f"{glsl}became\n{body(translated(HEAD + glsl))}")
            failed += 1
        except DialectError:
            pass
    print(f"{len(TRANSLATIONS) + len(REFUSED)} cases, {failed} failed")
    sys.exit(failed > 0)


main()
