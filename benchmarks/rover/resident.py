#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Resident memory of the robot's side of the rover without its simulation [MB], here or under an emulator.

usage: resident.py PROGRAM LIBRARIES... [--emulator EMULATOR SYSTEM] [--most MB]

Under qemu's user emulation what counts is the memory of the program, which has the low addresses: the emulator's own is above.
"""

import argparse
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

DEPLOYMENT = Path(__file__).resolve().parent / "robot.yaml"
ABOVE_THE_PROGRAM = 1 << 40
LONG = 120.0
SETTLED = 8  # unchanged readings in a row, half a second apart
RUNS = 5


def mappings(process):
    """(address, resident bytes) of each."""
    address = 0
    for line in Path(f"/proc/{process.pid}/smaps").read_text(encoding="ascii", errors="replace").splitlines():
        if found := re.match(r"([0-9a-f]+)-[0-9a-f]+ ", line):
            address = int(found[1], 16)
        elif found := re.match(r"Rss: +(\d+) kB", line):
            yield address, 1024 * int(found[1])


def resident(process, emulated):
    return sum(size for address, size in mappings(process) if not emulated or address < ABOVE_THE_PROGRAM)


def settled(process, emulated):
    """What is resident once it has started, and nothing is added any more."""
    readings = []
    end = time.monotonic() + LONG
    while time.monotonic() < end and process.poll() is None:
        time.sleep(0.5)
        readings.append(resident(process, emulated))
        if len(readings) > SETTLED and max(readings[-SETTLED:]) == min(readings[-SETTLED:]):
            return readings[-1]
    sys.exit("resident: error: the robot's memory does not settle, or it has ended")


def measure(command, emulated):
    """(bytes, whether a cycle came too late: then a black box was written, which takes memory of its own)"""
    with tempfile.TemporaryDirectory() as folder, open(f"{folder}/said", "w+", encoding="utf-8") as said:
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.STDOUT)
        try:
            size = settled(process, emulated)
        finally:
            process.kill()
            process.wait()
        said.seek(0)
        return size, " fault: " in said.read()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("libraries", nargs="+", type=Path)
    parser.add_argument("--emulator", nargs=2, metavar=("EMULATOR", "SYSTEM"))
    parser.add_argument("--most", type=float, metavar="MB")
    arguments = parser.parse_args()
    emulator = [arguments.emulator[0], "-L", str(Path(arguments.emulator[1]).resolve())] if arguments.emulator else []
    folders = [part for folder in arguments.libraries for part in ("-L", str(folder.resolve()))]
    command = [*emulator, str(arguments.program.resolve()), "run", str(DEPLOYMENT), *folders, "--realtime", "off"]
    for _ in range(RUNS):
        size, late = measure(command, bool(emulator))
        if not late:
            break
    megabytes = size / 1e6
    print(f"{megabytes:.1f} MB" + (", a black box that was written among it" if late else ""))
    if arguments.most is not None and megabytes > arguments.most:
        sys.exit(f"resident: error: the robot's process takes {megabytes:.1f} MB, expected at most {arguments.most}")


main()
