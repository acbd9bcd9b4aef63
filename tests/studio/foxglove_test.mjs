// SPDX-License-Identifier: Apache-2.0
// node --test foxglove_test.mjs, with ARMATURE=the program: what Foxglove's own client
// library finds at a studio.
import assert from "node:assert/strict";
import { connect } from "node:net";
import { after, test } from "node:test";
import { begin, Client, client, file_of, finish, folder, robot, studio, until } from "./foxglove_session.mjs";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";

after(finish);

const kJanus = file_of("robots/janus/demo/studio.yaml");

test("values of an application with hundreds of ports", { timeout: 120_000 }, async () => {
  const file = join(folder, "many.yaml");
  writeFileSync(file, 'application: many\nlibraries: [controls]\ncomponents:\n  C{1..400}: {model: Constant, activity: {periodic: 100 ms, thread: values}, properties: {Value: "{i}"}}\n');
  const { foxglove } = await studio((await robot(file, "many")).address);
  const one = await client(foxglove);
  const outputs = [...one.channels.keys()].filter((topic) => topic.endsWith(".Out"));
  assert.equal(outputs.length, 400);
  for (const topic of outputs) one.subscribe(topic);
  await until(() => new Set(one.messages.map((message) => message.topic)).size === 400, () => `values of all; ${one.said()}`);
  for (const { topic, value } of one.messages) assert.equal(value.value, Number(/\d+/.exec(topic)[0]));
  assert.equal(one.closed, false);
});

