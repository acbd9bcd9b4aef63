#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One attack on a node, until the process is told to end; then it prints what it was told.

usage: attacks.py NAME tcp://HOST:PORT tls://HOST:PORT FOLDER_OF_CERTIFICATES
       attacks.py busy:PEERS ...

The first line says that it goes on. The line at the end is JSON: {"controls": codes of CONTROL messages that
came, "replies": how many,
"ended": connections that the node has ended, "why": what TLS said}. It ends by itself with what went wrong
if an attack cannot be made.
"""
import json
import os
import random
import re
import select
import signal
import socket
import ssl
import struct
import sys
import time

from attacker import PATIENCE_S, Attacker, Flood
from wire import (COMMAND, CONTROL, COUNT, ECHO, EVENT, GOES_ON, LOAD, MESSAGES, MOVE, PING, REPLY, REQUEST, ROBOT,
                  SUBSCRIBE, TICK, control, echo_of, fnv1a, message, request_of, unfinished_of, words)


# Sent at once. The kernel hands on megabytes without a pause: to whomever they go, the 99th percentile of others on
# this CPU is 0.4 to 5 ms then, and a machine of the attacker's own would not have them wait.
PIECE = 1 << 16


def truncated(a):
    whole = echo_of(1000)
    while True:
        with a.connect() as connection:
            a.send(connection, whole[:random.randrange(1, len(whole))])


def reset(a):
    while True:
        connection = a.connect()
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        a.send(connection, echo_of(1000)[:-1])
        connection.close()


def oversized(a):
    """Three times as large as the node takes, on one connection."""
    connection = a.connect()
    while True:
        a.send(connection, echo_of(3 << 20))
        a.take(connection, 5.0)


def unfinished(a):
    """Bodies that take as much as the node lets them and never end, on many connections."""
    body = unfinished_of(15 * 65000)
    while True:
        a.kept = [a.connect() for _ in range(16)]
        for connection in a.kept:
            a.send(connection, body)
        a.see_them_end()


def endless_bodies(a):
    """The same on as many connections as there may be, each as large as any body may be."""
    pour(a, [unfinished_of(15 << 20)] * 60)


def endless_bodies_of_four(a):
    pour(a, [unfinished_of(15 << 20)] * 4)


def endless_bodies_of_who_may_not(a):
    pour(a, [unfinished_of(15 << 20, LOAD)] * 16)


def unread_answers(a):
    """Asks for answers as large as they may be, and takes none of them."""
    pour(a, [echo_of(15 << 20)] * 9, reads=False)


def values_that_grow(a):
    """Lists of empty texts, in memory eight times as large as on the wire."""
    pour(a, [request_of(words(COUNT, 1, 4 << 18) + bytes(4 * (4 << 18)))] * 9)


def pour(a, data, reads=True):
    """Each on a connection of its own, over and over, as fast as the node takes it."""
    left = {}
    while True:
        for each in data[len(left):]:
            connection = a.connect(buffer=None if reads else 4096)
            connection.setblocking(False)
            left[connection] = memoryview(each)
            a.kept = list(left)
        readable, writable, _ = select.select(left if reads else [], left, [], 1.0)
        for connection in set(readable + writable):
            try:
                if connection in readable:
                    got = connection.recv(1 << 16)
                    a.note(got)
                    if not got:
                        raise ConnectionResetError
                if connection in writable:
                    left[connection] = left[connection][connection.send(left[connection][:PIECE]):] or memoryview(data[0])
                    a.begin()
            except BlockingIOError:
                pass
            except ConnectionError:
                a.ended += 1
                del left[connection]


def slow_drip(a):
    whole = echo_of(1000)
    while True:
        a.kept = [a.connect() for _ in range(8)]
        for byte in whole[:100]:
            for connection in a.kept:
                a.send(connection, bytes([byte]))
            time.sleep(0.002)
        a.see_them_end()


def flood_of_pings(a):
    a.flood(control(PING) * 2000)


def flood_of_requests(a):
    a.flood(message(REQUEST, ROBOT, words(MESSAGES, 1)) * 2000)


def flood_of_commands(a):
    a.flood(message(COMMAND, ROBOT, words(MOVE)) * 2000)


def urgent_flood(a):
    a.flood(message(REQUEST, ROBOT, words(MESSAGES, 1), priority=255) * 2000)


def malformed_flood(a):
    a.flood(b"".join(message(random.randrange(6, 0x7FFF), random.randrange(1 << 32), b"?" * random.randrange(40))
                     for _ in range(2000)))


def busy(a, peers):
    """No attack: so many honest peers, each with a small request under way at any time."""
    connections = [a.connect() for _ in range(peers)]
    for connection in connections:
        a.send(connection, echo_of(100))
    while True:
        readable, _, _ = select.select(connections, [], [])
        for connection in readable:
            a.note(connection.recv(1 << 16))
            a.send(connection, echo_of(100))


def flood_of_four(a):
    a.flood(*[control(PING) * 2000] * 2, *[message(REQUEST, ROBOT, words(ECHO, 1, 1) + b"x") * 2000] * 2)


def out_of_order(a):
    """Answers nobody asked for, events nobody wants, ends of what has not begun, unknown codes."""
    replies = message(REPLY, 7, words(1))
    events = message(EVENT, 1, words(TICK, 1))
    end = message(REQUEST, ROBOT, b"x" * 100)
    unknown = control(12345) + control(9) + message(CONTROL, 7, words(16, 0, 0, 0, 0))
    unsubscribe = message(REQUEST, 0, words(fnv1a("int unsubscribe(int)"), 1, 99))
    while True:
        a.send_and_take(replies + events + end + unknown + unsubscribe + control(4))


def wrong_magic(a):
    while True:
        a.send_and_take(random.choice([b"GET / HTTP/1.1\r\n\r\n", b"\0" * 64, b"RIDF" + b"x" * 60, os.urandom(64)]))


def wrong_length(a):
    while True:
        a.send_and_take(b"RIDE" + struct.pack("<IHHI", 0, REQUEST, random.randrange(16), ROBOT))


def too_many_bodies(a):
    while True:
        a.send_and_take(b"".join(message(REQUEST | GOES_ON, i, b"x") for i in range(17)))


def half_open(a):
    """As many as the node lets in, and none says a word."""
    while True:
        while len(a.kept) < 70:
            a.kept.append(a.connect())
        a.begin()
        a.kept = [connection for connection in a.kept if a.take(connection)]
        time.sleep(0.01)


def thousands_of_connections(a):
    while True:
        a.kept.append(a.connect())
        if len(a.kept) % 100 == 0:
            a.take(a.kept[-1], PATIENCE_S)
            a.begin()
        if len(a.kept) == 2000:
            for connection in a.kept:
                connection.close()
            a.kept = []


def come_and_go_in_a_flood(a):
    """Each takes what a connection takes, while another keeps the node's thread busy."""
    flood = Flood(a, control(PING) * 2000)
    while True:
        readable, writable, _ = select.select([flood], [flood], [], 0)
        if readable:
            flood.drain()
        if writable:
            flood.send()
        with a.connect() as connection:
            a.send(connection, message(REQUEST, ROBOT, words(ECHO, 1, 60000) + b"x" * 60000))


