// SPDX-License-Identifier: Apache-2.0
// What pages and generated placeholders use.
import { enter } from "./entry.ts";
import { Peer, type PeerOptions } from "./peer.ts";
import { websocket } from "./websocket.ts";

export { Code, nameOf, RideError } from "./error.ts";
export { Reader, Writer } from "./fields.ts";
export { ComponentEntry, Directory } from "./directory.ts";
export { Link, type LinkOptions, type Serving } from "./link.ts";
export { Peer, type PeerChange, type PeerOptions } from "./peer.ts";
export { type CallOptions, Failed, Placeholder } from "./placeholder.ts";
export { type Handler, type SubscribeOptions, Subscription } from "./subscription.ts";
export type { Accepting, Connection, Dial, TransportEvents } from "./transport.ts";
export * from "./types.ts";
export { encode, Kind, type Message, numberOf } from "./wire.ts";
export { websocket } from "./websocket.ts";

/**
 * The application that serves this page; connected, or the promise says what is in the way. The
 * token that the page's address ends with is exchanged for a cookie first, and taken out of it.
 */
export async function connectPage(options?: PeerOptions): Promise<Peer> {
  await enter();
  const address = `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/`;
  return new Peer(address, websocket(address), options).connected();
}
