// SPDX-License-Identifier: Apache-2.0
import { Code, RideError } from "./error.ts";

const kMostOpen = 1024;

interface OpenCall {
  resolve(body: Uint8Array): void;
  reject(error: RideError): void;
  timer: ReturnType<typeof setTimeout> | undefined;
}

/** Requests whose answers are waited for, on one connection after another. */
export class Calls {
  private readonly open = new Map<number, OpenCall>();
  private last = 0;

  /** Sends a request by `send`, which gets the call's number. `deadline` in ms; Infinity: none. */
  ask(deadline: number, send: (call: number) => void): Promise<Uint8Array> {
    if (this.open.size >= kMostOpen) {
      return Promise.reject(new RideError(Code.queueFull, `${kMostOpen} requests wait for answers`));
    }
    const call = this.next();
    const answer = new Promise<Uint8Array>((resolve, reject) => {
      const late = () => this.fail(call, new RideError(Code.timeout, `no answer within ${deadline} ms`));
      const timer = deadline === Infinity ? undefined : setTimeout(late, deadline);
      this.open.set(call, { resolve, reject, timer });
    });
    try {
      send(call);
    } catch (error) {
      this.fail(call, error instanceof RideError ? error : new RideError(Code.failed, String(error)));
    }
    return answer;
  }

  answer(call: number, body: Uint8Array): void {
    this.take(call)?.resolve(body);
  }

  /** False if the call is not open. */
  fail(call: number, error: RideError): boolean {
    const found = this.take(call);
    found?.reject(error);
    return found !== undefined;
  }

  failAll(error: RideError): void {
    for (const call of [...this.open.keys()]) this.fail(call, error);
  }

  private take(call: number): OpenCall | undefined {
    const found = this.open.get(call);
    if (found === undefined) return undefined;
    this.open.delete(call);
    clearTimeout(found.timer);
    return found;
  }

  private next(): number {
    do {
      this.last = this.last === 0xffffffff ? 1 : this.last + 1;
    } while (this.open.has(this.last));
    return this.last;
  }
}
