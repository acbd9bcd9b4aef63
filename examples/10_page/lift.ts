// An elevator in Node.js: the component of elevator.idl, without Armature.
import { type Call, Host, policy } from "@armature/ride/service";
import { listen } from "@armature/ride/tcp";
import { ElevatorService } from "./generated/elevator_service.js";

class Lift extends ElevatorService {
  private height = 0;
  private samples = 0n;
  private stop = new AbortController();

  top(): number {
    return 3;
  }

  async travel(target: number, call: Call): Promise<void> {
    if (!(target >= 0 && target <= this.top())) throw new Error("the target is outside the shaft");
    this.cancel_travel();
    const { signal } = (this.stop = new AbortController());
    const begin = this.height;
    while (this.height !== target) {
      await new Promise((resolve) => setTimeout(resolve, 10));
      if (signal.aborted || call.signal.aborted) throw new Error("cancelled");
      this.height += Math.max(-0.01, Math.min(0.01, target - this.height));
      const time = BigInt(Date.now()) * 1_000_000n;
      this.raise_Height({ sequence: ++this.samples, time, value: this.height });
      this.raise_travel_progress({ progress: (this.height - begin) / (target - begin) });
    }
  }

  cancel_travel(): void {
    this.stop.abort();
  }
}

const host = new Host({ allows: policy("allow local read,command Elevator") });
host.add("Elevator", new Lift());
const { address } = await listen(process.argv[2] ?? "tcp://127.0.0.1:4242", host);
console.log(`the lift is at ${address}`);
