#!/usr/bin/env python3
"""No pack kernel calls anything: one that is not inlined to the last operation costs more than its arithmetic. Lists of
packs are kilobytes, and where they are copied clang calls memcpy, which is no operation.

usage: calls.py SOURCE COMPILER [FLAG...]    compiles, disassembles, prints every kernel with a call; exit code 1 if any
"""
import re
import subprocess
import sys
import tempfile

CONTROL = "the control"
COPY = re.compile(r".*\t(?:call|jmp) .*\n.*R_X86_64_PLT32\tmem(?:cpy|move|set)-.*\n")


def disassembly(source, command):
    with tempfile.NamedTemporaryFile(suffix=".o") as target:
        subprocess.run([*command, "-c", source, "-o", target.name], check=True)
        return subprocess.run(["objdump", "--disassemble", "--reloc", "--demangle", "--no-show-raw-insn", target.name],
                              check=True, capture_output=True, text=True).stdout


def kernels(text):
    """The functions around the kernels, as (name and Real, body)."""
    for head, body in re.findall(r"^[0-9a-f]+ <(.*around<.+)>:\n((?:.+\n)+)", text, re.MULTILINE):
        if "control(double)" in head:
            yield CONTROL, body
        else:
            kernel = re.search(r"gnomon::(\w+)<(xsimd::batch<\w+, [^()]*?>)(?:, \d+)?, \2 ?>\(", head)
            yield " for ".join(kernel.groups()), body


def leaves(body):
    """Whether control goes elsewhere, but to copy: by a call, or by a jump to a symbol (a tail call)."""
    return re.search(r"\tcall|R_X86_64_PLT32", COPY.sub("", body))


def main():
    source, *command = sys.argv[1:]
    found = dict(kernels(disassembly(source, command)))
    calling = {name for name, body in found.items() if leaves(body)}
    for name in sorted(calling - {CONTROL}):
        print(f"a call in {name}")
    print(f"{len(found) - 1} kernels disassembled")
    if CONTROL not in calling:
        sys.exit("the control's call was not found")
    sys.exit(calling != {CONTROL} or len(found) < 2)


if __name__ == "__main__":
    main()
