#!/usr/bin/env python3
"""The headers and the CUDA package by NVRTC, which has no standard library, and by nvcc, also with fast mathematics.

usage: cuda.py INCLUDE PACKAGES    prints one line for each fault; exit code 1 if there is any, 77 without NVRTC and nvcc

INCLUDE is the folder that holds gnomon/, PACKAGES the one that shaders/package.py wrote. NVRTC compiles every kernel, and
refuses fast mathematics in the library's words. nvcc does not tell, so exact products and roots must be instructions that
it leaves alone. Nothing runs: no GPU is needed.
"""
import ctypes
import ctypes.util
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "support"))
import kernels

CUDA = Path("/usr/local/cuda")
OPTIONS = ["--gpu-architecture=compute_90", "-std=c++20"]
EXACT = """
extern "C" __global__ void product(float* p) { p[0] = p[1] - gnomon::gnomon_product(p[2], p[3]); }
extern "C" __global__ void root(float* p) { p[0] = gnomon::gnomon_sqrt(p[1]); }
extern "C" __global__ void rounded(float* p) { p[0] = gnomon::nearest_integer(p[1]); }
"""
INSTRUCTIONS = {"product": ["mul.rn", "sub"], "root": ["sqrt.rn"], "rounded": ["add", "add"]}


class Nvrtc:
    def __init__(self):
        self.library = None
        for name in (CUDA / "lib64/libnvrtc.so", ctypes.util.find_library("nvrtc")):
            try:
                self.library = self.library or ctypes.CDLL(str(name))
            except OSError:
                pass

    def compiled(self, text, options):
        """The PTX of a unit, or nothing, and what the compiler had to say."""
        library, program = self.library, ctypes.c_void_p()
        library.nvrtcCreateProgram(ctypes.byref(program), text.encode(), b"unit.cu", 0, None, None)
        array = (ctypes.c_char_p * len(options))(*[option.encode() for option in options])
        failed = library.nvrtcCompileProgram(program, len(options), array)
        answers = []
        for what in ("ProgramLog", "PTX"):
            size = ctypes.c_size_t()
            getattr(library, f"nvrtcGet{what}Size")(program, ctypes.byref(size))
            answer = ctypes.create_string_buffer(size.value)
            getattr(library, f"nvrtcGet{what}")(program, answer)
            answers.append(answer.value.decode())
        library.nvrtcDestroyProgram(ctypes.byref(program))
        return "" if failed else answers[1], answers[0]


def instruction_faults(what, ptx):
    """A sentence for each kernel of EXACT whose floating-point instructions are not those expected."""
    for name, expected in INSTRUCTIONS.items():
        body = re.search(rf"\.entry {name}\(.*?^\}}", ptx, re.DOTALL | re.MULTILINE)
        found = re.findall(r"^\t([a-z.]+)\.f32\b", body[0], re.MULTILINE) if body else ["no kernel"]
        found = [word.removesuffix(".ftz") for word in found if not re.match(r"ld|st|mov", word)]
        if found != expected:
            yield f"{what}: {name} is {', '.join(found)} instead of {', '.join(expected)}"


def nvrtc_faults(nvrtc, include, packages):
    names = kernels.table(HERE.parent / "support/kernels.txt")
    headers = sorted(path.relative_to(include).as_posix() for path in include.rglob("*.h") if path.parent.name != "portable")
    uses = "".join(f"    *p++ = (void*)&gnomon::{name}<float>;\n" for name in names)
    every = f'extern "C" __global__ void use(void** p)\n{{\n{uses}}}\n'
    for what, begin, folder in [("headers", "".join(f'#include "{name}"\n' for name in headers), include),
                                ("gnomon.cuh", '#include "gnomon.cuh"\n', packages)]:
        options = [*OPTIONS, f"-I{folder}"]
        ptx, said = nvrtc.compiled(begin + every + EXACT, options)
        yield from instruction_faults(f"NVRTC, {what}", ptx) if ptx else [f"NVRTC, {what}: {said[:300]}"]
        ptx, said = nvrtc.compiled(begin, [*options, "--use_fast_math"])
        if len(re.findall("error: ", said)) != 1 or "gnomon: fast mathematics voids" not in said:
            yield f"NVRTC, {what}, --use_fast_math: not refused, or not in these words alone: {said[:300]}"
    ptx, said = nvrtc.compiled('#include "moments4.cuh"\n', [*OPTIONS, f"-I{packages}"])
    if not ptx:
        yield f"NVRTC, moments4.cuh: {said[:300]}"


def nvcc_faults(nvcc, packages):
    with tempfile.TemporaryDirectory() as folder:
        unit, ptx = Path(folder) / "unit.cu", Path(folder) / "unit.ptx"
        unit.write_text('#include "gnomon.cuh"\n' + EXACT)
        for flags in ([], ["--use_fast_math"]):
            run = subprocess.run([nvcc, *OPTIONS, *flags, f"-I{packages}", "-ptx", str(unit), "-o", str(ptx)],
                                 capture_output=True, text=True)
            what = " ".join(["nvcc", *flags])
            if run.returncode:
                yield f"{what}: {run.stderr[:300]}"
            else:
                yield from instruction_faults(what, ptx.read_text())


def main():
    include, packages = map(Path, sys.argv[1:])
    nvrtc, nvcc = Nvrtc(), shutil.which("nvcc", path=f"{CUDA}/bin:/usr/bin:/usr/local/bin")
    if not nvrtc.library and not nvcc:
        print("neither NVRTC nor nvcc is there: nothing was compiled for CUDA")
        sys.exit(77)
    faults = list(nvrtc_faults(nvrtc, include, packages)) if nvrtc.library else []
    faults += nvcc_faults(nvcc, packages) if nvcc else []
    print("\n".join(faults + [f"NVRTC {'there' if nvrtc.library else 'absent'}, "
                              f"nvcc {'there' if nvcc else 'absent'}: {len(faults)} faults"]))
    sys.exit(bool(faults))


main()
