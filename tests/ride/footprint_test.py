#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A minimal server needs no library but libc and libstdc++, and little memory.

usage: footprint_test.py MINIMAL_SERVER RAW_SERVER

Each serves one client a thousand requests before its memory is looked at. How long they take to be
ready is printed, not judged.
"""
import ctypes
import re
import socket
import statistics
import struct
import subprocess
import sys
import time

MOST_MORE_KIB = 512
LIBC = ctypes.CDLL(None)
ADDR_NO_RANDOMIZE = 0x0040000
ALLOWED = re.compile(r"libc\.so\.6|libstdc\+\+\.so\.6|libgcc_s\.so\.1|libm\.so\.6|ld-linux.*")
REQUEST = b"RIDE" + struct.pack("<IHHIIIff", 0, 2, 32, 1, 0, 9, 0.5, -0.25)


def fnv1a(text):
    value = 0x811C9DC5
    for byte in text.encode():
        value = (value ^ byte) * 0x01000193 & 0xFFFFFFFF
    return value


def resident_kib(pid):
    with open(f"/proc/{pid}/status", encoding="ascii") as status:
        return int(re.search(r"VmRSS:\s+(\d+) kB", status.read())[1])


def fix_addresses():
    """Where a library happens to be decides how many of its pages the kernel maps at once: by 150 KiB."""
    LIBC.personality(ADDR_NO_RANDOMIZE)


def start(program, prepare=None):
    """(process, address, seconds until it was ready)"""
    begin = time.perf_counter()
    process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                               preexec_fn=prepare)
    address = process.stdout.readline().strip()
    return process, address, time.perf_counter() - begin


def resident_after_work(program):
    process, address, _ = start(program, fix_addresses)
    host, port = re.fullmatch(r"tcp://(.*):(\d+)", address).groups()
    request = bytearray(REQUEST)
    request[16:20] = struct.pack("<I", fnv1a("int setVelocity(float,float)"))
    with socket.create_connection((host, int(port))) as client:
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        for _ in range(1000):
            client.sendall(request)
            reply = client.recv(64)
            assert len(reply) == 20, f"{program}: {reply}"
        resident = resident_kib(process.pid)
    process.stdin.close()
    process.wait(timeout=10)
    return resident


def measure(program):
    """(resident KiB, ms until it is ready)"""
    resident = statistics.median(resident_after_work(program) for _ in range(9))
    ready = []
    for _ in range(10):
        process, _, seconds = start(program)
        process.stdin.close()
        process.wait(timeout=10)
        ready.append(seconds)
    return resident, min(ready) * 1000


def main():
    minimal, raw = sys.argv[1:]
    dynamic = subprocess.run(["readelf", "-d", minimal], capture_output=True, text=True, check=True)
    needed = re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic.stdout)
    assert needed, dynamic.stdout
    beyond = [library for library in needed if not ALLOWED.fullmatch(library)]
    assert not beyond, f"needs {', '.join(beyond)}, and should need libc and libstdc++ at most"
    (resident, ready), (raw_resident, raw_ready) = measure(minimal), measure(raw)
    print(f"minimal server: {resident} KiB, ready in {ready:.2f} ms; "
          f"raw: {raw_resident} KiB, {raw_ready:.2f} ms; needs {', '.join(needed)}")
    more = resident - raw_resident
    assert more <= MOST_MORE_KIB, f"{more} KiB more than a raw server, at most {MOST_MORE_KIB}"


if __name__ == "__main__":
    main()
