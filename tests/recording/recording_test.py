#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What armature/record writes, read as https://mcap.dev/spec and numpy's manual say.

usage: recording_test.py WRITE_RECORDING
"""

import collections
import json
import math
import os
import re
import resource
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy

WRITE_RECORDING = sys.argv[1]
MAGIC = b"\x89MCAP0\r\n"
HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK = 1, 2, 3, 4, 5, 6
MESSAGE_INDEX, CHUNK_INDEX, STATISTICS, SUMMARY_OFFSET, DATA_END = 7, 8, 11, 14, 15
TIMES = 200
AMID_A_CHUNK = 8000  # of those, the second


class Fields:
    """The fields of a record, one after the other."""

    def __init__(self, data):
        self.data = data

    def take(self, code):
        size = struct.calcsize("<" + code)
        values = struct.unpack("<" + code, self.data[:size])
        self.data = self.data[size:]
        return values if len(values) > 1 else values[0]

    def counted(self, code="I"):
        size = self.take(code)
        assert size <= len(self.data)
        data, self.data = self.data[:size], self.data[size:]
        return data

    def text(self):
        return self.counted().decode("utf-8")

    def map(self, take_key, take_value):
        inner, entries = Fields(self.counted()), {}
        while inner.data:
            key = take_key(inner)
            assert key not in entries
            entries[key] = take_value(inner)
        return entries


def records(data, begin, end):
    """(place, op, content) of each record between two places."""
    while begin < end:
        op, size = struct.unpack("<BQ", data[begin : begin + 9])
        assert begin + 9 + size <= end
        yield begin, op, data[begin + 9 : begin + 9 + size]
        begin += 9 + size


def messages_in_whole_chunks(data):
    count, place = 0, len(MAGIC)
    while place + 9 <= len(data):
        op, size = struct.unpack("<BQ", data[place : place + 9])
        if op == CHUNK and place + 9 + size <= len(data):
            inner = Fields(data[place + 9 + 28 : place + 9 + size])
            inner.text()
            inner = inner.counted("Q")
            count += sum(op == MESSAGE for _, op, _ in records(inner, 0, len(inner)))
        place += 9 + size
    return count


def u16(fields):
    return fields.take("H")


def u64(fields):
    return fields.take("Q")


def expected_samples():
    """(topic, time in ns, value) as write_recording.cpp writes them."""
    for i in range(TIMES):
        time = i * 1_000_000
        yield "PID1.Out", time, {"value": i * 0.1}
        if i % 2 == 0:
            yield "Head.q", time, {"value": [i / 4, -0.5]}
        if i % 3 == 0:
            yield "Head.pan", time, {"q": i / 3, "braked": i % 2 == 1, "state": 'say "µ"\n'}
        if i % 50 == 0:
            yield "Odd", time, {"value": [None, math.inf, -math.inf]}
        yield "Count", time, {"value": 2**64 - 1 - i}


def run(folder, **more):
    files = [os.path.join(folder, name) for name in ("a.mcap", "a.csv")]
    command = [WRITE_RECORDING, *files]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, **more)
    contents = []
    for name in files:
        with open(name, "rb") as file:
            contents.append(file.read())
    return done, *contents


class Mcap(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            done, cls.data, _ = run(folder)
        assert done.returncode == 0 and not done.stdout, done
        footer = len(cls.data) - len(MAGIC) - 29
        _, op, content = next(records(cls.data, footer, footer + 29))
        assert op == FOOTER
        cls.summary, cls.offsets, cls.summary_crc = Fields(content).take("QQI")
        cls.footer = footer

    def section(self, wanted):
        found = records(self.data, len(MAGIC), self.summary)
        return [(place, content) for place, op, content in found if op == wanted]

    def chunks(self):
        for place, content in self.section(CHUNK):
            fields = Fields(content)
            begin, end, size, crc = fields.take("QQQI")
            self.assertEqual(fields.text(), "")
            inner = fields.counted("Q")
            self.assertEqual((len(inner), fields.data), (size, b""))
            self.assertEqual(zlib.crc32(inner), crc)
            yield place, len(content) + 9, begin, end, inner

    def messages(self, inner):
        """(place, channel, sequence, log time, publish time, value) of each message of a chunk."""
        for place, op, content in records(inner, 0, len(inner)):
            if op == MESSAGE:
                fields = Fields(content)
                yield place, *fields.take("HIQQ"), json.loads(fields.data)

    def channels(self):
        """id: (schema, topic, encoding, metadata), from the summary."""
        found = {}
        for _, op, content in records(self.data, self.summary, self.offsets):
            if op == CHANNEL:
                fields = Fields(content)
                number, schema = fields.take("HH")
                topic, encoding = fields.text(), fields.text()
                found[number] = (schema, topic, encoding, fields.map(Fields.text, Fields.text))
        return found

    def test_begins_and_ends_as_it_has_to(self):
        self.assertTrue(self.data.startswith(MAGIC) and self.data.endswith(MAGIC))
        ops = [op for _, op, _ in records(self.data, len(MAGIC), len(self.data) - len(MAGIC))]
        self.assertEqual((ops[0], ops[-1]), (HEADER, FOOTER))
        self.assertEqual(ops.count(DATA_END), 1)
        place, content = self.section(DATA_END)[0]
        self.assertEqual(place + 13, self.summary)
        self.assertEqual(struct.unpack("<I", content)[0], zlib.crc32(self.data[:place]))

    def test_the_summary_has_its_crc_and_its_offsets(self):
        crc_place = self.footer + 9 + 16
        self.assertEqual(self.summary_crc, zlib.crc32(self.data[self.summary : crc_place]))
        groups = []
        for place, op, content in records(self.data, self.summary, self.offsets):
            if not groups or groups[-1][0] != op:
                groups.append([op, place, 0])
            groups[-1][2] += 9 + len(content)
        self.assertEqual([g[0] for g in groups], [SCHEMA, CHANNEL, STATISTICS, CHUNK_INDEX])
        offsets = []
        for _, op, content in records(self.data, self.offsets, self.footer):
            self.assertEqual(op, SUMMARY_OFFSET)
            offsets.append(list(Fields(content).take("BQQ")))
        self.assertEqual(offsets, groups)

    def test_every_sample_is_there(self):
        topics = {number: channel[1] for number, channel in self.channels().items()}
        found = []
        for _, _, _, _, inner in self.chunks():
            for _, channel, sequence, log_time, publish_time, value in self.messages(inner):
                self.assertEqual((sequence, publish_time), (log_time // 1000, log_time))
                found.append((topics[channel], log_time, value))
        self.assertEqual(found, list(expected_samples()))

    def test_messages_follow_their_channel_and_channels_their_schema(self):
        known = set()
        for _, _, _, _, inner in self.chunks():
            for _, op, content in records(inner, 0, len(inner)):
                if op in (SCHEMA, CHANNEL):
                    known.add((op, Fields(content).take("H")))
                if op == CHANNEL:
                    self.assertIn((SCHEMA, Fields(content).take("HH")[1]), known)
                if op == MESSAGE:
                    self.assertIn((CHANNEL, Fields(content).take("H")), known)

    def test_the_summary_repeats_schemas_and_channels(self):
        def described(*place):
            return [(op, content) for _, op, content in records(*place) if op in (SCHEMA, CHANNEL)]

        first = [r for *_, inner in self.chunks() for r in described(inner, 0, len(inner))]
        again = described(self.data, self.summary, self.offsets)
        self.assertEqual(sorted(first), sorted(again))

    def test_indexes_lead_to_chunks_and_messages(self):
        chunks = {chunk[0]: chunk for chunk in self.chunks()}
        self.assertGreater(len(chunks), 2)
        message_indexes = dict(self.section(MESSAGE_INDEX))
        indexed = set()
        for _, op, content in records(self.data, self.summary, self.offsets):
            if op != CHUNK_INDEX:
                continue
            fields = Fields(content)
            begin, end, place, size = fields.take("QQQQ")
            offsets = fields.map(u16, u64)
            indexes_size = fields.take("Q")
            self.assertEqual(fields.text(), "")
            inner = chunks[place][4]
            self.assertEqual(fields.take("QQ"), (len(inner), len(inner)))
            self.assertEqual(chunks[place][1:4], (size, begin, end))
            messages = list(self.messages(inner))
            times = [message[3] for message in messages]
            self.assertEqual((begin, end), (min(times), max(times)))
            by_channel = collections.defaultdict(list)
            for message in messages:
                by_channel[message[1]].append((message[3], message[0]))
            self.assertEqual(offsets.keys(), by_channel.keys())
            for channel, offset in offsets.items():
                index = Fields(message_indexes.pop(offset))
                self.assertEqual(index.take("H"), channel)
                entries = index.counted()
                self.assertEqual(list(struct.iter_unpack("<QQ", entries)), by_channel[channel])
                indexes_size -= 9 + 2 + 4 + len(entries)
            self.assertEqual(indexes_size, 0)
            indexed.add(place)
        self.assertEqual(indexed, chunks.keys())
        self.assertFalse(message_indexes)

    def test_statistics_count_what_is_there(self):
        summary = records(self.data, self.summary, self.offsets)
        (content,) = [content for _, op, content in summary if op == STATISTICS]
        fields = Fields(content)
        samples = list(expected_samples())
        chunks = len(self.section(CHUNK))
        last = (TIMES - 1) * 1_000_000
        self.assertEqual(fields.take("QHIIIIQQ"), (len(samples), 5, 5, 0, 0, chunks, 0, last))
        counts = collections.Counter(topic for topic, _, _ in samples)
        topics = {number: channel[1] for number, channel in self.channels().items()}
        found = {topics[number]: count for number, count in fields.map(u16, u64).items()}
        self.assertEqual(found, counts)

    def test_channels_say_type_and_unit(self):
        by_topic = {channel[1]: channel for channel in self.channels().values()}
        self.assertEqual({channel[2] for channel in by_topic.values()}, {"json"})
        self.assertEqual(
            by_topic["PID1.Out"][3], {"type": "double", "layout": "double", "unit": "V"}
        )
        self.assertEqual(
            by_topic["Head.pan"][3],
            {"type": "Joint", "layout": "Joint{q:double,braked:bool,state:text}"},
        )

    def test_schemas_are_json_schemas_of_objects(self):
        schemas = {}
        for _, op, content in records(self.data, self.summary, self.offsets):
            if op == SCHEMA:
                fields = Fields(content)
                number = fields.take("H")
                self.assertNotEqual(number, 0)
                name, encoding = fields.text(), fields.text()
                self.assertEqual(encoding, "jsonschema")
                schemas[name] = json.loads(fields.text())
                self.assertEqual(schemas[name]["type"], "object")
        self.assertEqual(
            schemas["Joint"]["properties"],
            {
                "q": {"type": "number", "description": "angle [rad]"},
                "braked": {"type": "boolean"},
                "state": {"type": "string"},
            },
        )
        self.assertEqual(schemas["uint64"]["properties"], {"value": {"type": "integer"}})


class Csv(unittest.TestCase):
    NAMES = ["time_s", "PID1_Out", "Head_q_0", "Head_q_1", "Head_pan_q", "Head_pan_braked"]
    NAMES += ["Odd_0", "Odd_1", "Odd_2", "Count"]

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.csv = run(folder)[2].decode("utf-8")

    def expected_rows(self):
        nan = math.nan
        for i in range(TIMES):
            row = [i / 1000, i * 0.1, *([i / 4, -0.5] if i % 2 == 0 else [nan, nan])]
            row += [i / 3, i % 2] if i % 3 == 0 else [nan, nan]
            row += [nan, math.inf, -math.inf] if i % 50 == 0 else [nan, nan, nan]
            yield row + [float(2**64 - 1 - i)]

    def assert_rows(self, rows):
        def texts(some_rows):  # nan is not equal to itself, but its text is
            return [[str(float(x)) for x in row] for row in some_rows]

        self.assertEqual(texts(rows), texts(self.expected_rows()))

    def test_names_are_those_that_numpy_keeps(self):
        names = self.csv.splitlines()[0].split(",")
        self.assertEqual(names, self.NAMES)

    def test_comments_say_which_value_a_column_is(self):
        self.assertIn("# Head_pan_q: Head.pan.q [rad], angle\n", self.csv)
        self.assertIn("# Head_q_1: Head.q[1] [rad]\n", self.csv)

    def test_every_row_is_there(self):
        lines = [line for line in self.csv.splitlines()[1:] if not line.startswith("#")]
        self.assert_rows([[float(x) for x in line.split(",")] for line in lines])

    def test_numpy_loads_it_in_one_line(self):
        table = numpy.genfromtxt(self.csv.splitlines(), delimiter=",", names=True)
        self.assertEqual(list(table.dtype.names), self.NAMES)
        self.assert_rows(table.tolist())


class FullDisk(unittest.TestCase):
    def test_what_is_lost_is_counted_and_the_file_holds_what_came_before(self):
        def limit_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (AMID_A_CHUNK, AMID_A_CHUNK))

        with tempfile.TemporaryDirectory() as folder:
            done, mcap, csv = run(folder, preexec_fn=limit_files)
        total = len(list(expected_samples()))
        mcap_says, csv_says = done.stdout.splitlines()
        pattern = r"^cannot write '.*/a\.%s': File too large; (\d+) failed, (\d+) lost$"
        failed, lost = map(int, re.match(pattern % "mcap", mcap_says).groups())
        # One failure is that of the end.
        self.assertEqual(failed - 1 + lost + messages_in_whole_chunks(mcap), total)
        self.assertGreater(messages_in_whole_chunks(mcap), 0)
        failed, lost = map(int, re.match(pattern % "csv", csv_says).groups())
        self.assertEqual((failed, lost), (1, total))
        # What was written in part is taken back: the files end with a whole chunk, and a whole row.
        self.assertLess(max(len(mcap), len(csv)), AMID_A_CHUNK)
        self.assertTrue(mcap.startswith(MAGIC) and csv.startswith(b"time_s,") and csv.endswith(b"\n"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
