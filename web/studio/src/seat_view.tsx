// SPDX-License-Identifier: Apache-2.0
import type { Guest } from "./backend.ts";
import { hand_over, is_mine, leave_seat, seat, take_seat } from "./seat.ts";

const name_of = ({ number, who }: Guest): string => `browser ${number} (${who})`;

/** Who operates the robot: always at the same place. */
export function SeatView() {
  const state = seat.use((all) => all);
  const mine = is_mine(state);
  const holder = state.guests.find((one) => one.number === state.holder);
  const others = state.guests.filter((one) => one.number !== state.you && one.may_operate);
  const title = `${holder ? `${name_of(holder)} operates. ` : ""}Who sits at the operator's seat arms the robot. It is handed over or left, never taken from somebody who is there.`;
  return (
    <div className={`seat ${mine ? "is-mine" : ""}`} role="group" aria-label="Operator's seat" title={title}>
      <span role="status">{mine ? "You operate" : holder ? `Browser ${holder.number} operates` : "The seat is free"}</span>
      {!mine && !holder && <button type="button" onClick={() => void take_seat()}>Take the seat</button>}
      {mine && others.length > 0 && (
        <select aria-label="Hand the seat over" value="" onChange={(event) => void hand_over(Number(event.target.value))}>
          <option value="" disabled>Hand over</option>
          {others.map((one) => <option key={one.number} value={one.number}>{`to ${name_of(one)}`}</option>)}
        </select>
      )}
      {mine && <button type="button" onClick={() => void leave_seat()}>Leave</button>}
      {!mine && holder && <small>{`you are browser ${state.you}`}</small>}
    </div>
  );
}
