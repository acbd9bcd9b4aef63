// SPDX-License-Identifier: Apache-2.0
import type { Dial, TransportEvents } from "./transport.ts";

/** Larger frames come from no node of Armature. */
const kMostFrameBytes = 1024 * 1024;
/** A node takes no larger frames. */
const kSentAtOnce = 64 * 1024;

function receive(events: TransportEvents, data: unknown): string | undefined {
  if (!(data instanceof ArrayBuffer)) return "it sent a frame that is not binary";
  if (data.byteLength > kMostFrameBytes) return `it sent a frame of ${data.byteLength} bytes`;
  events.bytes(new Uint8Array(data));
  return undefined;
}

/** Binary frames of a WebSocket: pieces of the stream, whose borders mean nothing. */
export function websocket(url: string): Dial {
  return (events) => {
    const socket = new WebSocket(url);
    socket.binaryType = "arraybuffer";
    let ended = false;
    const end = (why: string) => {
      if (!ended) events.end(why);
      ended = true;
    };
    socket.onopen = () => events.open();
    socket.onmessage = ({ data }) => {
      if (ended) return;
      const problem = receive(events, data);
      if (problem === undefined) return;
      socket.close();
      end(problem);
    };
    socket.onclose = ({ reason }) => end(reason || "the connection was closed or refused");
    return {
      send(bytes) {
        for (let at = 0; at < bytes.length; at += kSentAtOnce) socket.send(bytes.slice(at, at + kSentAtOnce));
      },
      unsent: () => socket.bufferedAmount,
      close() {
        ended = true;
        socket.close();
      },
    };
  };
}
