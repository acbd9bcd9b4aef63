// SPDX-License-Identifier: Apache-2.0
// For Node.js: connections over TCP and socket files, beside all that pages have.
import * as net from "node:net";
import { type Accepting, type Connection, type Dial, Peer, type PeerOptions, type TransportEvents } from "@armature/ride";

export * from "@armature/ride";

type Target = { path: string } | { host: string; port: number };

function target(address: string): Target {
  if (address.startsWith("unix:")) return { path: address.slice("unix:".length) };
  const found = /^tcp:\/\/(\[[0-9a-fA-F:.]+\]|[^:/]+):(\d+)$/.exec(address);
  if (found === null) {
    throw new TypeError(`'${address}' must be an address such as tcp://127.0.0.1:4242 or unix:/run/robot.sock`);
  }
  return { host: found[1]!.replace(/^\[|\]$/g, ""), port: Number(found[2]) };
}

/** In ms, of a connection that was closed here and whose bytes nobody takes. */
const kLinger = 1000;

function carried(made: net.Socket, events: TransportEvents): Connection {
  let why = "the other side ended the connection";
  made.on("data", (chunk: Buffer) => events.bytes(new Uint8Array(chunk)));
  made.on("error", (error) => (why = error.message));
  made.on("close", () => events.end(why));
  return {
    send: (bytes) => void made.write(bytes),
    unsent: () => made.writableLength,
    close() {
      made.removeAllListeners("data").removeAllListeners("connect").removeAllListeners("close");
      made.destroySoon(); // what was said last goes first, if it is taken at all
      made.setTimeout(kLinger, () => made.destroy());
    },
  };
}

/** A transport to `tcp://host:port` or `unix:path`. */
export function socket(address: string): Dial {
  const to = target(address);
  return (events) => {
    const made = net.connect({ ...to, noDelay: true } as net.NetConnectOpts);
    made.on("connect", () => events.open());
    return carried(made, events);
  };
}

/** The process that listens at `address`; it is connected, or the promise says what is in the way. */
export async function connect(address: string, options?: PeerOptions): Promise<Peer> {
  return new Peer(address, socket(address), options).connected();
}

/** Where others connect to. */
export interface Listening {
  /** With the port that was got where any would do. */
  readonly address: string;
  /** Nobody is accepted any more. Connections that are there stay. */
  close(): void;
}

function taken(made: net.Socket): Dial {
  return (events) => {
    queueMicrotask(() => events.open());
    return carried(made.setNoDelay(true), events);
  };
}

const kLoopback = /^(localhost|127(\.\d+){3}|::1)$/;

/**
 * Listens at `tcp://127.0.0.1:4242`, `tcp://[::1]:0` or `unix:/run/robot.sock` for a `Host` of
 * @armature/ride/service, once the promise is done. Nothing here proves who connects: addresses that
 * other machines reach are refused, and a socket file is for its owner alone.
 */
export function listen(address: string, host: Accepting): Promise<Listening> {
  const at = target(address);
  if ("host" in at && !kLoopback.test(at.host)) {
    throw new TypeError(`'${address}': other machines would reach it without proving who they are; listen at 127.0.0.1`);
  }
  const transport = address.slice(0, address.indexOf(":"));
  const server = net.createServer((made) => {
    made.on("error", () => {});
    if (!host.accept(taken(made), transport)) made.destroy();
  });
  return new Promise((resolve, reject) => {
    server.once("error", (error) => reject(new Error(`'${address}': ${error.message}`)));
    const ready = () => resolve({ address: shown(address, server), close: () => void server.close() });
    if ("host" in at) return void server.listen(at, ready);
    const before = process.umask(0o177); // of the socket file, which is made at once
    server.listen(at, ready);
    process.umask(before);
  });
}

function shown(address: string, server: net.Server): string {
  const got = server.address();
  return got === null || typeof got === "string" ? address : address.replace(/:\d+$/, `:${got.port}`);
}
