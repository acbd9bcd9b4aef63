// SPDX-License-Identifier: Apache-2.0
// npm's canopen as the host of our emulated drives.
const { test, before, after } = require('node:test');
const assert = require('node:assert');
const { once } = require('node:events');
const { execFileSync } = require('node:child_process');
const { mkdtempSync, rmSync, writeFileSync } = require('node:fs');
const { tmpdir } = require('node:os');
const { join } = require('node:path');
const { Device, DataType, Eds } = require('./theirs.cjs');
const { Pipe } = require('./pipe.cjs');

const NODE = 1;
const TIMEOUT = 5000; // ms; a shared machine may pause
let host;
let drives;

const upload = (index, subIndex, dataType) =>
    host.sdo.upload({ serverId: NODE, index, subIndex, dataType, timeout: TIMEOUT });
const download = (index, subIndex, data, dataType) =>
    host.sdo.download({ serverId: NODE, index, subIndex, data, dataType, timeout: TIMEOUT });

before(async () => {
    host = new Device({ id: 0x7f });
    host.eds.addSdoClientParameter(NODE, 0x600 + NODE, 0x580 + NODE);
    host.eds.addEmcyConsumer(0x80 + NODE);
    host.eds.addHeartbeatConsumer(NODE, TIMEOUT);
    host.eds.setSyncCobId(0x80);
    host.eds.setSyncGenerationEnable(true);
    const status = host.eds.addEntry(0x2041, { parameterName: 'Status', dataType: DataType.UNSIGNED16 });
    const position = host.eds.addEntry(0x2064, { parameterName: 'Position', dataType: DataType.INTEGER32 });
    const torque = host.eds.addEntry(0x2077, { parameterName: 'Torque', dataType: DataType.INTEGER16 });
    const control = host.eds.addEntry(0x2040, { parameterName: 'Control', dataType: DataType.UNSIGNED16 });
    const target = host.eds.addEntry(0x207a, { parameterName: 'Target', dataType: DataType.INTEGER32 });
    host.eds.addReceivePdo({ cobId: 0x180 + NODE, transmissionType: 1, dataObjects: [status, position, torque] });
    host.eds.addTransmitPdo({ cobId: 0x200 + NODE, transmissionType: 0xff, dataObjects: [control, target] });
    drives = new Pipe(process.env.EMULATOR, ['--bus', '-', '--drives', '2'], host);
    await drives.frame('701#00');
    await drives.frame('702#00');
    host.start();
    host.nmt.startNode();
});

after(async () => {
    host.stop();
    await drives.end();
});

test('numbers are read expedited', async () => {
    assert.strictEqual(await upload(0x1000, 0, DataType.UNSIGNED32), 0x00020192);
    assert.strictEqual(await upload(0x1018, 1, DataType.UNSIGNED32), 0x402);
    assert.strictEqual(await upload(0x1017, 0, DataType.UNSIGNED16), 0);
});

test('a text is read in segments', async () => {
    assert.strictEqual(await upload(0x1008, 0, DataType.VISIBLE_STRING), 'Armature emulated drive');
});

test('numbers are written and read again', async () => {
    await download(0x6081, 0, 123456, DataType.UNSIGNED32);
    assert.strictEqual(await upload(0x6081, 0, DataType.UNSIGNED32), 123456);
    await download(0x607c, 0, -5, DataType.INTEGER32);
    assert.strictEqual(await upload(0x607c, 0, DataType.INTEGER32), -5);
    await download(0x607c, 0, 0, DataType.INTEGER32);
});

test('texts are written in segments, of each length', async () => {
    for (const size of [1, 4, 5, 7, 8, 14, 100, 1000]) {
        const text = 'x'.repeat(size);
        await download(0x2000, 0, text, DataType.VISIBLE_STRING);
        assert.strictEqual(await upload(0x2000, 0, DataType.VISIBLE_STRING), text);
    }
});

test('what cannot be is aborted with the code that says why', async () => {
    const code = async (promise) => {
        const error = await promise.then(() => null, (rejected) => rejected);
        assert.ok(error, 'it was not aborted');
        return error.code;
    };
    assert.strictEqual(await code(upload(0x3000, 0, DataType.UNSIGNED8)), 0x06020000);
    assert.strictEqual(await code(upload(0x1018, 9, DataType.UNSIGNED8)), 0x06090011);
    assert.strictEqual(await code(download(0x6041, 0, 1, DataType.UNSIGNED16)), 0x06010002);
    assert.strictEqual(await code(download(0x6060, 0, 7, DataType.INTEGER8)), 0x06090030);
    assert.strictEqual(await code(download(0x6060, 0, 8, DataType.INTEGER32)), 0x06070012);
});

