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
MESSAGES = fnv1a("unsigned long messages()")
TICK = fnv1a("event Tick{int}")


def message(kind, identifier, body=b"", priority=0):
    return b"RIDE" + struct.pack("<IHHI", priority, kind, 16 + len(body), identifier) + body


def words(*numbers):
    return struct.pack(f"<{len(numbers)}I", *numbers)


def control(code):
    return message(CONTROL, 0, words(code, 0, 0, 0, 0))


def echo_of(size, call=1):
    """A request whose body takes several messages."""
    body = words(ECHO, call, size) + b"x" * size
    parts = [body[at:at + 65519] for at in range(0, len(body), 65519)]
    return b"".join(message(REQUEST | (GOES_ON if part is not parts[-1] else 0), ROBOT, part) for part in parts)
