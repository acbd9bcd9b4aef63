// SPDX-License-Identifier: Apache-2.0
// An axis, of joints or of a tool, moves as long as somebody holds on to it: the run ends what is not renewed for 150 ms.
import { message_of } from "./backend.ts";
import { inspector } from "./run.ts";

const kRenewal = 50;      ///< [ms]
const kMostWaiting = 3;   ///< renewals without an answer: a connection that is stalled gets no more

/** Moves an axis (from 1); returns what lets go of it. `tell` is told why it does not move, or no more. */
export function press_jog(component: string, axis: number, velocity: number, tell: (why: string) => void, frame = ""): () => void {
  const words = [String(axis), String(velocity)];
  let held = true;
  let begun = false;
  let handle = -1;
  let waiting = 0;
  const end = (why = ""): void => {
    if (!held) return;
    held = false;
    clearInterval(timer);
    if (handle >= 0) void inspector().cancel(handle).catch(() => undefined);
    tell(why);
  };
  const renew = async (): Promise<void> => {
    if (waiting >= kMostWaiting) return;
    ++waiting;
    const { value } = await inspector().call(component, "keepJogging", words).finally(() => --waiting);
    if (begun && value === "false") end("it came to rest");
  };
  const fail = (error: unknown): void => end(message_of(error));
  const timer = setInterval(() => void renew().catch(fail), kRenewal);
  const begin = async (): Promise<void> => {
    // Whatever others have chosen meanwhile: it moves as this page shows.
    if (frame) await inspector().write(`${component}.jog_frame`, frame);
    if (!held) return;
    const status = await inspector().begin(component, "jog", words);
    begun = true;
    handle = status.handle;
    if (!held) void inspector().cancel(handle).catch(() => undefined);
    else if (status.ended) end(status.reason);
  };
  void begin().catch(fail);
  return () => end();
}
