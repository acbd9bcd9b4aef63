// SPDX-License-Identifier: Apache-2.0

/** What a transport tells of its connection. After `end` it tells nothing more. */
export interface TransportEvents {
  open(): void;
  /** The transport uses the memory no more. */
  bytes(chunk: Uint8Array): void;
  end(why: string): void;
}

/** One connection: bytes in their order, both ways. */
export interface Connection {
  /** Takes all of it, and sends it when it can. */
  send(bytes: Uint8Array): void;
  /** How many bytes the other side has not taken yet, as far as this side knows. */
  unsent(): number;
  /** Ends it; nothing is told of it any more. */
  close(): void;
}

/** Begins to connect. */
export type Dial = (events: TransportEvents) => Connection;

/** What takes the connections of a program that listens. */
export interface Accepting {
  /** @param transport  as addresses begin: `tcp`. False: there is no place for it */
  accept(dial: Dial, transport: string): boolean;
}
