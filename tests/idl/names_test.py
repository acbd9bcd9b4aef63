#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What rcidl writes compiles whatever things are called.

usage: names_test.py RCIDL SOURCE_DIR COMPILER...

Each name that C++, its headers or generated code has already is a struct, an enum, an enumerator, an
event, a member, an interface, an operation, a parameter and a file, one file for each role, so that none helps another.
Each is compiled behind the headers of C, C++ and POSIX. The lists in idl/words are
compared with what those headers define here.
"""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

STANDARD = ["#include <bits/stdc++.h>"]
POSIX = [f"#include <{name}.h>" for name in """arpa/inet dirent dlfcn fcntl grp mqueue net/if netdb
    netinet/in netinet/tcp poll pthread pwd regex sched semaphore spawn strings sys/ioctl sys/mman
    sys/param sys/resource sys/select sys/socket sys/stat sys/statvfs sys/sysmacros sys/time sys/times
    sys/types sys/uio sys/un sys/utsname sys/wait syslog termios unistd endian byteswap""".split()]
RUNTIME = [f'#include "armature/{name}.hpp"' for name in
           ("ride/flags", "ride/node", "ride/placeholder", "ride/range", "ride/service", "types/enum", "types/struct")]

# What generated code and the classes behind it call their own, beside what is found in their headers.
GENERATED = """Declaration Executed Failed Flags Interface Number Peer
    Placeholder Reply ReplyOf Sent Service Subscription Then armature armature_describe ask base call
    code command component decode encode ended error error_text event event_number execute field found
    from handler has_subscribers in_range interface internal name name_space number on_E on_event
    on_failed operation options outside parameters peer priority publish publisher put raise refuse
    reply request ride send std subscribe subscription_changes take to type types value within
    a b c p27 on_ _ _1 _a __ a__b _A __A A_ a_ class_ name_ std_ char_ Array_""".split()
# Of the list, which is compared with the headers, these are tried in every role.
MACROS = """assert errno stdin stdout stderr unix linux major minor makedev offsetof setjmp va_arg isset
    roundup alloca sa_handler s6_addr st_atime h_errno EOF NULL ECHO INFINITY NAN EINVAL SIGINT
    M_PI MAX""".split()
# Words of the language itself: mistakes with their own text.
LANGUAGE = set("""struct void bool byte char short int long float Array double String unsigned
    event interface import""".split())
FLAGS = ["-std=c++20", "-Wall", "-Wextra", "-Wconversion", "-Wshadow", "-Wpedantic",
         "-Werror"]


def words(source, name):
    return (source / "idl/words" / f"{name}.txt").read_text().split()


def names_to_try(source):
    members = re.findall(r"\b[a-z_]\w*\b(?=\(| = |;|_\b)", "".join(
        (source / f"armature/ride/{name}.hpp").read_text() for name in ("placeholder", "service")))
    tried = {*words(source, "keywords"), *MACROS, *GENERATED, *members}
    assert set(MACROS) <= set(words(source, "macros"))
    return sorted(name for name in tried if name not in LANGUAGE)


def without_clash(names):
    """Not `class_` beside `class`, which is a mistake and not the matter here."""
    taken, kept = set(), []
    for name in names:
        key = re.sub("_+", "_", name).strip("_")
        if key not in taken:
            kept.append(name)
        taken.add(key)
    return kept


def portions(names, size):
    return [names[i:i + size] for i in range(0, len(names), size)]


def roles(names):
    """Files by their names: one thing of many names in each."""
    files = {}
    enumerators = portions([n for n in names if re.fullmatch("[a-z][a-z0-9]*(_[a-z0-9]+)*", n)], 240)
    files["enumerators"] = "".join(f"enum E{i} : short {{ {', '.join(some)} }};" for i, some in enumerate(enumerators)) \
        + "interface Uses { enum E0 f(enum E0 e); };"
    for i, some in enumerate(portions(names, 120)):
        structs = "".join(f"struct {n} {{ [range(0, 1)] int x; }};" for n in some)
        uses = "".join(f"struct {n} f{j}(struct {n} p, Array<struct {n}> q);" for j, n in enumerate(some))
        files[f"structs{i}"] = f"{structs} interface Uses {{ {uses} }};"
        enums = "".join(f"enum {n} {{ off, on }};" for n in some)
        uses = "".join(f"enum {n} f{j}(enum {n} p, Array<enum {n}> q);" for j, n in enumerate(some))
        files[f"enums{i}"] = f"{enums} interface Uses {{ {uses} }};"
        events = "".join(f"event {n} {{ int x; }};" for n in some)
        files[f"events{i}"] = events + "interface Raises {" + "".join(f"event {n};" for n in some) + "};"
        members = "".join(f"[range(0, 1)] int {n};" for n in some)
        files[f"members{i}"] = f"struct Carried {{ {members} }}; interface Carrier {{ struct Carried f(struct Carried carried_s); }};"
        files[f"interfaces{i}"] = "".join(f"interface {n} {{ int f(int a); }};" for n in some)
        operations = "".join(f"struct Carried {n}([range(0, 1)] int {n}, struct Carried carried_s);" for n in some)
        commands = "".join(f"void {n}();" for n in some)
        handlers = "".join(f"int on_{n}(int a);" for n in some)
        raised = "".join(f"event E{n} {{ int x; }};" for n in some)
        files[f"operations{i}"] = f"""struct Carried {{ [range(0, 1)] int x; }}; {raised}
            interface Carrier {{ {operations} }}; interface Commands {{ {commands} }};"""
        files[f"beside{i}"] = events + f"interface Carrier {{ {handlers} }};"
        calls = "".join(f"struct Carried f{j}({', '.join(f'[range(0, 1)] int {n}' for n in few)}, struct Carried carried_s);"
                        f"void g{j}({', '.join(f'String {n}' for n in few)});"
                        for j, few in enumerate(portions(some, 60)))
        files[f"parameters{i}"] = f"struct Carried {{ [range(0, 1)] int x; }}; interface Carrier {{ {calls} }};"
    return files


def rcidl(program, folder, name, text, *options):
    file = folder / f"{name}.idl"
    file.write_text(text)
    done = subprocess.run([program, file, "--out", folder, *options], capture_output=True, text=True)
    assert done.returncode == 0, f"{name}.idl: {done.stderr}"
    return [f'#include "{name}_client.cpp"', f'#include "{name}_service.cpp"']


def generate(program, folder, names):
    """What includes all that is generated, in translation units of a moderate size."""
    units = [rcidl(program, folder, name, text) for name, text in roles(names).items()]
    modules = []
    for few in portions(names, 60):
        for name in few:
            modules += rcidl(program, folder, name, f"struct Struct_of_{name}_ {{ int x; }};")
        imports = "".join(f'import "{name}.idl";' for name in few)
        uses = "".join(f"struct Struct_of_{name}_ f{i}();" for i, name in enumerate(few))
        modules += rcidl(program, folder, f"imports_{few[0]}", f"{imports} interface Imports {{ {uses} }};")
    return units + [modules]


def compiled(command):
    done = subprocess.run(command, capture_output=True, text=True)
    return "" if done.returncode == 0 else f"{command[0]}: {done.stderr[:6000]}"


def compile_all(compiler, source, folder, units):
    includes = [f"-I{source}", f"-I{folder}"]
    prelude = folder / "prelude.hpp"
    prelude.write_text("\n".join(STANDARD + POSIX + RUNTIME) + "\n")
    # Read once and not by each; clang++ wants to be told where it is.
    precompiled = folder / ("prelude.pch" if "clang" in compiler else "prelude.hpp.gch")
    mistake = compiled([compiler, *FLAGS, *includes, "-x", "c++-header", prelude, "-o", precompiled])
    assert not mistake, mistake
    include = ["-include-pch", precompiled] if "clang" in compiler else ["-include", prelude]
    unit = folder / "unit.cpp"
    for lines in units:
        unit.write_text("\n".join(lines) + "\n")
        mistake = compiled([compiler, *FLAGS, *includes, *include, "-fsyntax-only", unit])
        assert not mistake, f"{lines[0]}: {mistake}"


def check_lists(compiler, source, folder):
    """The macros of the headers are all in the list: a newer library may have more."""
    unit = folder / "headers.cpp"
    unit.write_text("\n".join(STANDARD + POSIX + RUNTIME) + "\n")
    defined = subprocess.run([compiler, "-std=gnu++20", "-dM", "-E", f"-I{source}", unit], check=True,
                             capture_output=True, text=True).stdout
    macros = {name for name in re.findall(r"^#define ([A-Za-z]\w*)", defined, re.M)
              if "__" not in name and not name.startswith("ARMATURE_")}
    assert len(macros) > 2000, len(macros)
    missing = macros - set(words(source, "macros"))
    assert not missing, f"idl/words/macros.txt lacks: {' '.join(sorted(missing))}"


def main():
    program, source, compilers = sys.argv[1], Path(sys.argv[2]), sys.argv[3:]
    names = without_clash(names_to_try(source))
    assert len(names) > 200, len(names)
    with tempfile.TemporaryDirectory() as work:
        folder = Path(work)
        units = generate(program, folder, names)
        for compiler in compilers:
            check_lists(compiler, source, folder)
            compile_all(compiler, source, folder, units)


if __name__ == "__main__":
    main()
