// SPDX-License-Identifier: Apache-2.0
// The operator's seat, and the key that is held there.
import { type Backend, message_of, type SeatState, type Workbench } from "./backend.ts";
import { Store } from "./store.ts";
import { tell } from "./selection.ts";

const kNobody: SeatState = { you: 0, holder: 0, guests: [] };
const kRenewal = 50;  ///< of the key [ms]

/** So long the key is held before anything happens [s]; the studio measures it. */
export const kHold = 1;

export const seat = new Store<SeatState>(kNobody);

let backend: Backend;

export const workbench = (): Workbench => backend.workbench;
export const is_mine = ({ you, holder }: SeatState): boolean => you !== 0 && you === holder;

export function open_seat(from: Backend): void {
  backend = from;
  backend.workbench.on_SeatChanged(() => void look());
  backend.on_connection(({ connected }) => (connected ? void look() : seat.set(kNobody)));
  void look();
}

async function look(): Promise<void> {
  seat.set(await backend.workbench.seat().catch(() => kNobody));
}

const become = (asked: Promise<SeatState>): Promise<void> => asked.then((state) => seat.set(state), (error: unknown) => tell(message_of(error)));

export const take_seat = (): Promise<void> => become(backend.workbench.take_seat());
export const leave_seat = (): Promise<void> => become(backend.workbench.leave_seat());
export const hand_over = (guest: number): Promise<void> => become(backend.workbench.hand_over(guest));

/** Holds the key down; returns what lets go of it. `show` is told for how long it has been held [s], `act` once that is enough. */
export function press_key(act: () => void, show: (held: number) => void, refused: (why: string) => void): () => void {
  let down = true;
  let acted = false;
  const let_go = (): void => {
    if (!down) return;
    down = false;
    clearInterval(timer);
    void backend.workbench.hold_key(false).catch(() => undefined);
  };
  const renew = async (): Promise<void> => {
    const held = await backend.workbench.hold_key(true);
    if (!down) return;
    show(held);
    if (held < kHold || acted) return;
    acted = true;
    act();
  };
  const fail = (error: unknown): void => {
    if (down) refused(message_of(error));
    let_go();
  };
  const timer = setInterval(() => void renew().catch(fail), kRenewal);
  void renew().catch(fail);
  return let_go;
}
