// SPDX-License-Identifier: Apache-2.0
import { useState } from "react";
import { useHeld } from "./held.ts";
import { is_mine, kHold, press_key, seat } from "./seat.ts";

/** What the robot does for its operator alone: from the seat, by a button that is held for a second. */
export function HeldAct({ name, act, tell }: { name: string; act: () => void; tell: (why: string) => void }) {
  const mine = seat.use(is_mine);
  const [time, set_time] = useState(0);
  const { held, props } = useHeld(() => {
    set_time(0);
    tell(""); // what the last hold did
    return press_key(act, set_time, tell);
  });
  const share = held ? Math.min(1, time / kHold) : 0;
  return (
    <button type="button" className="hold act" disabled={!mine} {...props}
      title={mine ? "Hold it for 1 s: mouse, finger, Space or Enter. One act each time." : "Take the operator's seat first, at the top"}>
      <progress value={share} aria-hidden="true" />
      <span>{`${name}: hold for 1 s`}</span>
    </button>
  );
}
