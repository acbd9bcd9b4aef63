// SPDX-License-Identifier: Apache-2.0
// Recordings for ROS 2, compressed, with metadata and the robot's frames, read by @mcap/core and
// @foxglove/rosmsg2-serialization; zstd and lz4 decompress.
//
// usage: node ros2_test.mjs WEB_FOLDER WRITE_RECORDING ARMATURE ROBOTS
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import test, {after} from 'node:test';

const [webFolder, writeRecording, armature, robots] = process.argv.slice(2);
const require = createRequire(join(webFolder, 'package.json'));
const {McapIndexedReader} = require('@mcap/core');
const {parse} = require('@foxglove/rosmsg');
const {MessageReader} = require('@foxglove/rosmsg2-serialization');
const folder = mkdtempSync(join(tmpdir(), 'ros2_'));
after(() => rmSync(folder, {recursive: true}));

const decompress = (program) => (bytes, size) => new Uint8Array(execFileSync(program, ['-d', '-c'], {input: bytes, maxBuffer: Number(size) + 1}));
const decompressHandlers = {zstd: decompress('zstd'), lz4: decompress('lz4')};

/** A recording's header, metadata, and samples [topic, time, value] with the names of their types. */
async function read(path) {
  const content = new Uint8Array(readFileSync(path));
  const readable = {size: async () => BigInt(content.length), read: async (offset, length) => content.slice(Number(offset), Number(offset + length))};
  const reader = await McapIndexedReader.Initialize({readable, decompressHandlers});
  const readers = new Map();
  const reader_of = (schema) => {
    if (!readers.has(schema.id)) {
      assert.equal(schema.encoding, 'ros2msg');
      readers.set(schema.id, new MessageReader(parse(new TextDecoder().decode(schema.data), {ros2: true})));
    }
    return readers.get(schema.id);
  };
  const samples = [];
  const types = new Map();
  for await (const message of reader.readMessages({validateCrcs: true})) {
    const channel = reader.channelsById.get(message.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    types.set(channel.topic, schema.name);
    const cdr = channel.messageEncoding === 'cdr';
    const value = cdr ? reader_of(schema).readMessage(message.data) : JSON.parse(new TextDecoder().decode(message.data));
    samples.push([channel.topic, message.logTime, value]);
  }
  const metadata = new Map();
  for await (const record of reader.readMetadata()) metadata.set(record.name, record.metadata);
  const compressions = new Set(reader.chunkIndexes.map((chunk) => chunk.compression));
  return {profile: reader.header.profile, samples, types, metadata, compressions};
}

/** As write_recording.cpp writes them. */
function* expected_samples() {
  const time = (i) => BigInt(i) * 1_000_000n;
  for (let i = 0; i < 200; ++i) {
    yield ['PID1.Out', time(i), {data: i * 0.1}];
    if (i % 2 === 0) yield ['Head.q', time(i), {data: Float32Array.of(i / 4, -0.5)}];
    if (i % 3 === 0) yield ['Head.pan', time(i), {q: i / 3, braked: i % 2 === 1, state: 'say "µ"\n'}];
    if (i % 50 === 0) yield ['Odd', time(i), {data: Float64Array.of(NaN, Infinity, -Infinity)}];
    yield ['Count', time(i), {data: 2n ** 64n - 1n - BigInt(i)}];
  }
}

for (const compression of ['zstd', 'lz4']) {
  test(`every field is read back, from chunks in ${compression}`, async () => {
    const path = join(folder, `${compression}.mcap`);
    execFileSync(writeRecording, [path, join(folder, 'a.csv'), 'ros2', compression]);
    const {profile, samples, types, compressions} = await read(path);
    assert.equal(profile, 'ros2');
    assert.deepEqual([...compressions], [compression]);
    const expected = [...expected_samples()];
    assert.equal(samples.length, expected.length);
    expected.forEach((sample, i) => assert.deepEqual(samples[i].map((one) => (one?.constructor === Object ? {...one} : one)), sample));
    assert.equal(types.get('PID1.Out'), 'std_msgs/msg/Float64');
    assert.equal(types.get('Head.pan'), 'armature_msgs/msg/Joint');
  });
}

/** Janus, simulated and recorded. */
function run(name, ...settings) {
  const out = join(folder, name);
  const words = settings.flatMap((one) => ['--set', `Reporter.${one}`]);
  execFileSync(armature, ['run', join(robots, 'janus/demo/pid.yaml'), '--sim', '--script', join(robots, 'janus/experiment.lua'), '--for', '8s', '--out', out, ...words], {stdio: 'ignore'});
  return out;
}

const turn_about_z = ({z, w}) => 2 * Math.atan2(z, w);

test('a robot\'s joint states and frames are messages that ROS has', async () => {
  const out = run('ros', 'profile=ros2', 'compression=zstd', 'joints=[BridgeRef.nAxesSensorPosition]', 'metadata=true', 'what=[BridgeRef.nAxesSensorPosition]');
  const {samples, types, metadata} = await read(join(out, 'janus.mcap'));
  assert.equal(types.get('/tf'), 'tf2_msgs/msg/TFMessage');
  assert.equal(types.get('/joint_states'), 'sensor_msgs/msg/JointState');
  const positions = new Map(samples.filter(([topic]) => topic === 'BridgeRef.nAxesSensorPosition').map(([, time, value]) => [time, [...value.data].slice(0, 2)]));
  const states = samples.filter(([topic]) => topic === '/joint_states');
  const frames = samples.filter(([topic]) => topic === '/tf');
  assert.ok(states.length > 300 && states.length === frames.length, `${states.length}`);
  states.forEach(([, time, state], i) => {
    assert.deepEqual(state.name, ['joint1', 'joint2']);
    assert.deepEqual([...state.position], positions.get(time));
    assert.equal(BigInt(state.header.stamp.sec) * 1_000_000_000n + BigInt(state.header.stamp.nanosec), time);
    const {transforms} = frames[i][2];
    assert.equal(transforms.length, 4);
    assert.equal(transforms[0].header.frame_id, 'base');
    assert.equal(transforms[0].child_frame_id, 'link1');
    assert.ok(Math.abs(turn_about_z(transforms[0].transform.rotation) - state.position[0]) < 1e-9);
  });
  assert.ok(states.some(([, , state]) => Math.abs(state.position[0]) > 0.1), 'it moves');
  const about = metadata.get('armature');
  assert.match(about.get('deployment'), /pid\.yaml$/);
  assert.match(about.get('deployment_fnv1a_64'), /^[0-9a-f]{16}$/);
  assert.match(about.get('version'), /^\d+\.\d+/);
  assert.match(about.get('machine'), /Linux/);
  // What else reads recordings reads these.
  execFileSync(armature, ['report', out], {stdio: 'ignore'});
});

test('without a profile the frames are a schema of Foxglove', async () => {
  const out = run('json', 'joints=[BridgeRef.nAxesSensorPosition]', 'compression=lz4');
  const {profile, samples, types} = await read(join(out, 'janus.mcap'));
  assert.equal(profile, '');
  assert.equal(types.get('/tf'), 'foxglove.FrameTransforms');
  const [, , {transforms}] = samples.find(([topic]) => topic === '/tf');
  assert.deepEqual(Object.keys(transforms[0]), ['timestamp', 'parent_frame_id', 'child_frame_id', 'translation', 'rotation']);
});

test('mistakes are told before anything runs', () => {
  const refused = (setting) => {
    try {
      execFileSync(armature, ['check', join(robots, 'janus/demo/pid.yaml'), '--set', `Reporter.${setting}`], {encoding: 'utf8', stdio: 'pipe'});
    } catch (error) {
      return error.stdout + error.stderr;
    }
    return assert.fail(`${setting} is taken`);
  };
  assert.match(refused('joints=[BridgeRef.nAxesSensorPositio]'), /BridgeRef\.nAxesSensorPosition/);
  assert.match(refused('profile=ros1'), /ros2/);
});
