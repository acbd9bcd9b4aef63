// SPDX-License-Identifier: Apache-2.0

/** What a handler that takes its time keeps: the latest events. */
export interface SubscribeOptions {
  /** How many events wait for a handler whose promise is open; older ones are dropped. 1: the latest. */
  keep?: number;
}

/** If it returns a promise, the next event comes when that is done; any other result is ignored. */
export type Handler<T> = (event: T) => unknown;

const kKeep = 64;

/** Calls a handler for each event, one at a time, until `end` is called. */
export class Subscription<T = unknown> {
  /** How many events the handler has not seen, since it was too slow or this side had no room. */
  dropped = 0;
  private readonly handler: Handler<T>;
  private readonly keep: number;
  private readonly onEnd: (ended: Subscription<T>) => void;
  private waiting: T[] = [];
  private busy = false;
  private ended = false;

  constructor(handler: Handler<T>, options: SubscribeOptions, onEnd: (ended: Subscription<T>) => void) {
    this.handler = handler;
    this.keep = Math.max(1, options.keep ?? kKeep);
    this.onEnd = onEnd;
  }

  /** The handler is not called again. */
  end(): void {
    this.ended = true;
    this.waiting = [];
    this.onEnd(this);
  }

  /** @internal */
  take(event: T): void {
    this.waiting.push(event);
    if (this.waiting.length > this.keep) {
      this.waiting.shift();
      ++this.dropped;
    }
    if (!this.busy) this.deliver();
  }

  /** Until nothing waits, or the handler takes its time: then it goes on when its promise is done. */
  private deliver(): void {
    while (!this.ended && this.waiting.length > 0) {
      const event = this.waiting.shift() as T;
      const open = this.called(event);
      if (open === undefined) continue;
      this.busy = true;
      const goOn = () => {
        this.busy = false;
        this.deliver();
      };
      open.then(goOn, (error: unknown) => {
        console.error("a handler of events failed:", error);
        goOn();
      });
      return;
    }
  }

  private called(event: T): Promise<unknown> | undefined {
    this.busy = true; // an event that comes within the handler waits for its end
    try {
      const result = this.handler(event);
      return result instanceof Promise ? result : undefined;
    } catch (error) {
      console.error("a handler of events failed:", error);
      return undefined;
    } finally {
      this.busy = false;
    }
  }
}
