#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What rcidl --typescript writes compiles under tsc --strict, whatever things are called.

usage: typescript_test.py RCIDL SOURCE_DIR NODE

The golden files, the examples of the tree, and a file for each role that a name can have, in which
every name that TypeScript or the generated code has already has that role.
"""
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

WORDS = """abstract any arguments as async await bigint boolean break case catch class const constructor
    continue debugger declare default delete do else enum eval export extends false finally for from
    function get if implements in infer instanceof is keyof let module namespace never new null
    number object of package private protected public readonly require return satisfies set static
    string super switch symbol then this throw true try type typeof undefined unique unknown using var
    while with yield Promise Uint8Array Object String_ Number Infinity NaN globalThis window
    ride command component name named on_failed peer request subscribe toString valueOf prototype
    hasOwnProperty __proto__ options handler words""".split()


def definition_of(role, names):
    """An interface definition in which the names have a role."""
    many = ", ".join(f"int {name}" for name in names[:60])
    rest = ", ".join(f"int {name}" for name in names[60:])
    return {
        "struct": "".join(f"struct {name} {{ int a; }};\n" for name in names)
        + "interface I { void use(" + ", ".join(f"struct {name} {name}" for name in names[:60]) + "); };\n",
        "enum": "".join(f"enum {name} {{ a, b }};\n" for name in names)
        + "struct S { " + " ".join(f"enum {name} {name};" for name in names) + " };\n",
        "event": "".join(f"event {name} {{ int a; }};\n" for name in names) + "interface I { void go(); };\n",
        "member": f"struct S {{ {' '.join(f'int {name};' for name in names)} }};\n",
        "enumerator": f"enum E {{ {', '.join(name for name in names if name.islower() and name[0] != '_')} }};\n",
        "operation": f"interface I {{ {' '.join(f'int {name}();' for name in names)} event E; }};\n"
        "event E { int a; };\n",
        "parameter": f"interface I {{ void go({many}); int ask({rest}); }};\n",
    }[role]


def check(node, source, folder, files):
    config = {
        "extends": str(source / "web/ride/tsconfig.json"),
        "compilerOptions": {
            "noEmit": True, "emitDeclarationOnly": False, "declaration": False, "rootDir": "/",
            "rewriteRelativeImportExtensions": False,
            "paths": {"@armature/ride": [str(source / "web/ride/src/ride.ts")],
                      "@armature/ride/service": [str(source / "web/ride/src/service.ts")],
                      "@armature/ride/tcp": [str(source / "web/ride/src/tcp.ts")]},
        },
        "include": [str(file) for file in files],
    }
    (folder / "tsconfig.json").write_text(json.dumps(config))
    tsc = source / "web/node_modules/typescript/bin/tsc"
    done = subprocess.run([node, tsc, "-p", folder], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def main():
    rcidl, source, node = sys.argv[1], Path(sys.argv[2]), sys.argv[3]
    with tempfile.TemporaryDirectory() as work:
        folder = Path(work)
        definitions = [source / "armature/remote/inspection.idl", *source.glob("examples/*/*.idl"),
                       *(source / f"idl/testdata/{name}.idl" for name in ("chassis", "everything", "geometry"))]
        for role in ("struct", "enum", "event", "member", "enumerator", "operation", "parameter"):
            definitions.append(folder / f"{role}_names.idl")
            definitions[-1].write_text(definition_of(role, WORDS))
        for definition in definitions:
            done = subprocess.run([rcidl, definition, "--typescript", "--out", folder], capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
        generated = sorted(folder.glob("*.ts"))
        assert len(generated) == 2 * len(definitions), generated
        # Programs that use it: those of tests/idl, and the example's, beside what they import.
        programs = [*(source / "tests/idl").glob("*.ts"), *(source / "examples/10_page").glob("*.ts")]
        for program in programs:
            shutil.copy(program, folder)
        (folder / "generated").mkdir()
        for file in folder.glob("elevator*.ts"):
            shutil.copy(file, folder / "generated")
        check(node, source, folder, [*(folder / program.name for program in programs), *generated, *sorted((source / "idl/testdata/golden").glob("*.ts")),
                                     *sorted((source / "web/ride/test").glob("*.ts"))])
        # What the test would say if it could not tell: a use with a wrong type is refused.
        (folder / "wrong.ts").write_text('import { VSPlaceholder } from "./ball.js";\n'
                                         "export const wrong = (it: VSPlaceholder) => it.setThreshold(1, 2, \"3\");\n")
        try:
            check(node, source, folder, [folder / "wrong.ts"])
        except AssertionError as problem:
            assert "not assignable to parameter of type 'number'" in str(problem), problem
        else:
            raise AssertionError("a wrong argument was taken")


if __name__ == "__main__":
    main()
