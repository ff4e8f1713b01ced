#!/usr/bin/env python3
"""A dispatching shader around every kernel: reads rows of numbers in the blocks of kernel_call.hpp, calls, writes.

usage: shaders.py LANGUAGE OUTPUT TABLE INCLUDE    LANGUAGE is a key of LANGUAGES, INCLUDE the folder that holds gnomon/

glsl, hlsl: for each kernel OUTPUT/KERNEL.spv, as the compiler gives it, and OUTPUT/KERNEL.exact.spv, bound to the text's
    arithmetic (exact_arithmetic.py); then OUTPUT/modules, the kernels' names.
naga: KERNEL.spv alone, from ESSL 310, every operation kept (kept.py): naga turns it into WGSL, which has no decorations.
essl: OUTPUT/KERNEL.comp, one text for each kernel, precise throughout, and then OUTPUT/modules too.
essl300: the same as OUTPUT/KERNEL.frag, for OpenGL ES 3.0 and WebGL 2, which have no compute shaders: fragment_route in route.hpp
    says where a fragment finds its numbers. A text holds the headers that its kernel needs.
essl300_kept: the same, every operation kept.
glsl_fragment: the same for Vulkan, also as OUTPUT/KERNEL.spv, of which translators make texts for OpenGL.
opencl, metal, wgsl: OUTPUT/kernels.cl, .metal, .wgsl, one text with a function parity_KERNEL for each kernel; in WGSL every
    operation is kept, unless it is wgsl_plain.

Where a language knows no #include, the kernels come from its package.
"""
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Callable, NamedTuple

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests/support"), str(ROOT / "shaders")]
import kernels
import exact_arithmetic
from kept import kept
from package import Packager, closure
from precise import precise
from wgsl import spelled

BLOCK = 64 # block_rows of kernel_call.hpp
GLSLANG = ["glslangValidator", "-V", "--target-env", "vulkan1.1"]


class Language(NamedTuple):
    ending: str
    head: str # of the text, once
    entry: str # of the function, which knows group and lane
    struct: str = "{}"
    load: str = "x[{}]"
    store: str = "y[{}] = {}"
    call: str = "{}"
    declare: str = "{} {}"
    package: str = "" # what holds the kernels where there is no #include
    name: Callable = str # of a struct, as the package has it
    spelled: Callable = str # the headers' names, as the language has them
    changed: Callable = str # what becomes of the package's text
    partly: bool = False # only the headers that a kernel needs, of the package
    compiler: list = [] # to SPIR-V, one module per kernel
    exact: bool = False # a module bound to the text's arithmetic, too


def spelled_in_wgsl(text):
    return re.sub(r"[A-Za-z]\w*", lambda word: spelled(word[0]), text)


GLSL_HEAD = "#version 450\n#extension GL_GOOGLE_include_directive : require\n"
GLSL_BUFFERS = """layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { uint x[]; };
layout(std430, binding = 1) buffer Outputs { uint y[]; };
"""
GLSL_ENTRY = "void main()\n{\n    uint group = gl_WorkGroupID.x, lane = gl_LocalInvocationIndex;"

# A fragment writes four of a row's results.
FRAGMENT = """precision highp float;
precision highp int;
uniform highp usampler2D x;
layout(location = 0) out uvec4 y;
float number_at(uint i) { return uintBitsToFloat(texelFetch(x, ivec2(i & 2047u, i >> 11u), 0).x); }
"""
FRAGMENT_ENTRY = """void main()
{
    uint fragment = uint(gl_FragCoord.y) * 2048u + uint(gl_FragCoord.x), row = fragment / PARTSu, part = fragment % PARTSu;
    uint group = row / 64u, lane = row % 64u;
    y = uvec4(0u);"""
FRAGMENT_STORE = "if (part == {2}u / 4u) y[{2} % 4] = floatBitsToUint({1})"
# For naga, which reads no texture and sampler in one.
SEPARATE = "#extension GL_EXT_samplerless_texture_functions : require\n"
TEXTURE = "layout(binding = 0) uniform utexture2D"

