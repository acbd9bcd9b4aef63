// SPDX-License-Identifier: Apache-2.0
import { Code, RideError } from "./error.ts";
import { Reader } from "./fields.ts";
import type { Subscription } from "./subscription.ts";
import type { EventType } from "./types.ts";

/** Handlers of one event: one subscription on the wire serves all of them. */
export interface SharedSubscription {
  readonly identifier: number;
  readonly type: EventType<unknown>;
  readonly handlers: Set<Subscription>;
}

/** A component at the other side, as far as its directory told of it. */
export class RemoteComponent {
  /** 0: not looked up on this connection, or not there. */
  identifier = 0;
  /** Why requests are refused while `identifier` is 0. */
  problem: RideError;
  /** Done when the component was looked up on this connection. */
  lookedUp: Promise<void> = Promise.resolve();
  /** By number of the event. */
  readonly subscriptions = new Map<number, SharedSubscription>();
  readonly name: string;
  readonly interfaceName: string;
  readonly digest: number;

  constructor(name: string, interfaceName: string, digest: number) {
    this.name = name;
    this.interfaceName = interfaceName;
    this.digest = digest;
    this.problem = new RideError(Code.notConnected, "is not connected");
  }
}

/** Takes an event's body, and gives it to all handlers; throws if it is none. */
export function deliver(subscription: SharedSubscription, body: Uint8Array): void {
  const from = new Reader(body);
  const number = from.view.getUint32(from.place(4, 4), true);
  if (number !== subscription.type.number) {
    throw new RideError(Code.malformed, `event ${subscription.type.event} has the number ${number}`);
  }
  const members = subscription.type.take(from);
  from.end();
  for (const handler of [...subscription.handlers]) handler.take(members);
}