test("channels, values, parameters and the scene of Janus", { timeout: 120_000 }, async (context) => {
  const head = await robot(kJanus, "janus");
  const { foxglove } = await studio(head.address);
  const one = await client(foxglove);

  await context.test("channels are all ports, with schemas that tell units", async () => {
    assert.equal(one.info.op, "serverInfo");
    for (const capability of ["time", "parameters", "parametersSubscribe", "assets"]) assert.ok(one.info.capabilities.includes(capability));
    const channel = one.channels.get("BridgeRef.nAxesSensorPosition");
    assert.equal(channel.encoding, "json");
    assert.equal(channel.schemaEncoding, "jsonschema");
    const schema = JSON.parse(channel.schema);
    assert.equal(schema.properties.value.type, "array");
    assert.equal(schema.properties.value.items.type, "number");
    assert.match(schema.properties.value.description, /\[rad\]/);
    assert.ok(one.channels.size > 20, `${one.channels.size} channels`);
  });

  await context.test("values come with their times, each once", async () => {
    one.subscribe("BridgeRef.nAxesSensorPosition");
    await until(() => one.of("BridgeRef.nAxesSensorPosition").length > 10, () => `positions; ${one.said()}`);
    const positions = one.of("BridgeRef.nAxesSensorPosition");
    assert.equal(positions[0].value.value.length, 2);
    for (const number of positions[0].value.value) assert.ok(Number.isFinite(number));
    for (let i = 1; i < positions.length; ++i) assert.ok(positions[i].time > positions[i - 1].time);
    assert.ok(one.times.length > 0 && one.times.at(-1) >= positions.at(-1).time - 0.1);
  });

  await context.test("what is no longer subscribed to comes no more", async () => {
    const id = one.subscribe("Controller.reference");
    one.library.unsubscribe(id);
    const before = one.times.length;
    await until(() => one.times.length > before + 5, "time");
    const seen = one.of("Controller.reference").length;
    await until(() => one.times.length > before + 15, "time");
    assert.equal(one.of("Controller.reference").length, seen);
  });

  await context.test("all channels at once", async () => {
    const all = new Client(foxglove);
    await until(() => all.channels.size > 20, "channels");
    for (const topic of all.channels.keys()) all.subscribe(topic);
    await until(() => new Set(all.messages.map((message) => message.topic)).size > 20, () => `values of many; ${all.said()}`);
    for (const { topic, value } of all.messages) {
      const schema = JSON.parse(all.channels.get(topic).schema);
      for (const name of Object.keys(value)) assert.ok(name in schema.properties, `${topic}: ${name}`);
    }
    all.library.close();
  });

  await context.test("parameters are read with their types", async () => {
    const all = await one.ask((id) => one.library.getParameters([], id));
    assert.ok(all.size > 20);
    const [name, value] = [...all].find(([, content]) => typeof content === "number");
    const some = await one.ask((id) => one.library.getParameters([name, "Nobody.knows"], id));
    assert.deepEqual([...some], [[name, value]]);
    one.library.subscribeParameterUpdates([name]);
    await until(() => one.parameters.get(name) === value, "an update");
  });

  await context.test("who does not sit at the operator's seat sets nothing", async () => {
    const all = await one.ask((id) => one.library.getParameters([], id));
    const changes = [...all].filter(([, value]) => typeof value === "number").map(([name, value]) => ({ name, value: value + 1 }));
    const left = await one.ask((id) => one.library.setParameters(changes, id));
    for (const [name, value] of left) assert.equal(value, all.get(name), name);
    assert.ok(one.statuses.some((status) => status.level === 2 && /seat/.test(status.message)), one.said());
    assert.equal(one.statuses.filter((status) => status.level === 2).length, changes.length);
  });

  await context.test("what is no property, and what calls or publishes, is refused", async () => {
    const refused = (text) => until(() => one.statuses.some((status) => status.message.includes(text)), () => `${text}: ${one.said()}`);
    one.library.setParameters([{ name: "Controller.reference", value: [1, 1] }], "port");
    await refused("'Controller.reference' is left as it is");
    one.library.sendServiceCallRequest({ serviceId: 1, callId: 1, encoding: "json", data: new DataView(new ArrayBuffer(2)) });
    await refused("nothing is published or called");
    one.library.advertise({ topic: "/cmd", encoding: "json", schemaName: "x" });
    await refused("'advertise' is not offered");
    assert.equal(one.closed, false);
  });

  await context.test("the scene has the robot's shapes, in frames that move with its joints", async () => {
    one.subscribe("/tf");
    one.subscribe("/scene");
    await until(() => one.of("/tf").length > 0 && one.of("/scene").length > 0, () => `a scene; ${one.said()}`);
    const { transforms } = one.of("/tf").at(-1).value;
    const tilt = transforms.find((each) => each.child_frame_id === "link2");
    assert.equal(tilt.parent_frame_id, "link1");
    assert.equal(tilt.translation.z, 0.16);
    const [pan, tilted] = one.of("BridgeRef.nAxesSensorPosition").at(-1).value.value;
    const link1 = transforms.find((each) => each.child_frame_id === "link1");
    assert.ok(Math.abs(2 * Math.asin(link1.rotation.z) - pan) < 0.01);
    assert.ok(Math.abs(2 * Math.asin(-tilt.rotation.y) - tilted) < 0.01);
    const { entities } = one.of("/scene")[0].value;
    assert.deepEqual(entities.map((each) => each.frame_id).sort(), ["base", "left_camera", "link1", "link2", "right_camera"]);
    assert.deepEqual(entities.find((each) => each.id === "link1").cubes[0].size, { x: 0.08, y: 0.1, z: 0.16 });
    assert.equal(one.channels.get("/tf").schemaName, "foxglove.FrameTransforms");
    assert.equal(one.channels.get("/scene").schemaName, "foxglove.SceneUpdate");
  });

  await context.test("the description is an asset, and no other file is", async () => {
    one.library.fetchAsset("robot_description:/etc/passwd", 1);
    await until(() => one.assets.length === 1, "an answer");
    assert.equal(one.assets[0].status, 1);
    const uri = /there is (robot_description:\S+)/.exec(one.assets[0].error)[1];
    one.library.fetchAsset(uri, 2);
    await until(() => one.assets.length === 2, "the description");
    assert.match(new TextDecoder().decode(one.assets[1].data), /<robot name="janus">/);
  });

  await context.test("a client that reads nothing costs another one nothing", async () => {
    const quick = await client(foxglove);
    quick.subscribe("BridgeRef.nAxesSensorPosition");
    const rate = async () => {
      const begin = quick.messages.length;
      const from = quick.times.length;
      await until(() => quick.times.length >= from + 75, "time");
      return (quick.messages.length - begin) / (quick.times.at(-1) - quick.times[from]);
    };
    const alone = await rate();
    const slow = await idle_client(foxglove, [...quick.channels.values()].map((channel) => channel.id), 40);
    const beside = await rate();
    const later = await rate();
    assert.ok(Math.min(beside, later) > 0.7 * alone, `${alone} a second alone, ${beside} and ${later} beside it`);
    assert.ok(alone > 10, `${alone} values a second`);
    assert.ok(quick.statuses.every((status) => !/lost/.test(status.message)), quick.said());
    const told = await slow.read_again();
    assert.match(told, /values were lost, because this client/);
  });

  await context.test("when the robot goes its channels go, and they come back with it", async () => {
    await head.end();
    await until(() => one.channels.size === 0, () => `no channels; ${[...one.channels.keys()]}`);
    const again = await robot(kJanus, "janus");
    await until(() => one.channels.has("BridgeRef.nAxesSensorPosition"), "the channels");
    const seen = one.messages.length;
    one.subscribe("BridgeRef.nAxesSensorPosition");
    await until(() => one.messages.length > seen, "values");
    await again.end();
  });
});

