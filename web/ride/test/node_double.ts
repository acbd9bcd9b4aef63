// SPDX-License-Identifier: Apache-2.0
// The other side of a connection, as tests want it: it has one component, and does what it is told.
import { decodeControl, encode, encodeControl, Kind, type Message, Stream } from "../src/wire.ts";
import { ComponentEntry, Directory } from "../src/directory.ts";
import { Code, type Connection, type Dial, Peer, type PeerOptions, Reader, type TransportEvents } from "../src/ride.ts";
import { encoded } from "./bytes.ts";

export const kDigest = 7;
export const kComponent = 3;

/** A connection as the node sees it. */
export class Served {
  readonly received: Message[] = [];
  unsent = 0;
  closed = false;
  answersPing = true;
  private readonly stream = new Stream();
  private readonly events: TransportEvents;

  constructor(events: TransportEvents) {
    this.events = events;
  }

  connection(): Connection {
    return {
      send: (bytes) =>
        this.stream.add(bytes, (part) => {
          const message = { ...part, body: part.body.slice() };
          this.received.push(message);
          queueMicrotask(() => this.closed || this.serve(message));
        }),
      unsent: () => this.unsent,
      close: () => (this.closed = true),
    };
  }

  open(): void {
    this.events.open();
  }
  end(why: string): void {
    this.closed = true;
    this.events.end(why);
  }
  send(bytes: Uint8Array): void {
    this.events.bytes(bytes);
  }
  control(code: number, text = "", call = 0): void {
    this.send(encodeControl(call, { code, type: 0, recipient: 0, operation: 0, text }));
  }
  reply(call: number, body: Uint8Array): void {
    this.send(encode(Kind.reply, 0, call, body));
  }
  event(subscription: number, body: Uint8Array): void {
    this.send(encode(Kind.event, 0, subscription, body));
  }

  /** Requests to the component, with their calls. */
  requests(): { operation: number; call: number; kind: number }[] {
    return this.received
      .filter(({ kind, identifier }) => (kind === Kind.request || kind === Kind.command) && identifier === kComponent)
      .map(({ body, kind }) => {
        const fields = new DataView(body.buffer);
        return { operation: fields.getUint32(0, true), call: kind === Kind.request ? fields.getUint32(4, true) : 0, kind };
      });
  }
  controls(): { code: number; text: string }[] {
    return this.received.filter(({ kind }) => kind === Kind.control).map(({ body }) => decodeControl(body));
  }
  /** The identifiers that were chosen for subscriptions. */
  subscriptions(): number[] {
    return this.directory(Directory.subscribe).map((body) => new DataView(body.buffer).getUint32(16, true));
  }

  private directory(operation: number): Uint8Array[] {
    return this.received
      .filter(({ kind, identifier }) => kind === Kind.request && identifier === Directory.identifier)
      .map(({ body }) => body)
      .filter((body) => new DataView(body.buffer).getUint32(0, true) === operation);
  }

  private serve({ kind, identifier, body }: Message): void {
    if (kind === Kind.control && this.answersPing && decodeControl(body).code === Code.ping) this.control(Code.pong);
    if (kind !== Kind.request || identifier !== Directory.identifier) return;
    const from = new Reader(body);
    const operation = from.view.getUint32(from.place(4, 4), true);
    const call = from.view.getUint32(from.place(4, 4), true);
    if (operation === Directory.find) {
      const name = from.text();
      const identifierOf = name === "Lamp" ? kComponent : 0;
      this.reply(call, encoded(ComponentEntry, { identifier: identifierOf, name, interface: "Lamp", digest: kDigest }));
    } else {
      this.reply(call, new Uint8Array(4));
    }
  }
}

/** A node that can be connected to many times. */
export class NodeDouble {
  readonly served: Served[] = [];
  readonly log: string[] = [];
  readonly dial: Dial = (events) => {
    const made = new Served(events);
    this.served.push(made);
    return made.connection();
  };

  get last(): Served {
    return this.served.at(-1)!;
  }

  /** A peer that is connected; the node has opened its first connection. */
  async peer(options: PeerOptions = {}): Promise<Peer> {
    const peer = new Peer("test", this.dial, { log: (line) => this.log.push(line), ...options });
    this.last.open();
    return peer.connected();
  }
}

/** Until all that was begun at once is done. */
export async function settle(): Promise<void> {
  for (let i = 0; i < 50; ++i) await Promise.resolve();
}