def subscribe_bomb(a, reads=True):
    bomb = b"".join(message(REQUEST, 0, words(SUBSCRIBE, i, ROBOT, TICK, i)) for i in range(1, 1500))
    a.kept = [a.connect(buffer=None if reads else 4096) for _ in range(16)]
    for connection in a.kept:
        a.send(connection, bomb)
    while True:
        readable, _, _ = select.select(a.kept if reads else [], [], [], 1.0)
        for connection in readable:
            a.note(connection.recv(1 << 16))


def subscribe_bomb_that_never_reads(a):
    subscribe_bomb(a, reads=False)


def never_reads(a):
    """Asks for as much as it can and takes none of it."""
    data = echo_of(60_000)
    left = {}
    while True:
        while len(left) < 16:
            connection = a.connect(buffer=4096)
            connection.setblocking(False)
            left[connection] = data
        _, writable, _ = select.select([], left, [])
        for connection in writable:
            a.begin()
            try:
                left[connection] = left[connection][connection.send(left[connection][:PIECE]):] or data
            except ConnectionError:
                a.ended += 1  # It does not complete a message while the node does not read it.
                del left[connection]


def handshakes_as(a, name):
    while True:
        try:
            with a.connect_tls(name) as connection:
                a.send(connection, control(PING))
                a.take(connection, 1.0)
        except (ssl.SSLError, ConnectionError) as problem:
            a.why.add(str(problem))
        a.begin()


def no_certificate(a):
    handshakes_as(a, None)


def expired_certificate(a):
    handshakes_as(a, "expired")


def certificate_of_another_authority(a):
    handshakes_as(a, "stranger")


def wrong_peer(a):
    """A certificate that is good, of one who may not command."""
    while True:
        try:
            with a.connect_tls("guest") as connection:
                while a.send(connection, message(COMMAND, ROBOT, words(MOVE)) * 50) and a.take(connection, 1.0):
                    pass
        except (ssl.SSLError, ConnectionError) as problem:  # to shake hands took too long
            a.why.add(str(problem))


def no_tls(a):
    while True:
        with socket.create_connection(a.tls) as connection:
            a.send(connection, random.choice([control(PING), b"GET / HTTP/1.1\r\n\r\n"]))
            a.take(connection, 1.0)


def half_open_handshakes(a):
    while True:
        connection = socket.create_connection(a.tls)
        a.send(connection, b"\x16\x03\x01")
        a.kept.append(connection)
        a.kept = [kept for kept in a.kept if a.take(kept)]


ENDED_BY_THE_NODE = ("slow_drip", "unfinished", "endless_bodies", "endless_bodies_of_four", "endless_bodies_of_who_may_not", "half_open_handshakes")


class End(Exception):
    pass


stopping = False


def end(*_):
    """Raises once more after a while: what is raised in a destructor is lost."""
    if stopping:
        return
    signal.setitimer(signal.ITIMER_REAL, 0.1)
    raise End


def listen_for_the_end():
    for number in (signal.SIGTERM, signal.SIGALRM):
        signal.signal(number, end)


def stop_listening():
    """From here on the end is not told again, also not while the interpreter ends, which would end it by a signal."""
    global stopping
    stopping = True
    signal.setitimer(signal.ITIMER_REAL, 0)
    for number in (signal.SIGTERM, signal.SIGALRM):
        signal.signal(number, signal.SIG_IGN)


def attack(attacker, name, *peers):
    try:
        globals()[name](attacker, *map(int, peers))
    except End:
        stop_listening()


def parse(address):
    host, port = re.fullmatch(r"\w+://(.*):(\d+)", address).groups()
    return host, int(port)


def main():
    name, plain, tls, folder = sys.argv[1:]
    attacker = Attacker(parse(plain), parse(tls), folder)
    listen_for_the_end()
    name, *peers = name.split(":")
    try:
        attack(attacker, name, *peers)
    except End:  # told once more before `attack` could stop listening
        stop_listening()
    if name in ENDED_BY_THE_NODE:
        attacker.see_one_end()
    print(json.dumps({"controls": sorted(attacker.controls), "replies": attacker.replies, "ended": attacker.ended,
                      "why": sorted(attacker.why)}))


if __name__ == "__main__":
    main()