LANGUAGES = {
    "glsl": Language(".comp", GLSL_HEAD + GLSL_BUFFERS, GLSL_ENTRY, load="uintBitsToFloat(x[{}])",
        store="y[{}] = floatBitsToUint({})", compiler=GLSLANG, exact=True),
    "hlsl": Language(".hlsl", """[[vk::binding(0)]] StructuredBuffer<uint> x;
[[vk::binding(1)]] RWStructuredBuffer<uint> y;
""", "[numthreads(64, 1, 1)] void main(uint3 groups : SV_GroupID, uint lane : SV_GroupIndex)\n{\n    uint group = groups.x;",
        load="asfloat(x[{}])", store="y[{}] = asuint({})", compiler=GLSLANG + ["-D", "-Od", "-DGNOMON_HLSL", "-e", "main", "-S", "comp"],
        exact=True),
    "opencl": Language(".cl", "#pragma OPENCL FP_CONTRACT OFF\n",
        "kernel __attribute__((reqd_work_group_size(64, 1, 1))) void parity_{}(global const float* x, global float* y)\n"
        "{{\n    uint group = get_group_id(0), lane = get_local_id(0);", struct="struct {}"),
    "metal": Language(".metal", "#include <metal_stdlib>\n",
        "kernel void parity_{}(device const float* x [[buffer(0)]], device float* y [[buffer(1)]],\n"
        "                      uint group [[threadgroup_position_in_grid]], uint lane [[thread_index_in_threadgroup]])\n{{",
        struct="gnomon::{}", call="gnomon::{}"),
    "essl": Language(".comp", "#version 320 es\n" + GLSL_BUFFERS, GLSL_ENTRY, load="uintBitsToFloat(x[{}])",
        store="y[{}] = floatBitsToUint({})", package="gnomon.glsl", changed=precise),
    "essl300": Language(".frag", "#version 300 es\n" + FRAGMENT, FRAGMENT_ENTRY, load="number_at({})",
        store=FRAGMENT_STORE, package="gnomon.glsl", partly=True),
    "glsl_fragment": Language(".frag", GLSL_HEAD + SEPARATE + FRAGMENT.replace("uniform highp usampler2D", TEXTURE), FRAGMENT_ENTRY,
        load="number_at({})", store=FRAGMENT_STORE, compiler=GLSLANG),
    "naga": Language(".comp", "#version 310 es\n" + GLSL_BUFFERS, GLSL_ENTRY, load="uintBitsToFloat(x[{}])",
        store="y[{}] = floatBitsToUint({})", package="gnomon.glsl", changed=kept, compiler=GLSLANG),
    "wgsl": Language(".wgsl", """alias uint = u32;
alias float = f32;
@group(0) @binding(0) var<storage, read> x: array<u32>;
@group(0) @binding(1) var<storage, read_write> y: array<u32>;
""", "@compute @workgroup_size(64)\nfn parity_{}(@builtin(workgroup_id) groups: vec3<u32>, @builtin(local_invocation_index) lane: u32)\n"
        "{{\n    let group = groups.x;", load="bitcast<f32>(x[{}])", store="y[{}] = bitcast<u32>({})", declare="var {1}: {0}",
        package="gnomon.wgsl", spelled=spelled_in_wgsl, changed=kept),
}


def kept_with_masks(text):
    """Every operation kept, and every comparison and absolute value: Mesa makes minima of choices and of pairs of comparisons,
    the opposite of a negated one, and x != 0 of 0 < |x|. All of these lose a NaN."""
    choice, absolute = "{ return mask ? a : b; }\n", "{ return abs(a); }"
    assert choice in text and absolute in text
    text = kept(text, "gnomon_seen({})").replace(absolute, "{ return intBitsToFloat(floatBitsToInt(a) & 0x7fffffff); }")
    return text.replace(choice, choice + "bool gnomon_seen(bool mask) { return (int(mask) + 1) * 3 > 4; }\n")


