import { connectPage } from "./ride.js";
import { ElevatorPlaceholder } from "./elevator.js";

const at = (id) => document.getElementById(id);
const peer = await connectPage().catch((error) => (at("told").textContent = error.message));
const elevator = new ElevatorPlaceholder(peer, "Elevator");
const travel = (target) => elevator.travel(target).then(() => `arrived at ${target} m`, (error) => error.message);
elevator.on_Height(({ value }) => (at("height").value = at("shaft").value = value.toFixed(2)), { keep: 1 });
at("go").onclick = async () => (at("told").textContent = await travel(at("target").valueAsNumber));
at("stop").onclick = () => elevator.cancel_travel();
peer.on_change(({ connected, text }) => (at("told").textContent = connected ? "connected" : `lost: ${text}`));
