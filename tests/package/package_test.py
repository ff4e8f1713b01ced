#!/usr/bin/env python3
"""Takes gnomon as users do: package_test.py PREFIX [Package.test_NAME]

PREFIX holds an installation, which is moved before each use of it.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PREFIX = Path(sys.argv.pop(1)).resolve()
VERSION = re.search(r"^## \[(\d+\.\d+\.\d+)\]", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)[1]

# Variables that may differ once gnomon is taken: its own, those of CMake's modules, and those of the function that writes them.
WELCOME = re.compile(r"(gnomon|GNOMON|FETCHCONTENT|CMAKE_INSTALL|_GNUInstallDirs|__cmake)_|file$|ARGV")


def run(*command, **environment):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False,
                          env=os.environ | environment)


class Package(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()
        self.prefix = self.folder / "moved"

    def succeeds(self, *command, **environment):
        done = run(*command, **environment)
        self.assertEqual(done.returncode, 0, f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
        return done.stdout

    def configured(self, project, *options):
        """The build folder of a project."""
        build = self.folder / project.name
        self.succeeds("cmake", "-G", "Ninja", "-S", project, "-B", build, *options)
        return build

    def installed(self):
        """A copy of PREFIX elsewhere."""
        shutil.copytree(PREFIX, self.prefix)
        return self.prefix

    def consumer(self, *options):
        """Configures the consumer, builds and runs its programs; its variables must be as they were."""
        build = self.configured(HERE / "consumer", *options)
        before, after = (dict(line.partition("=")[::2] for line in (build / file).read_text().splitlines())
                         for file in ("before.txt", "after.txt"))
        changed = {name for name in before | after if before.get(name) != after.get(name) and not WELCOME.match(name)}
        self.assertEqual(changed, set())
        self.succeeds("cmake", "--build", build)
        for program in ("consumer", "packaged_consumer"):
            self.assertIn("shadow intensity 0.", self.succeeds(build / program))
        return build

    def test_nothing_is_looked_for(self):
        trace = self.folder / "trace"
        self.configured(ROOT, "--trace", "--trace-format=json-v1", f"--trace-redirect={trace}")
        calls = [json.loads(line) for line in trace.read_text().splitlines()[1:]]
        ours = [call for call in calls if Path(call["file"]).is_relative_to(ROOT)]
        self.assertTrue(ours)
        self.assertEqual([call for call in ours if re.match("find_|execute_process", call["cmd"].lower())], [])

    def test_everything_is_installed(self):
        for folder, installed in {"include/gnomon": "include/gnomon", "shaders/packages": "share/gnomon/shaders"}.items():
            sources = {path.relative_to(ROOT / folder): path.read_bytes() for path in (ROOT / folder).rglob("*.*")}
            self.assertTrue(sources)
            for name, content in sources.items():
                self.assertEqual(content, (PREFIX / installed / name).read_bytes(), name)
        licence = PREFIX / "share/licenses/gnomon/LICENSE"
        self.assertEqual(licence.read_text(), (ROOT / "LICENSE").read_text())

    def test_find_package(self):
        self.consumer("-DROUTE=find_package", f"-DCMAKE_PREFIX_PATH={self.installed()}")

    def test_add_subdirectory(self):
        self.consumer("-DROUTE=add_subdirectory", f"-DGNOMON_ROOT={ROOT}")

    def test_fetch_content(self):
        self.consumer("-DROUTE=FetchContent", f"-DGNOMON_ROOT={ROOT}")

    def test_build_folder(self):
        build = self.configured(ROOT)
        self.consumer("-DROUTE=find_package", f"-Dgnomon_DIR={build}")

    def test_exported_library(self):
        library = HERE / "exported_library"
        build = self.configured(library, f"-DGNOMON_ROOT={ROOT}", f"-DCMAKE_INSTALL_PREFIX={self.prefix}")
        self.succeeds("cmake", "--install", build)
        for options in ([f"-DCMAKE_PREFIX_PATH={self.prefix}"], [f"-Dshadows_DIR={build}", f"-Dgnomon_DIR={build / 'gnomon'}"]):
            application = self.configured(library / "application", f"-DMAIN={HERE}/consumer/main.cpp", *options)
            self.succeeds("cmake", "--build", application)
            self.assertIn("shadow intensity 0.", self.succeeds(application / "application"))
            shutil.rmtree(application)

    def test_folders(self):
        for data, headers in (("data/own", "headers/of/all"), (self.folder / "far/data", self.folder / "far/headers")):
            build = self.configured(ROOT, f"-DCMAKE_INSTALL_PREFIX={self.prefix}", f"-DCMAKE_INSTALL_INCLUDEDIR={headers}",
                                    f"-DCMAKE_INSTALL_DATADIR={data}")
            self.succeeds("cmake", "--install", build)
            self.assertTrue((self.prefix / headers / "gnomon/gnomon.h").exists())
            self.consumer("-DROUTE=find_package", f"-Dgnomon_DIR={self.prefix / data}/cmake/gnomon")
            self.pkg_config(self.prefix / data / "pkgconfig")
            for folder in self.folder.iterdir():
                shutil.rmtree(folder)

    def pkg_config(self, folder):
        """Compiles and runs the consumer by the words of gnomon.pc in a folder."""
        def said(*question):
            return self.succeeds("pkg-config", *question, "gnomon", PKG_CONFIG_PATH=str(folder)).split()

        self.assertEqual(said("--modversion"), [VERSION])
        for words in (said("--cflags"), [f"-I{said('--variable=shaders')[0]}"]):
            self.succeeds("g++", "-std=c++20", *words, HERE / "consumer/main.cpp", "-o", self.folder / "a.out")
            self.succeeds(self.folder / "a.out")
        (self.folder / "a.out").unlink()

    def test_pkg_config(self):
        self.pkg_config(self.installed() / "share/pkgconfig")

    def asked(self, words):
        """What CMake says to find_package(gnomon WORDS)."""
        project = self.folder / "asking"
        shutil.rmtree(project, ignore_errors=True)
        project.mkdir()
        (project / "CMakeLists.txt").write_text(
            f"cmake_minimum_required(VERSION 3.22)\nproject(asking NONE)\nfind_package(gnomon {words} CONFIG)\n"
            'message("found ${gnomon_FOUND} ${gnomon_VERSION}")\n')
        done = run("cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        return re.sub(r"\s+", " ", done.stderr)

    def test_version_and_components(self):
        self.installed()
        major, minor, patch = map(int, VERSION.split("."))
        for version in ("", f"{major}.{minor}", VERSION, f"{VERSION} EXACT"):
            self.assertIn(f"found 1 {VERSION}", self.asked(version))
        for version in (f"{major}.{minor + 1}", f"{major}.{minor}.{patch + 1}", f"{major + 1}"):
            self.assertIn("found 0", self.asked(version))
        self.assertIn("gnomon has no components, and so no 'soft'", self.asked("COMPONENTS soft"))
        self.assertIn("found 0", self.asked("COMPONENTS soft"))
        self.assertIn("found 1", self.asked("OPTIONAL_COMPONENTS soft"))

    def test_one_version(self):
        number = "".join(f"{int(part):02}" for part in VERSION.split("."))
        unit = f"#include <gnomon/gnomon.h>\nstatic_assert(GNOMON_VERSION == {int(number)});\n"
        (self.folder / "unit.cpp").write_text(unit)
        self.succeeds("g++", "-std=c++20", "-fsyntax-only", f"-I{ROOT}/include", self.folder / "unit.cpp")
        packages = list((PREFIX / "share/gnomon/shaders").glob("*.*"))
        self.assertTrue(packages)
        for package in packages:
            self.assertTrue(package.read_text().startswith(f"// Gnomon {VERSION}, "), package.name)
            if package.suffix != ".wgsl":
                self.assertIn(f"#define GNOMON_PACKAGE {int(number)} ", package.read_text())

    def test_cuda(self):
        nvcc = shutil.which("nvcc") or shutil.which("nvcc", path="/usr/local/cuda/bin")
        if not nvcc:
            print("no nvcc: CUDA is left out")
            sys.exit(77)
        build = self.configured(HERE / "cuda", f"-DCMAKE_PREFIX_PATH={self.installed()}", f"-DCMAKE_CUDA_COMPILER={nvcc}",
                                "-DCMAKE_CUDA_ARCHITECTURES=90", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON")
        self.succeeds("cmake", "--build", build)
        for command in json.loads((build / "compile_commands.json").read_text()):
            self.assertEqual("--fmad=false" in command["command"], "cuda_bit_exact.dir" in command["command"])


if __name__ == "__main__":
    unittest.main()
