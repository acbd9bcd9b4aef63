#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The codec of armature/ride beside one that was written from docs/ride.md alone.

usage: differential_test.py [EMULATOR OPTION...] CODEC_PROGRAM

Random values are encoded here, decoded and encoded there: text and bytes have to be the same. Then
the bytes are spoilt, and both have to agree on what is malformed and on what the rest says.
"""
import random
import struct
import subprocess
import sys

INNER = ["char", "double", "String"]
EVERYTHING = ["bool", "char", "byte", "short", "unsigned short", "int", "unsigned int", "long",
              "unsigned long", "float", "double", "String", ("array", "short"), ("array", "bool"),
              ("fixed", "int", 3), ("fixed", "bool", 2), ("struct", INNER),
              ("array", ("struct", INNER)), ("array", "String"), ("array", ("array", "float"))]
SCALARS = {"bool": ("B", 1), "char": ("b", 1), "byte": ("B", 1), "short": ("h", 2),
           "unsigned short": ("H", 2), "int": ("i", 4), "unsigned int": ("I", 4), "long": ("q", 4),
           "unsigned long": ("Q", 4), "float": ("I", 4), "double": ("Q", 4)}  # reals by their bits


class Malformed(Exception):
    pass


def make(kind, dice):
    """A random value."""
    if kind == "String":
        return "".join(dice.choice(["a", "ü", "€", "😀", "\0", "~"]) for _ in range(dice.randrange(6)))
    if isinstance(kind, str):
        if kind == "bool":
            return dice.randrange(2)
        form, size = SCALARS[kind][0], struct.calcsize("<" + SCALARS[kind][0])
        return struct.unpack("<" + form, dice.randbytes(size))[0]
    if kind[0] == "struct":
        return [make(member, dice) for member in kind[1]]
    count = kind[2] if kind[0] == "fixed" else dice.randrange(5)
    return [make(kind[1], dice) for _ in range(count)]


def encode(kind, value, body):
    if kind == "String":
        text = value.encode()
        encode("unsigned int", len(text), body)
        body += text
    elif isinstance(kind, str):
        form, alignment = SCALARS[kind]
        body += bytes(-len(body) % alignment) + struct.pack("<" + form, value)
    elif kind[0] == "struct":
        for member, part in zip(kind[1], value):
            encode(member, part, body)
    else:
        if kind[0] == "array":
            encode("unsigned int", len(value), body)
        for element in value:
            encode(kind[1], element, body)


def decode(kind, body, at):
    """(value, where it ends)"""
    if kind == "String":
        count, at = decode("unsigned int", body, at)
        if at + count > len(body):
            raise Malformed
        try:
            return bytes(body[at:at + count]).decode("utf-8", "strict"), at + count
        except UnicodeDecodeError:
            raise Malformed from None
    if isinstance(kind, str):
        form, alignment = SCALARS[kind]
        at += -at % alignment
        end = at + struct.calcsize("<" + form)
        if end > len(body):
            raise Malformed
        value = struct.unpack("<" + form, body[at:end])[0]
        if kind == "bool" and value > 1:
            raise Malformed
        return value, end
    if kind[0] == "struct":
        members = []
        for member in kind[1]:
            value, at = decode(member, body, at)
            members.append(value)
        return members, at
    count = kind[2] if kind[0] == "fixed" else None
    if count is None:
        count, at = decode("unsigned int", body, at)
        if count > len(body) - at:
            raise Malformed
    elements = []
    for _ in range(count):
        value, at = decode(kind[1], body, at)
        elements.append(value)
    return elements, at


def text_of(kind, value):
    if kind == "String":
        return '"' + value.encode().hex() + '"'
    if isinstance(kind, str):
        return str(value)
    if kind[0] == "struct":
        return "{" + "".join(text_of(k, v) + " " for k, v in zip(kind[1], value)) + "}"
    return "[" + "".join(text_of(kind[1], v) + " " for v in value) + "]"


def expected(body):
    """What the program is to say."""
    try:
        value, end = decode(("struct", EVERYTHING), body, 0)
        if end != len(body):
            raise Malformed
    except Malformed:
        return "malformed"
    again = bytearray()
    encode(("struct", EVERYTHING), value, again)
    return "".join(text_of(k, v) + " " for k, v in zip(EVERYTHING, value)) + "| " + again.hex()


def spoil(body, dice):
    """Some bytes changed, missing or too many."""
    body = bytearray(body)
    for _ in range(dice.randrange(3)):
        body[dice.randrange(len(body))] = dice.choice([0, 1, 2, 0x7f, 0x80, 0xff, dice.randrange(256)])
    change = dice.randrange(4)
    if change == 0:
        del body[dice.randrange(len(body)):]
    elif change == 1:
        body += dice.randbytes(1 + dice.randrange(4))
    return body


def main():
    dice = random.Random(20)
    bodies = []
    for _ in range(2000):
        body = bytearray()
        encode(("struct", EVERYTHING), make(("struct", EVERYTHING), dice), body)
        bodies.append(body)
        bodies += [spoil(body, dice) for _ in range(4)]
    lines = "".join(body.hex() + "\n" for body in bodies)
    found = subprocess.run(sys.argv[1:], input=lines, capture_output=True, text=True, check=True)
    answers = found.stdout.splitlines()
    assert len(answers) == len(bodies), f"{len(answers)} answers to {len(bodies)} bodies"
    malformed = 0
    for body, answer in zip(bodies, answers):
        wanted = expected(body)
        malformed += wanted == "malformed"
        assert answer == wanted, f"{body.hex()}\nexpected {wanted}\nfound    {answer}"
    assert 1000 < malformed < len(bodies) - 2000, f"{malformed} malformed bodies prove little"
    print(f"{len(bodies)} bodies, {malformed} of them malformed")


if __name__ == "__main__":
    main()
