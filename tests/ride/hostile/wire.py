# SPDX-License-Identifier: Apache-2.0
"""Messages of RIDE, as docs/ride.md has them, right or wrong."""
import struct

COMMAND, REQUEST, REPLY, EVENT, CONTROL = range(1, 6)
GOES_ON = 0x8000
PING, SUBSCRIBE = 17, 0x5E363BED
ROBOT = 1


def fnv1a(text):
    value = 0x811C9DC5
    for byte in text.encode():
        value = (value ^ byte) * 0x01000193 & 0xFFFFFFFF
    return value


ECHO = fnv1a("String echo(String)")
MOVE = fnv1a("void move()")
COUNT = fnv1a("int count(Array<String>)")
LOAD = fnv1a("void load(String)")
MESSAGES = fnv1a("unsigned long messages()")
TICK = fnv1a("event Tick{int}")


def message(kind, identifier, body=b"", priority=0):
    return b"RIDE" + struct.pack("<IHHI", priority, kind, 16 + len(body), identifier) + body


def words(*numbers):
    return struct.pack(f"<{len(numbers)}I", *numbers)


def control(code):
    return message(CONTROL, 0, words(code, 0, 0, 0, 0))


def request_of(body):
    """In several messages where one does not hold it."""
    parts = [body[at:at + 65519] for at in range(0, len(body), 65519)]
    return b"".join(message(REQUEST | (GOES_ON if part is not parts[-1] else 0), ROBOT, part) for part in parts)


def echo_of(size, call=1):
    return request_of(words(ECHO, call, size) + b"x" * size)


def unfinished_of(size, operation=ECHO):
    """A request whose body goes on, and has no end."""
    body = words(operation, 1, size) + b"x" * size
    return b"".join(message(REQUEST | GOES_ON, ROBOT, body[at:at + 65519]) for at in range(0, len(body), 65519))
