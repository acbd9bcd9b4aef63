// SPDX-License-Identifier: Apache-2.0
// The emergency stop: from every browser, at any time.
import { message_of } from "./backend.ts";
import { workbench } from "./seat.ts";
import { tell } from "./selection.ts";

const kDeadline = 3000;  ///< [ms]; the studio itself waits for a second
const kMostUrgent = 255;

export async function emergency_stop(): Promise<void> {
  try {
    const { disarmed, stopped } = await workbench().emergency_stop({ deadline: kDeadline, priority: kMostUrgent });
    const done = disarmed.length > 0 ? `E-stop: ${disarmed.join(", ")} disarmed.` : "";
    tell(stopped ? `${done} E-stop: ${stopped}, so the run is being stopped. Once more: at once.`.trim() : done);
  } catch (error) {
    tell(`E-stop: ${message_of(error)}. If anything moves, press the robot's own switch.`);
  }
}
