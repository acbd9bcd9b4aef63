// SPDX-License-Identifier: Apache-2.0
import { Code, RideError } from "./error.ts";

const kFirstBytes = 256;
const utf8 = new TextEncoder();
const strictUtf8 = new TextDecoder("utf-8", { fatal: true, ignoreBOM: true });

/** A body that is being written: fields one after another, each aligned from the body's start. */
export class Writer {
  view = new DataView(new ArrayBuffer(kFirstBytes));
  private size = 0;

  /** Room for a field of `size` bytes; the bytes before it are 0. Returns where it begins. */
  place(size: number, alignment: number): number {
    const at = Math.ceil(this.size / alignment) * alignment;
    this.size = at + size;
    if (this.size > this.view.byteLength) this.grow();
    return at;
  }

  count(value: number): void {
    const at = this.place(4, 4);  // first: it may make another view
    this.view.setUint32(at, value, true);
  }

  bytes(value: Uint8Array): void {
    const at = this.place(value.length, 1);
    new Uint8Array(this.view.buffer).set(value, at);
  }

  text(value: string): void {
    const bytes = utf8.encode(value);
    this.count(bytes.length);
    this.bytes(bytes);
  }

  /** What was written so far. */
  body(): Uint8Array {
    return new Uint8Array(this.view.buffer, 0, this.size);
  }

  private grow(): void {
    const larger = new Uint8Array(Math.max(this.size, 2 * this.view.byteLength));
    larger.set(new Uint8Array(this.view.buffer));
    this.view = new DataView(larger.buffer);
  }
}

/** A body that is being read. Every size in it is compared with what is there before it is used. */
export class Reader {
  readonly view: DataView;
  private at = 0;
  private readonly all: Uint8Array;

  constructor(body: Uint8Array) {
    this.all = body;
    this.view = new DataView(body.buffer, body.byteOffset, body.byteLength);
  }

  /** Where a field of `size` bytes begins; throws if the body is too short for it. */
  place(size: number, alignment: number): number {
    const begin = Math.ceil(this.at / alignment) * alignment;
    if (begin + size > this.all.length) {
      throw new RideError(Code.malformed, `ends at byte ${this.all.length}, expected ${begin + size}`);
    }
    this.at = begin + size;
    return begin;
  }

  /** A number of elements or bytes: each of them takes a byte at least. */
  count(): number {
    const count = this.view.getUint32(this.place(4, 4), true);
    const left = this.all.length - this.at;
    if (count > left) throw new RideError(Code.malformed, `counts ${count}, and ${left} bytes are left`);
    return count;
  }

  /** A copy. */
  bytes(count: number): Uint8Array {
    const begin = this.place(count, 1);
    return this.all.slice(begin, begin + count);
  }

  text(): string {
    const count = this.count();
    const begin = this.place(count, 1);
    try {
      return strictUtf8.decode(this.all.subarray(begin, begin + count));
    } catch {
      throw new RideError(Code.malformed, "is a text that is no UTF-8");
    }
  }

  /** Throws if something is left. */
  end(): void {
    const left = this.all.length - this.at;
    if (left > 0) throw new RideError(Code.malformed, `has ${left} bytes left over`);
  }
}
