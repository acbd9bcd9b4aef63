// SPDX-License-Identifier: Apache-2.0
import { Code, RideError } from "./error.ts";
import type { Message } from "./wire.ts";

const kMostBodies = 16;
/** What is kept of a body that is too large: operation and call, by which it is refused. */
const kBegin = 8;

/** In one piece of memory: a list of parts would cost more than parts of a byte each. */
interface Unfinished {
  memory: Uint8Array;
  bytes: number;
  dropped: boolean;
}

/** What came of a part: the whole message, nothing yet, or the begin of one that was larger than it may be. */
export type Assembled = { message: Message } | { tooLarge: Message } | undefined;

/** Puts bodies that go on together, all of them in `limit` bytes. */
export class Assembler {
  private readonly bodies = new Map<string, Unfinished>();
  private bytes = 0;
  private readonly limit: number;

  constructor(limit: number) {
    this.limit = limit;
  }

  /** Throws if more bodies go on than the protocol allows: the connection is to be ended. */
  add(message: Message): Assembled {
    const key = `${message.kind} ${message.identifier}`;
    const body = this.bodies.get(key);
    if (body === undefined && !message.goesOn) return { message };
    const grown = body ?? this.begin(key);
    this.append(grown, message.body);
    if (message.goesOn) return undefined;
    this.bodies.delete(key);
    this.bytes -= grown.bytes;
    if (grown.dropped) return { tooLarge: { ...message, body: grown.memory } };
    return { message: { ...message, body: grown.memory.subarray(0, grown.bytes) } };
  }

  private begin(key: string): Unfinished {
    if (this.bodies.size >= kMostBodies) {
      throw new RideError(Code.tooLarge, `sent more than ${kMostBodies} bodies that go on`);
    }
    const body = { memory: new Uint8Array(0), bytes: 0, dropped: false };
    this.bodies.set(key, body);
    return body;
  }

  private append(body: Unfinished, part: Uint8Array): void {
    if (body.dropped) return;
    if (this.bytes + part.length > this.limit) {
      this.bytes -= body.bytes;
      const begin = body.bytes > 0 ? body.memory.subarray(0, body.bytes) : part;
      Object.assign(body, { memory: begin.slice(0, kBegin), bytes: 0, dropped: true });
      return;
    }
    if (body.bytes + part.length > body.memory.length) {
      const larger = new Uint8Array(2 * (body.bytes + part.length));
      larger.set(body.memory);
      body.memory = larger;
    }
    body.memory.set(part, body.bytes);
    body.bytes += part.length;
    this.bytes += part.length;
  }
}
