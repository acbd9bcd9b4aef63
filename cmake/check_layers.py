#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks what the files of a source tree include against cmake/layers.cmake.

usage: check_layers.py SOURCE_DIR

- a library includes only libraries that layers.cmake allows, its tests also testing, and exec where
  they are tests of components, to run them;
- internal/ headers are included only by their own library;
- one robot does not include another, and no library includes a robot;
- the interface compiler, idl/, is a library like those of armature/, which do not include it;
- so is each folder of drives/, of which only robots and component libraries know, and python/, which nobody includes;
- public headers include the standard library, Eigen and Armature, nothing else;
- what layers.cmake allows is used, and ARCHITECTURE.md says the same;
- headers of the operating system are included only by platform/, by guard/, which stands in front
  of the C library, and by guardian/, whose process has nothing but that.
"""
import re
import sys
from pathlib import Path

LIBRARY_FOLDERS = ("armature/", "idl/", "drives/", "bridges/")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
RAW_TEXT = re.compile(r'R"(\w*)\(.*?\)\1"', re.DOTALL)
OPERATING_SYSTEM = re.compile(
    r"(sys|linux|asm|net|netinet|arpa|bits)/.*|"
    r"(aio|cpuid|dirent|dlfcn|errno|execinfo|fcntl|fnmatch|glob|grp|ifaddrs|link|malloc|mqueue|"
    r"netdb|poll|pthread|pwd|sched|semaphore|signal|spawn|strings|syslog|termios|ucontext|unistd|"
    r"wait|x86intrin|immintrin)\.h")
NEXT_TO_THE_SYSTEM = ("platform", "guard", "guardian")
TEST_ONLY = "testing"
USES_ALL = ("cli", TEST_ONLY)
ARROWS = re.compile(r"`(\w+) -> ([\w, \n]+)`")


def read_layers(source_dir):
    """library -> the set of libraries it may use."""
    text = (source_dir / "cmake/layers.cmake").read_text()
    return {name: set(uses.split()) for name, uses in re.findall(r'"(\w+):([^"]*)"', text)}


def closure(layers, library):
    """Everything a library may use, directly or through others."""
    found, pending = set(), [library]
    while pending:
        for used in layers.get(pending.pop(), set()) - found:
            found.add(used)
            pending.append(used)
    return found


class Tree:
    """The C++ files below a source directory and what each includes."""

    def __init__(self, source_dir):
        self.layers = read_layers(source_dir)
        self.map = (source_dir / "ARCHITECTURE.md").read_text()
        self.includes = {}
        for top in ("armature", "bridges", "drives", "idl", "python", "robots", "examples", "benchmarks", "tests"):
            for path in sorted((source_dir / top).rglob("*.?pp")):
                if "idl/testdata" in path.as_posix():
                    continue  # what the interface compiler is to write
                self.includes[path.relative_to(source_dir).as_posix()] = parse(path.read_text())
        self.public = self.find_public_headers()

    def find_public_headers(self):
        """Headers that a user sees: those outside internal/, and what they include."""
        pending = [path for path in self.includes if is_public_header(path)]
        found = set()
        while pending:
            path = pending.pop()
            if path not in found and path in self.includes:
                found.add(path)
                pending += [name for _, _, name in self.includes[path] if not is_test_code(name)]
        return found

    def problems(self):
        for path, includes in self.includes.items():
            for line, bracket, name in includes:
                reason = self.check(path, bracket, name)
                if reason:
                    yield f"{path}:{line}: error: {path} may not include {name}: {reason}"

    def unused(self):
        """What layers.cmake allows for nothing."""
        used = {}
        for path, includes in self.includes.items():
            if not is_test_code(path):
                used.setdefault(library_of(path), set()).update(library_of(name) for _, _, name in includes)
        for library, allowed in self.layers.items():
            for other in sorted(allowed - used.get(library, set())):
                if library not in USES_ALL:
                    yield f"cmake/layers.cmake: error: {library} may use {other}, and does not: remove it there"

    def untold(self):
        """Where ARCHITECTURE.md says otherwise than layers.cmake."""
        told = {name: set(re.findall(r"\w+", uses)) for name, uses in ARROWS.findall(self.map)}
        for library, allowed in self.layers.items():
            wanted = allowed - {"base"}
            if library in USES_ALL or not wanted or told.get(library) == wanted:
                continue
            yield (f"ARCHITECTURE.md: error: expected `{library} -> {', '.join(sorted(wanted))}`, "
                   f"as cmake/layers.cmake does")

    def check(self, path, bracket, name):
        if name.startswith(LIBRARY_FOLDERS):
            return self.check_own(path, name)
        if name.startswith("robots/"):
            return self.check_robot(path, name)
        if path.startswith(LIBRARY_FOLDERS) and not is_test_code(path):
            return self.check_foreign(path, bracket, name)
        return None

    def check_own(self, path, name):
        user, used = library_of(path), library_of(name)
        if user == used:
            return None
        if "/internal/" in name:
            return f"what is in internal/ belongs to {used} alone"
        if user is None:
            return None
        if user not in self.layers:
            return f"{user} is not in cmake/layers.cmake"
        allowed = self.layers[user]
        if is_test_code(path):
            allowed = self.allowed_in_tests(user)
        if used not in allowed:
            return f"{user} may use only {', '.join(sorted(allowed)) or 'the standard library'}"
        return None

    def allowed_in_tests(self, user):
        allowed = closure(self.layers, user) | {TEST_ONLY}
        if "component" in allowed:
            allowed |= {"exec"} | closure(self.layers, "exec")
        return allowed

    def check_robot(self, path, name):
        if path.startswith(("armature/", "bridges/", "drives/")):
            return "a library does not know the robots"
        if path.startswith("robots/") and path.split("/")[1] != name.split("/")[1]:
            return "one robot does not use another; what they share goes to armature/"
        return None

    def check_foreign(self, path, bracket, name):
        if library_of(path) not in NEXT_TO_THE_SYSTEM and OPERATING_SYSTEM.fullmatch(name):
            return "only armature/platform, guard and guardian include headers of the operating system"
        if path not in self.public or OPERATING_SYSTEM.fullmatch(name):
            return None
        if bracket == '"':
            return "write the whole path, as in \"armature/rt/latest.hpp\""
        if re.search(r"[./]", name) and not name.startswith("Eigen/"):
            return "users of this header would need it too; include it in a .cpp file or internal/"
        return None


def parse(text):
    # A program that is written by this one includes what it wants.
    text = RAW_TEXT.sub(lambda raw: "\n" * raw[0].count("\n"), text)
    return [(text.count("\n", 0, match.start(1)) + 1, match[1], match[2])
            for match in INCLUDE.finditer(text)]


def library_of(path):
    """The library a file belongs to; None for examples, benchmarks, tests across libraries, and
    component libraries that a test loads."""
    if "/testdata/" in path:
        return None
    top, _, rest = path.partition("/")
    if top in ("armature", "bridges", "drives"):
        return rest.split("/")[0]
    if top in ("idl", "python"):
        return top
    return "robots" if top == "robots" and not path.endswith("_test.cpp") else None


def is_test_code(path):
    return (path.endswith("_test.cpp") or path.startswith(f"armature/{TEST_ONLY}/")
            or Path(path).name.startswith("test_"))


def is_public_header(path):
    return (path.startswith(LIBRARY_FOLDERS) and path.endswith(".hpp") and "/internal/" not in path
            and not is_test_code(path))


def main():
    tree = Tree(Path(sys.argv[1]))
    problems = [*tree.problems(), *tree.unused(), *tree.untold()]
    print("\n".join(problems), file=sys.stderr, end="\n" if problems else "")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
