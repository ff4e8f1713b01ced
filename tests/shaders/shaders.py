#!/usr/bin/env python3
"""A dispatching shader around every kernel: reads rows of numbers in the blocks of kernel_call.hpp, calls, writes.

usage: shaders.py LANGUAGE OUTPUT TABLE INCLUDE    LANGUAGE is a key of LANGUAGES, INCLUDE the folder that holds gnomon/

glsl, hlsl: OUTPUT/KERNEL.spv, one module per kernel, no operation of which may be contracted (no_contraction.py).
opencl, metal: OUTPUT/kernels.cl, .metal, one text with a function parity_KERNEL for each kernel.
"""
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).parent.parent / "support"))
import kernels
import no_contraction

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
    compiler: list = [] # to SPIR-V, one module per kernel


LANGUAGES = {
    "glsl": Language(".comp", """#version 450
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { uint x[]; };
layout(std430, binding = 1) buffer Outputs { uint y[]; };
""", "void main()\n{\n    uint group = gl_WorkGroupID.x, lane = gl_LocalInvocationIndex;", load="uintBitsToFloat(x[{}])",
        store="y[{}] = floatBitsToUint({})", compiler=GLSLANG),
    "hlsl": Language(".hlsl", """[[vk::binding(0)]] StructuredBuffer<uint> x;
[[vk::binding(1)]] RWStructuredBuffer<uint> y;
""", "[numthreads(64, 1, 1)] void main(uint3 groups : SV_GroupID, uint lane : SV_GroupIndex)\n{\n    uint group = groups.x;",
        load="asfloat(x[{}])", store="y[{}] = asuint({})", compiler=GLSLANG + ["-D", "-DGNOMON_HLSL", "-e", "main", "-S", "comp"]),
    "opencl": Language(".cl", "#pragma OPENCL FP_CONTRACT OFF\n",
        "kernel __attribute__((reqd_work_group_size(64, 1, 1))) void parity_{}(global const float* x, global float* y)\n"
        "{{\n    uint group = get_group_id(0), lane = get_local_id(0);", struct="struct {}"),
    "metal": Language(".metal", "#include <metal_stdlib>\n",
        "kernel void parity_{}(device const float* x [[buffer(0)]], device float* y [[buffer(1)]],\n"
        "                      uint group [[threadgroup_position_in_grid]], uint lane [[thread_index_in_threadgroup]])\n{{",
        struct="gnomon::{}<float>", call="gnomon::{}"),
}


def type_of(language, name):
    return "float" if name == "Real" else language.struct.format(name)


def function(language, headers, kernel):
    """The function that moves one row through the kernel."""
    outputs = headers.numbers(kernel.result)
    lines = [language.entry.format(kernel.name) if language.entry.count("{}") else language.entry,
             f"    uint i = group * {BLOCK * headers.inputs(kernel)}u + lane, o = group * {BLOCK * len(outputs)}u + lane;"]
    column = 0
    for k, parameter in enumerate(kernel.parameters):
        lines.append(f"    {type_of(language, parameter)} a{k};")
        for number in headers.numbers(parameter):
            lines.append(f"    a{k}{number} = {language.load.format(f'i + {BLOCK * column}u')};")
            column += 1
    arguments = ", ".join(f"a{k}" for k in range(len(kernel.parameters)))
    lines.append(f"    {type_of(language, kernel.result)} r = {language.call.format(kernel.name)}({arguments});")
    lines += [f"    {language.store.format(f'o + {BLOCK * j}u', f'r{number}')};" for j, number in enumerate(outputs)]
    return "\n".join(lines) + "\n}\n"


def text_around(language, headers, some):
    includes = "".join(dict.fromkeys(f'#include "{kernel.header}"\n' for kernel in some))
    return language.head + includes + "\n".join(function(language, headers, kernel) for kernel in some)


def compile_module(language, source, include):
    module = source.with_suffix(".spv")
    run = subprocess.run([*language.compiler, f"-I{include}", "-o", module, source], capture_output=True, text=True)
    if run.returncode:
        raise ValueError(f"{source}: {next((line for line in run.stdout.splitlines() if 'ERROR' in line), run.stderr)}")
    no_contraction.rewrite(module)


def main():
    language, output, table, include = LANGUAGES[sys.argv[1]], *map(Path, sys.argv[2:])
    headers, _ = kernels.read(table, [h for h in include.rglob("*.h") if h.parent.name != "portable"])
    output.mkdir(parents=True, exist_ok=True)
    if not language.compiler:
        (output / ("kernels" + language.ending)).write_text(text_around(language, headers, headers.kernels))
        return
    sources = []
    for kernel in headers.kernels:
        sources.append(output / (kernel.name + language.ending))
        sources[-1].write_text(text_around(language, headers, [kernel]))
    with ThreadPoolExecutor() as pool:
        list(pool.map(lambda source: compile_module(language, source, include), sources))


if __name__ == "__main__":
    try:
        main()
    except (OSError, ValueError, subprocess.CalledProcessError) as error:
        print(f"shaders.py: {error}", file=sys.stderr)
        sys.exit(2)
