// SPDX-License-Identifier: Apache-2.0
// What armature/record writes, read by @mcap/core, which Foxglove is built on.
//
// usage: node mcap_core_test.mjs WEB_FOLDER WRITE_RECORDING
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, openSync, readSync, fstatSync, rmSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import test from 'node:test';

const [webFolder, writeRecording] = process.argv.slice(2);
const {McapIndexedReader, McapStreamReader} =
  createRequire(join(webFolder, 'package.json'))('@mcap/core');
const TIMES = 200;

/** [topic, time in ns, value] as write_recording.cpp writes them. */
function* expectedSamples() {
  const time = (i) => BigInt(i) * 1_000_000n;
  for (let i = 0; i < TIMES; ++i) {
    yield ['PID1.Out', time(i), {value: i * 0.1}];
    if (i % 2 === 0) yield ['Head.q', time(i), {value: [i / 4, -0.5]}];
    if (i % 3 === 0) yield ['Head.pan', time(i), {q: i / 3, braked: i % 2 === 1, state: 'say "µ"\n'}];
    if (i % 50 === 0) yield ['Odd', time(i), {value: [null, Infinity, -Infinity]}];
    yield ['Count', time(i), {value: 2n ** 64n - 1n - BigInt(i)}];
  }
}

/** JSON as @mcap/core hands it over; 64 bits do not fit into a number of JavaScript. */
function parse(data, topic) {
  const text = new TextDecoder('utf-8', {fatal: true}).decode(data);
  const value = JSON.parse(text);
  return topic === 'Count' ? {value: BigInt(/\d+/.exec(text)[0])} : value;
}

async function withRecording(read) {
  const folder = mkdtempSync(join(tmpdir(), 'mcap_core_'));
  try {
    const path = join(folder, 'a.mcap');
    execFileSync(writeRecording, [path, join(folder, 'a.csv')]);
    const file = openSync(path);
    const size = fstatSync(file).size;
    const bytes = (offset, length) => {
      const part = new Uint8Array(Number(length));
      assert.equal(readSync(file, part, 0, part.length, Number(offset)), part.length);
      return part;
    };
    return await read({size, bytes});
  } finally {
    rmSync(folder, {recursive: true});
  }
}

function compare(found) {
  const expected = [...expectedSamples()];
  assert.equal(found.length, expected.length);
  expected.forEach((sample, i) => assert.deepEqual(found[i], sample));
}

test('the indexed reader finds every sample, its channel and its schema', async () => {
  await withRecording(async ({size, bytes}) => {
    const readable = {size: async () => BigInt(size), read: async (offset, length) => bytes(offset, length)};
    const reader = await McapIndexedReader.Initialize({readable});
    const found = [];
    for await (const message of reader.readMessages({validateCrcs: true})) {
      const channel = reader.channelsById.get(message.channelId);
      assert.equal(channel.messageEncoding, 'json');
      assert.equal(reader.schemasById.get(channel.schemaId).encoding, 'jsonschema');
      assert.equal(BigInt(message.sequence), message.logTime / 1000n);
      found.push([channel.topic, message.logTime, parse(message.data, channel.topic)]);
    }
    compare(found);
    assert.equal(reader.statistics.messageCount, BigInt(found.length));
    assert.equal([...reader.channelsById.values()].find((c) => c.topic === 'PID1.Out').metadata.get('unit'), 'V');
  });
});

test('the reader of streams finds the same', async () => {
  await withRecording(({size, bytes}) => {
    const reader = new McapStreamReader({validateCrcs: true});
    const topics = new Map();
    const found = [];
    reader.append(bytes(0, size));
    for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
      if (record.type === 'Channel') topics.set(record.id, record.topic);
      if (record.type !== 'Message') continue;
      const topic = topics.get(record.channelId);
      found.push([topic, record.logTime, parse(record.data, topic)]);
    }
    assert.ok(reader.done());
    compare(found);
  });
});
