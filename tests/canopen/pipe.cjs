// SPDX-License-Identifier: Apache-2.0
// A channel of frames to a program of ours: a line each on its standard input and output.
const { spawn } = require('node:child_process');
const { createInterface } = require('node:readline');

/** Starts the program, and connects it with an npm device. */
class Pipe {
    constructor(program, args, device) {
        this.child = spawn(program, args, { stdio: ['pipe', 'pipe', 'pipe'] });
        this.told = [];
        this.frames = [];
        this.waiting = [];
        this.child.stdin.on('error', () => {}); // a program that has ended reads no more
        this.ended = new Promise((resolve) => this.child.on('exit', resolve));
        createInterface({ input: this.child.stdout }).on('line', (line) => {
            const [id, data] = line.split('#');
            const message = { id: parseInt(id, 16), data: Buffer.from(data, 'hex') };
            message.len = message.data.length;
            this.frames.push(line);
            device.receive(message);
            this.look();
        });
        createInterface({ input: this.child.stderr }).on('line', (line) => {
            this.told.push(line);
            this.look();
        });
        device.on('message', ({ id, data }) => {
            this.say(`${id.toString(16).padStart(3, '0')}#${data.toString('hex').toUpperCase()}`);
        });
    }

    /** A frame, or a line for the program itself. */
    say(line) {
        if (this.child.stdin.writable) this.child.stdin.write(line + '\n');
    }

    look() {
        this.waiting = this.waiting.filter(({ condition, resolve }) => {
            const found = condition();
            if (found) resolve(found);
            return !found;
        });
    }

    /** What `condition` returns as soon as it is true, looked at with each frame and line. */
    until(condition) {
        return new Promise((resolve) => {
            this.waiting.push({ condition, resolve });
            this.look();
        });
    }

    frame(text) {
        return this.until(() => this.frames.find((line) => line.startsWith(text)));
    }

    line(text) {
        return this.until(() => this.told.find((line) => line.includes(text)));
    }

    async end() {
        this.child.stdin.end();
        await this.ended;
    }
}

module.exports = { Pipe };
