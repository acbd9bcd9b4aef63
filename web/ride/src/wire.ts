// SPDX-License-Identifier: Apache-2.0
import { Code, RideError } from "./error.ts";
import { Reader, Writer } from "./fields.ts";

export const Kind = { command: 1, request: 2, reply: 3, event: 4, control: 5 } as const;

/** Of a message: magic, priority, type, length and identifier. */
export const kHeaderBytes = 16;
export const kMostBodyBytes = 65535 - kHeaderBytes;
const kMagic = 0x45444952; // "RIDE", as a little-endian number
const kGoesOn = 0x8000;
const kMostPriority = 255;

/** One message as it lies on the wire; of a body that goes on, a part. */
export interface Message {
  readonly kind: number;
  readonly goesOn: boolean;
  readonly priority: number;
  readonly identifier: number;
  /** A view of what arrived: to be copied by who keeps it. */
  readonly body: Uint8Array;
}

/** Of a message of one part at least, with a body of any size: all its bytes. */
export function encode(kind: number, priority: number, identifier: number, body: Uint8Array): Uint8Array {
  const parts = Math.max(1, Math.ceil(body.length / kMostBodyBytes));
  const all = new Uint8Array(parts * kHeaderBytes + body.length);
  const view = new DataView(all.buffer);
  let at = 0;
  for (let part = 0; part < parts; ++part) {
    const piece = body.subarray(part * kMostBodyBytes, (part + 1) * kMostBodyBytes);
    view.setUint32(at, kMagic, true);
    view.setUint32(at + 4, priority, true);
    view.setUint16(at + 8, kind | (part + 1 < parts ? kGoesOn : 0), true);
    view.setUint16(at + 10, kHeaderBytes + piece.length, true);
    view.setUint32(at + 12, identifier, true);
    all.set(piece, at + kHeaderBytes);
    at += kHeaderBytes + piece.length;
  }
  return all;
}

/** Takes messages out of a stream of bytes, however it is divided. Keeps one message at most. */
export class Stream {
  private rest = new Uint8Array(0);

  /** Calls `take` for each whole message; throws when the bytes are none. */
  add(chunk: Uint8Array, take: (message: Message) => void): void {
    let bytes = chunk;
    if (this.rest.length > 0) {
      bytes = new Uint8Array(this.rest.length + chunk.length);
      bytes.set(this.rest);
      bytes.set(chunk, this.rest.length);
    }
    let at = 0;
    while (bytes.length - at >= kHeaderBytes) {
      const message = messageAt(bytes, at);
      if (message === undefined) break;
      at += kHeaderBytes + message.body.length;
      take(message);
    }
    this.rest = bytes.slice(at);
  }
}

/** undefined: its end has not come yet. */
function messageAt(bytes: Uint8Array, at: number): Message | undefined {
  const header = new DataView(bytes.buffer, bytes.byteOffset + at, kHeaderBytes);
  if (header.getUint32(0, true) !== kMagic) throw new RideError(Code.badMagic, "sent bytes that are no message of RIDE");
  const priority = header.getUint32(4, true);
  const type = header.getUint16(8, true);
  const length = header.getUint16(10, true);
  if (priority > kMostPriority) throw new RideError(Code.malformed, `sent the priority ${priority}, expected 0 to 255`);
  if (length < kHeaderBytes) throw new RideError(Code.malformed, `sent the length ${length}, expected 16 to 65535`);
  if (bytes.length - at < length) return undefined;
  return {
    kind: type & ~kGoesOn,
    goesOn: (type & kGoesOn) !== 0,
    priority,
    identifier: header.getUint32(12, true),
    body: bytes.subarray(at + kHeaderBytes, at + length),
  };
}

/** The body of a CONTROL message. */
export interface Control {
  readonly code: number;
  readonly type: number;
  readonly recipient: number;
  readonly operation: number;
  readonly text: string;
}

export function encodeControl(call: number, control: Control, priority = 0): Uint8Array {
  const body = new Writer();
  for (const each of [control.code, control.type, control.recipient, control.operation]) body.count(each);
  body.text(control.text);
  return encode(Kind.control, priority, call, body.body());
}

export function decodeControl(body: Uint8Array): Control {
  const from = new Reader(body);
  const number = () => from.view.getUint32(from.place(4, 4), true);
  const control = { code: number(), type: number(), recipient: number(), operation: number(), text: from.text() };
  from.end();
  return control;
}

/** What stands for a declaration in its canonical form: its 32-bit FNV-1a hash. */
export function numberOf(canonical: string): number {
  let hash = 0x811c9dc5;
  for (const each of new TextEncoder().encode(canonical)) hash = Math.imul(hash ^ each, 0x01000193);
  return hash >>> 0;
}
