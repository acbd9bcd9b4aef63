# SPDX-License-Identifier: Apache-2.0
"""What attacks are made of: connections, and what the node says on them."""
import select
import socket
import ssl
import struct

from wire import CONTROL

PATIENCE_S = 5.0


def is_readable(connection, wait_s):
    poll = select.poll()
    poll.register(connection, select.POLLIN)
    return bool(poll.poll(wait_s * 1000))


class Attacker:
    def __init__(self, plain, tls, folder):
        self.plain, self.tls, self.folder = plain, tls, folder
        self.controls, self.why, self.replies, self.ended = set(), set(), 0, 0
        self.kept = []
        self.begun = False

    def begin(self):
        """Tells that the attack goes on."""
        if not self.begun:
            print("begun", flush=True)
        self.begun = True

    def connect(self, buffer=None):
        made = socket.socket()
        if buffer:
            made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer)
        made.connect(self.plain)
        made.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return made

    def connect_tls(self, name=None):
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        context.load_verify_locations(f"{self.folder}/authority.pem")
        if name:
            context.load_cert_chain(f"{self.folder}/{name}.pem", f"{self.folder}/{name}.key")
        made = socket.create_connection(self.tls)
        made.settimeout(5)
        return context.wrap_socket(made, server_hostname=self.tls[0])

    def take(self, connection, wait=0.0):
        """Reads what is there and remembers what it says; False once the node has ended it."""
        rest = b""
        while True:
            if not is_readable(connection, wait if not rest else 1.0):
                return True
            try:
                got = connection.recv(65536)
            except (ConnectionError, ssl.SSLError, TimeoutError) as problem:
                self.why.add(str(problem))
                got = b""
            if not got:
                self.ended += 1
                return False
            rest = self.note(rest + got)

    def note(self, received):
        while len(received) >= 16:
            kind, length = struct.unpack_from("<HH", received, 8)
            if len(received) < length:
                break
            if kind == CONTROL:
                self.controls.add(struct.unpack_from("<I", received, 16)[0])
            else:
                self.replies += 1
            received = received[length:]
        return received

    def send(self, connection, data):
        try:
            connection.sendall(data)
            self.begin()
            return True
        except (ConnectionError, ssl.SSLError) as problem:
            self.why.add(str(problem))
            return False

    def send_and_take(self, data):
        """On a connection of its own, to its end or to the node's first answer."""
        with self.connect() as connection:
            self.send(connection, data)
            self.take(connection, 1.0)

    def see_them_end(self):
        """The node ends each that is kept."""
        while self.kept:
            self.kept = [connection for connection in self.kept if self.take(connection, PATIENCE_S)]

    def see_one_end(self):
        return any(connection.fileno() >= 0 and not self.take(connection, 1.0) for connection in self.kept)

    def flood(self, *chunks):
        """As fast as the node takes it, on a connection for each chunk."""
        floods = [Flood(self, chunk) for chunk in chunks]
        while True:
            readable, writable, _ = select.select(floods, floods, [])
            for each in writable:
                each.send()
            for each in readable:
                each.drain()


class Flood:
    """A connection and what is sent on it over and over; made anew where the node ends it, as it does when the
    attacker gets no time to complete a message."""

    def __init__(self, attacker, chunk):
        self.attacker, self.chunk = attacker, chunk
        self.connect()

    def connect(self):
        self.left = b""
        self.connection = self.attacker.connect()
        self.connection.setblocking(False)

    def fileno(self):
        return self.connection.fileno()

    def send(self):
        self.left = self.left or self.chunk
        try:
            self.left = self.left[self.connection.send(self.left):]
            self.attacker.begin()
        except BlockingIOError:
            pass
        except ConnectionError:
            self.connect()

    def drain(self):
        """Only the first answers are looked at."""
        try:
            got = self.connection.recv(1 << 20)
        except BlockingIOError:
            return
        except ConnectionError:
            got = b""
        if not got:
            self.connect()
        elif self.attacker.replies + len(self.attacker.controls) < 1:
            self.attacker.note(got)