/** A client that has subscribed to each channel many times, and takes nothing. */
async function idle_client(address, channels, times) {
  const { hostname, port, pathname } = new URL(address);
  const socket = connect({ host: hostname, port: Number(port) });
  socket.write(`GET ${pathname} HTTP/1.1\r\nHost: ${hostname}:${port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n` +
    "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n");
  await new Promise((resolve) => socket.once("data", resolve));
  socket.pause();
  for (let i = 0; i < times; ++i) {
    const subscriptions = channels.map((channelId, place) => ({ id: i * channels.length + place, channelId }));
    socket.write(masked(JSON.stringify({ op: "subscribe", subscriptions })));
  }
  return {
    /** What it is told once it reads, until it knows what it has lost. */
    read_again: () => new Promise((resolve) => {
      let text = "";
      socket.on("data", (data) => {
        text = text.slice(-1000) + data.toString("latin1");
        if (/values were lost[^"]*/.test(text)) resolve(/values were lost[^"]*/.exec(text)[0]);
      });
      socket.on("close", () => resolve("closed"));
      socket.resume();
    }).finally(() => socket.destroy()),
  };
}

/** A text in one frame, masked with zeros. */
function masked(text) {
  const payload = Buffer.from(text);
  const head = payload.length < 126 ? Buffer.from([0x81, 0x80 | payload.length]) : Buffer.from([0x81, 0x80 | 126, payload.length >> 8, payload.length & 255]);
  return Buffer.concat([head, Buffer.alloc(4), payload]);
}

test("the WAM is drawn, moved by its measured positions", { timeout: 60_000 }, async () => {
  const arm = await robot(file_of("robots/wam/demo/studio.yaml"), "wam");
  const { foxglove } = await studio(arm.address);
  const one = await client(foxglove);
  one.subscribe("/tf");
  one.subscribe("/scene");
  await until(() => one.of("/tf").length > 2 && one.of("/scene").length > 0, () => `a scene; ${one.said()}`);
  assert.ok(one.of("/tf")[0].value.transforms.length >= 7);
  const { entities } = one.of("/scene")[0].value;
  assert.ok(entities.length >= 5 && entities.every((each) => each.cubes.length + each.cylinders.length + each.spheres.length > 0));
  assert.ok(!/stands still/.test(one.said()), one.said());
});

test("the policy decides what a client sees", { timeout: 60_000 }, async () => {
  const head = await robot(kJanus, "guarded");
  const policy = join(folder, "studio.policy");
  writeFileSync(policy, "allow page@web read,command,configure *\n");
  const closed = await studio(head.address, "--policy", policy);
  const stranger = new Client(closed.foxglove);
  await until(() => stranger.info, "the greeting");
  await until(() => /not allowed/.test(stranger.said()), "why there are no channels");
  assert.equal(stranger.channels.size, 0, "no rule names foxglove@web");
  await closed.end();
  writeFileSync(policy, "allow foxglove@web read run\n");
  const open = await studio(head.address, "--policy", policy);
  const reader = await client(open.foxglove);
  reader.subscribe("BridgeRef.nAxesSensorPosition");
  await until(() => reader.messages.length > 0, "values");
  const all = await reader.ask((id) => reader.library.getParameters([], id));
  const [name, value] = [...all].find(([, content]) => typeof content === "number");
  await reader.ask((id) => reader.library.setParameters([{ name, value: value + 1 }], id));
  assert.ok(reader.statuses.some((status) => /not allowed/i.test(status.message)), reader.said());
});

test("an application that serves pages offers it, too, under its own policy", { timeout: 60_000 }, async () => {
  const pages = join(folder, "pages");
  mkdirSync(pages);
  writeFileSync(join(pages, "index.html"), "<p>a page</p>");
  writeFileSync(join(folder, "own.policy"), "allow foxglove@web read armature,BridgeRef,PID1\nallow foxglove@web configure PID1\n");
  const file = join(folder, "served.yaml");
  writeFileSync(file, `include: ${kJanus}\nnetwork: {listen: "ws://127.0.0.1:0", pages: pages, policy: own.policy}\n`);
  const { found } = await begin(["run", file, "--sim", "--pace", "1"], /Foxglove finds it at (\S+)/);
  const one = await client(found[1]);
  assert.ok([...one.channels.keys()].every((topic) => /^(BridgeRef|PID1)\./.test(topic)), [...one.channels.keys()].join());
  one.subscribe("BridgeRef.nAxesSensorPosition");
  await until(() => one.messages.length > 2, () => `values; ${one.said()}`);
  const before = (await one.ask((id) => one.library.getParameters(["PID1.Kp"], id))).get("PID1.Kp");
  const after = await one.ask((id) => one.library.setParameters([{ name: "PID1.Kp", value: before + 1 }, { name: "PID2.Kp", value: 1 }], id));
  assert.deepEqual([...after], [["PID1.Kp", before + 1]]);
  assert.ok(one.statuses.some((status) => /'PID2.Kp' is left as it is: there is no such property/.test(status.message)), one.said());
});

test("without the secret nobody comes in", { timeout: 30_000 }, async () => {
  const head = await robot(kJanus, "secret");
  const { foxglove } = await studio(head.address);
  const stranger = new Client(`${foxglove.slice(0, -1)}${foxglove.endsWith("0") ? "1" : "0"}`);
  await until(() => stranger.closed || stranger.statuses.length > 0, "the end");
  assert.equal(stranger.info, undefined);
});
