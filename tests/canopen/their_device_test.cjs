// SPDX-License-Identifier: Apache-2.0
// npm's canopen as the device of our host, canopen_client_on_pipe.
const { test } = require('node:test');
const assert = require('node:assert');
const { Device, DataType, AccessType } = require('./theirs.cjs');
const { Pipe } = require('./pipe.cjs');

const NODE = 9;

function make_device() {
    const device = new Device({ id: NODE });
    device.eds.setIdentity({ vendorId: 1234, productCode: 5, revisionNumber: 6, serialNumber: 7 });
    device.eds.addSdoServerParameter(1, 0x580 + NODE, 0x600 + NODE);
    device.eds.setHeartbeatProducerTime(20);
    device.eds.setEmcyCobId(0x80 + NODE);
    device.eds.setSyncCobId(0x80);
    const add = (index, parameterName, dataType) =>
        device.eds.addEntry(index, { parameterName, dataType, accessType: AccessType.READ_WRITE });
    add(0x2000, 'Text', DataType.VISIBLE_STRING).value = 'a text of somebody else';
    add(0x2001, 'Number', DataType.INTEGER32).value = 1;
    add(0x2002, 'Input', DataType.UNSIGNED16);
    const output = add(0x2003, 'Output', DataType.UNSIGNED32);
    const small = add(0x2004, 'Small', DataType.UNSIGNED8);
    output.value = 0x12345678;
    small.value = 42;
    device.eds.addTransmitPdo({ cobId: 0x180 + NODE, transmissionType: 1, dataObjects: [output, small] });
    device.eds.addReceivePdo({ cobId: 0x200 + NODE, dataObjects: [device.eds.getEntry(0x2002)] });
    return device;
}

test('each service of theirs is used by our host', async () => {
    const device = make_device();
    const pipe = new Pipe(process.env.CLIENT, [], device);
    device.pdo.on('pdo', () => device.emcy.write(0x4310, Buffer.alloc(5)));
    device.start();
    const code = await pipe.ended;
    device.stop();
    const told = pipe.told.join('\n');
    assert.strictEqual(code, 0, told);
    assert.strictEqual(device.getValue(0x2000), 'written by the host of another program');
    assert.strictEqual(device.getValue(0x2001), -123456);
    assert.strictEqual(device.getValue(0x2002), 0xbeef);
    assert.deepStrictEqual(pipe.told, [
        'heartbeat: pre-operational',
        'vendor: 1234',
        'text: a text of somebody else',
        'number: -123456',
        'missing: node 9 does not let 0x3000:00 be read: 0x06020000, no such object',
        'mapped: 0x2003:00 32',
        'mapped: 0x2004:00 8',
        `PDO: ${0x12345678}`,
        'PDO: 42',
        'emergency: node 9 reports 0x4310, the drive is too hot (error register 0x00)',
        'end: all done',
    ]);
});