LANGUAGES["essl300_kept"] = LANGUAGES["essl300"]._replace(changed=kept_with_masks)
LANGUAGES["wgsl_plain"] = LANGUAGES["wgsl"]._replace(changed=str)


def type_of(language, name):
    return "float" if name == "Real" else language.struct.format(language.spelled(language.name(name)))


def function(language, headers, kernel):
    """The function that moves one row through the kernel."""
    outputs = headers.numbers(kernel.result)
    entry = language.entry.format(kernel.name) if language.entry.count("{}") else language.entry
    lines = [entry.replace("PARTS", str((len(outputs) + 3) // 4)),
             f"    {language.declare.format('uint', 'i')} = group * {BLOCK * headers.inputs(kernel)}u + lane;",
             f"    {language.declare.format('uint', 'o')} = group * {BLOCK * len(outputs)}u + lane;"]
    column = 0
    for k, parameter in enumerate(kernel.parameters):
        lines.append(f"    {language.declare.format(type_of(language, parameter), f'a{k}')};")
        for number in headers.numbers(parameter):
            lines.append(f"    a{k}{language.spelled(number)} = {language.load.format(f'i + {BLOCK * column}u')};")
            column += 1
    arguments = ", ".join(f"a{k}" for k in range(len(kernel.parameters)))
    result = language.declare.format(type_of(language, kernel.result), "r")
    lines.append(f"    {result} = {language.call.format(language.spelled(kernel.name))}({arguments});")
    lines += [f"    {language.store.format(f'o + {BLOCK * j}u', f'r{language.spelled(number)}', j)};" for j, number in enumerate(outputs)]
    return "\n".join(lines) + "\n}\n"


def text_around(language, headers, some, packages):
    includes = "".join(dict.fromkeys(f'#include "{kernel.header}"\n' for kernel in some))
    functions = "\n".join(function(language, headers, kernel) for kernel in some)
    return language.head + language.changed(packages.get(language.package, includes)) + functions


def part_of(package, names):
    """The package without the sections about headers of other names."""
    sections = re.split(r"^(?=// \S+\.h(?:,.*)? -+$)", package, flags=re.MULTILINE)
    kept = [text for text in sections[1:] if re.match(r"// (\S+\.h)", text)[1] in names]
    return "".join([sections[0], *kept[:-1], kept[-1].removesuffix("#endif\n").rstrip() + "\n\n#endif\n"])


def compile_module(language, source, include):
    module = source.with_suffix(".spv")
    run = subprocess.run([*language.compiler, f"-I{include}", "-o", module, source], capture_output=True, text=True)
    if run.returncode:
        raise ValueError(f"{source}: {next((line for line in run.stdout.splitlines() if 'ERROR' in line), run.stderr)}")
    if language.exact:
        exact_arithmetic.rewrite(module, source.with_suffix(".exact.spv"))


def main():
    language, output, table, include = LANGUAGES[sys.argv[1]], *map(Path, sys.argv[2:])
    headers, _ = kernels.read(table, [h for h in include.rglob("*.h") if h.parent.name != "portable"])
    output.mkdir(parents=True, exist_ok=True)
    packages = {}
    if language.package:
        packager = Packager(include)
        packages, language = dict(packager.files()), language._replace(name=packager.name)
    if "{}" in language.entry:
        text = text_around(language, headers, headers.kernels, packages)
        (output / ("kernels" + language.ending)).write_text(text)
        return
    sources = []
    for kernel in headers.kernels:
        sources.append(output / (kernel.name + language.ending))
        some = packages
        if language.partly:
            needed = closure(packager.headers, [kernel.header.removeprefix("gnomon/")])
            some = {language.package: part_of(packages[language.package], [header.name for header in needed])}
        sources[-1].write_text(text_around(language, headers, [kernel], some))
    with ThreadPoolExecutor() as pool:
        list(language.compiler and pool.map(lambda source: compile_module(language, source, include), sources))
    (output / "modules").write_text("".join(f"{source.stem}\n" for source in sources))


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError, subprocess.CalledProcessError) as error:
        print(f"shaders.py: {error}", file=sys.stderr)
        sys.exit(2)
