// SPDX-License-Identifier: Apache-2.0
// The same from Node.js, over TCP: node operator.mjs tcp://127.0.0.1:4242
import { connect } from "@armature/ride/tcp";
import { ElevatorPlaceholder } from "./generated/elevator.js";

const peer = await connect(process.argv[2] ?? "tcp://127.0.0.1:4242");
const elevator = new ElevatorPlaceholder(peer, "Elevator");
let height = 0;
elevator.on_Height(({ value }) => void (height = value));
console.log(`the shaft ends at ${await elevator.top()} m`);
await elevator.travel(5).catch((error: Error) => console.log(error.message));
await elevator.travel(0.2);
console.log(`arrived at ${height.toFixed(1)} m`);
const cancelled = elevator.travel(3).catch((error: Error) => console.log(error.message));
await elevator.cancel_travel();
await cancelled;
peer.close();
