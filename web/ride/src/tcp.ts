// SPDX-License-Identifier: Apache-2.0
// For Node.js: connections over TCP and socket files, beside all that pages have.
import * as net from "node:net";
import { type Dial, Peer, type PeerOptions } from "@armature/ride";

export * from "@armature/ride";

function target(address: string): net.NetConnectOpts {
  if (address.startsWith("unix:")) return { path: address.slice("unix:".length) };
  const found = /^tcp:\/\/(\[[0-9a-fA-F:.]+\]|[^:/]+):(\d+)$/.exec(address);
  if (found === null) {
    throw new TypeError(`'${address}' must be an address such as tcp://127.0.0.1:4242 or unix:/run/robot.sock`);
  }
  return { host: found[1]!.replace(/^\[|\]$/g, ""), port: Number(found[2]) };
}

/** A transport to `tcp://host:port` or `unix:path`. */
export function socket(address: string): Dial {
  const to = target(address);
  return (events) => {
    const made = net.connect({ ...to, noDelay: true } as net.NetConnectOpts);
    let why = "the other side ended the connection";
    made.on("connect", () => events.open());
    made.on("data", (chunk: Buffer) => events.bytes(new Uint8Array(chunk)));
    made.on("error", (error) => (why = error.message));
    made.on("close", () => events.end(why));
    return {
      send: (bytes) => void made.write(bytes),
      unsent: () => made.writableLength,
      close() {
        made.removeAllListeners("data").removeAllListeners("connect").removeAllListeners("close");
        made.destroy();
      },
    };
  };
}

/** The process that listens at `address`; it is connected, or the promise says what is in the way. */
export async function connect(address: string, options?: PeerOptions): Promise<Peer> {
  return new Peer(address, socket(address), options).connected();
}