test('heartbeats tell the state that NMT asked for', async () => {
    await download(0x1017, 0, 20, DataType.UNSIGNED16);
    const state = async (wanted) => {
        for (;;) {
            const [heartbeat] = await once(host.nmt, 'heartbeat');
            if (heartbeat.deviceId === NODE && heartbeat.state === wanted) return;
        }
    };
    await state(0x7f);
    host.nmt.startNode(NODE);
    await state(0x05);
    host.nmt.stopNode(NODE);
    await state(0x04);
    host.nmt.enterPreOperational(NODE);
    await state(0x7f);
});

test('a drive is enabled by PDOs and answers each SYNC', async () => {
    await download(0x6060, 0, 8, DataType.INTEGER8);
    host.nmt.startNode(NODE);
    const answered = async (control, wanted) => {
        for (;;) {
            host.setValue(0x2040, control);
            host.pdo.write(0x200 + NODE);
            const seen = drives.frames.length;
            host.sync.write();
            await drives.until(() => drives.frames.slice(seen).some((line) => line.startsWith('181#')));
            if ((host.getValue(0x2041) & 0x6f) === wanted) return;
        }
    };
    await answered(0x06, 0x21);
    await answered(0x07, 0x23);
    await answered(0x0f, 0x27);
    host.setValue(0x207a, 2000); // increments
    for (let i = 0; i < 400; ++i) {
        await answered(0x0f, 0x27);
        if (Math.abs(host.getValue(0x2064) - 2000) < 50) break;
        await new Promise((resolve) => setTimeout(resolve, 5));
    }
    assert.ok(Math.abs(host.getValue(0x2064) - 2000) < 50, `it is at ${host.getValue(0x2064)}`);
});

test('a PDO is mapped anew as the host wants it', async () => {
    await download(0x1800, 1, (0x80000000 | 0x181) >>> 0, DataType.UNSIGNED32);
    await download(0x1a00, 0, 0, DataType.UNSIGNED8);
    await download(0x1a00, 1, 0x60610008, DataType.UNSIGNED32);
    await download(0x1a00, 2, 0x60410010, DataType.UNSIGNED32);
    await download(0x1a00, 0, 2, DataType.UNSIGNED8);
    await download(0x1800, 1, 0x181, DataType.UNSIGNED32);
    const seen = drives.frames.length;
    host.sync.write();
    const frame = await drives.until(() => drives.frames.slice(seen).find((line) => line.startsWith('181#')));
    assert.match(frame, /^181#08..../);
});

test('a fault is told by EMCY and ends by a reset', async () => {
    const emergency = once(host.emcy, 'emergency');
    drives.say(`fail ${NODE} 0x2310`);
    const [{ em }] = await emergency;
    assert.strictEqual(em.code, 0x2310);
    assert.strictEqual(await upload(0x603f, 0, DataType.UNSIGNED16), 0x2310);
    const gone = once(host.emcy, 'emergency');
    while ((await upload(0x6041, 0, DataType.UNSIGNED16) & 0x4f) !== 0x08);
    await download(0x6040, 0, 0x00, DataType.UNSIGNED16);
    await download(0x6040, 0, 0x80, DataType.UNSIGNED16);
    assert.strictEqual((await gone)[0].em.code, 0);
    assert.strictEqual(await upload(0x6041, 0, DataType.UNSIGNED16) & 0x4f, 0x40);
});

test('a reset of the node is a boot-up', async () => {
    drives.frames.length = 0;
    host.nmt.resetNode(NODE);
    await drives.frame('701#00');
    assert.strictEqual(await upload(0x6081, 0, DataType.UNSIGNED32) === 123456, false);
});

test('the EDS of the drive is understood', () => {
    const folder = mkdtempSync(join(tmpdir(), 'armature-eds-'));
    try {
        const file = join(folder, 'drive.eds');
        writeFileSync(file, execFileSync(process.env.EMULATOR, ['--eds']));
        const eds = Eds.fromFile(file);
        assert.strictEqual(eds.vendorName, 'Armature');
        assert.strictEqual(eds.getEntry(0x1000).value, 0x00020192);
        assert.strictEqual(eds.getEntry(0x6064).dataType, DataType.INTEGER32);
        assert.strictEqual(eds.getSubEntry(0x1018, 1).value, 0x402);
        assert.strictEqual(eds.getTransmitPdos()[0].cobId, 0x181);
    } finally {
        rmSync(folder, { recursive: true });
    }
});
