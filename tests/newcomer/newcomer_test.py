#!/usr/bin/env python3
"""Walks a newcomer's paths in a copy of the clone, by what README.md and docs/shaders.md say: docs/testing.md has the list.

usage: newcomer_test.py OUTPUT PATH [COMMAND...]

PATH is cpp, vulkan, webgl2 or wgsl. COMMAND is the browser of webgl2 and the checker of wgsl. webgl2 leaves its site and a
picture in OUTPUT/webgl2. Exit code 77 where the machine lacks something.
"""
import base64
import functools
import http.server
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
from html import unescape
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKIPPED = 1 if os.environ.get("CI") == "true" else 77
CONSUMER = """cmake_minimum_required(VERSION 3.22)
project(newcomer LANGUAGES CXX)
find_package(gnomon REQUIRED)
add_executable(newcomer main.cpp)
target_link_libraries(newcomer PRIVATE gnomon::gnomon)
"""
# A square in front of a plane: the receivers behind the square are in shadow, those far from it are lit.
MAIN = """
#include <cstdio>
#include <vector>

int main()
{
    std::vector<map::texel> memory(64 * 64, map::clear()), more(memory);
    for (int y = 16; y < 48; ++y)
        for (int x = 16; x < 48; ++x) memory[std::size_t(y * 64 + x)] = store(0.0f);
    const texels shadow_map(memory, 64, 64), scratch(more, 64, 64);
    const float hard = hard_shadow(shadow_map(32, 32), 0.9f);
    filter(shadow_map, scratch);
    const float inside = soft_shadow(shadow_map, 32, 32, 0.9f), edge = soft_shadow(shadow_map, 16, 32, 0.9f);
    const float outside = soft_shadow(shadow_map, 4, 32, 0.9f), lit = soft_shadow(shadow_map, 32, 32, 0.0f);
    std::printf("%f %f %f %f %f\\n", double(hard), double(inside), double(edge), double(outside), double(lit));
    return hard > 0.99f && inside > 0.99f && edge > 0.4f && edge < 0.6f && outside < 0.001f && lit < 0.001f ? 0 : 1;
}
"""


def skip(why):
    print(f"newcomer: {why}")
    sys.exit(SKIPPED)


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    if done.returncode == 77:
        skip(done.stdout + done.stderr)
    assert done.returncode == 0, f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}"
    return done.stdout


def clone(folder):
    """A copy of the files that a clone of this working tree would have."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "-co", "--exclude-standard"], capture_output=True, text=True)
    if listed.returncode:
        skip("no git, or not a clone")
    for name in filter(None, listed.stdout.split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, folder / name)
    return folder


def examples(copy, document, section):
    """The indented texts of a section, each alone."""
    page = (copy / document).read_text().split(f"# {section}\n")[1].split("\n#")[0]
    blocks = re.findall(r"^    .*\n(?:(?:    .*)?\n)*", page + "\n", re.MULTILINE)
    return [re.sub(r"^    ", "", block, flags=re.MULTILINE).rstrip() + "\n" for block in blocks]


def cpp(copy, folder):
    """README's C++ by find_package in a prefix of one's own: installed without a build."""
    run("cmake", "-S", copy, "-B", folder / "build")
    run("cmake", "--install", folder / "build", "--prefix", folder / "prefix")
    project = folder / "project"
    project.mkdir()
    (project / "CMakeLists.txt").write_text(CONSUMER)
    (project / "main.cpp").write_text(examples(copy, "README.md", "Use it in C++")[0] + MAIN)
    run("cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}")
    run("cmake", "--build", project / "build")
    print(run(project / "build/newcomer"), end="")


def vulkan(copy, folder):
    """Two packages copied out of the clone, beside the fragment shaders of docs/shaders.md."""
    if not shutil.which("glslangValidator"):
        skip("no glslangValidator (glslang-tools)")
    for i, text in enumerate(examples(copy, "docs/shaders.md", "Vulkan")):
        for name in re.findall(r'^#include "(.*)"$', text, re.MULTILINE):
            shutil.copy(copy / "shaders/packages" / name, folder)
        (folder / f"{i}.frag").write_text(text)
        run("glslangValidator", "-V", "-o", f"{i}.spv", f"{i}.frag", cwd=folder)
        if shutil.which("spirv-val"):
            run("spirv-val", f"{i}.spv", cwd=folder)


def wgsl(copy, folder, *checker):
    """Two techniques in one module, by the packager, to naga and to Tint."""
    run(sys.executable, "-B", copy / "shaders/package.py", "moments4", "variance", "--language", "wgsl", cwd=folder)
    assert [path.name for path in folder.iterdir()] == ["moments4_variance.wgsl"]
    print(run(*checker, folder), end="")


def webgl2(copy, folder, output, chromium):
    """A page with the ESSL of docs/shaders.md draws a shadow."""
    if not shutil.which(chromium):
        skip("no Chromium (chromium)")
    site = output / "webgl2"
    site.mkdir(parents=True, exist_ok=True)
    shutil.copy(copy / "tests/newcomer/page.html", site / "index.html")
    for name, text in zip(["write.frag", "read.frag"], examples(copy, "docs/shaders.md", "OpenGL and OpenGL ES"), strict=True):
        (site / name).write_text(text)
        for package in re.findall(r'^#include "(.*)"$', text, re.MULTILINE):
            shutil.copy(copy / "shaders/packages" / package, site)
    function = examples(copy, "docs/shaders.md", "WebGL 2")[0]
    (site / "pasted.js").write_text(f"export {function}")
    kernel = re.search(r"(\w+)_encode\(", (site / "write.frag").read_text())[1]
    numbers = re.search(rf"^\| `{kernel}` \|(.*)\|$", (copy / "docs/conventions.md").read_text(), re.MULTILINE)[1]
    (site / "clear.json").write_text(json.dumps([float(number) for number in numbers.split("|")]))

    quiet = type("quiet", (http.server.SimpleHTTPRequestHandler,), {"log_message": lambda *_: None})
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(quiet, directory=site))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    page = run(chromium, "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
               f"--user-data-dir={folder / 'profile'}", "--virtual-time-budget=20000", "--dump-dom",
               f"http://127.0.0.1:{server.server_port}/", timeout=120)
    server.shutdown()
    found = json.loads(unescape(re.search('<pre id="found">(.*?)</pre>', page, re.DOTALL)[1]))
    assert "failed" not in found, found
    picture = site / "picture.png"
    picture.write_bytes(base64.b64decode(found["picture"].partition(",")[2]))

    # 256 pixels, 2 to a texel: the square is from 64 to 192, the blur reaches 4 texels on either side of its edges.
    row = found["row"]
    print(f"{picture}: {row[::8]}")
    assert found["error"] == 0 and found["corner"] == 0, found
    assert max(row[:54] + row[202:]) == 0, "lit where no shadow reaches"
    assert min(row[76:180]) >= 250, "dark behind the middle of the square"
    assert row[54:76] == sorted(row[54:76]) and row[180:202] == sorted(row[180:202])[::-1], "the edges rise and fall"
    assert all(90 <= row[x] <= 165 for x in (63, 64, 191, 192)), "half a shadow at the edges"


def main():
    output, path, command = Path(sys.argv[1]), sys.argv[2], sys.argv[3:]
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        copy, work = Path(folder) / "clone", Path(folder) / "work"
        work.mkdir()
        clone(copy)
        {"cpp": cpp, "vulkan": vulkan, "wgsl": wgsl, "webgl2": lambda *a: webgl2(*a[:2], output, *a[2:])}[path](copy, work, *command)


main()
