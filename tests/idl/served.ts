// SPDX-License-Identifier: Apache-2.0
// Components in TypeScript, by the interfaces in idl/testdata: served over TCP until the input ends.
// With CALLER in the environment it starts that program, which calls them, and ends as that ends.
import { spawn } from "node:child_process";
import { Code, connect, listen } from "@armature/ride/tcp";
import { type Call, Host, policy, RideError } from "@armature/ride/service";
import * as chassis from "./chassis.js";
import { ChassisService, ChassisService_Service } from "./chassis_service.js";
import * as everything from "./everything.js";
import { EchoService } from "./everything_service.js";
import * as geometry from "./geometry.js";

const inner: everything.Inner = { flag: false, value: 0 };
const three = [0, 0, 0];
const nothing: everything.Everything = {
  singles: { b: false, c: 0, o: 0, s: 0, us: 0, i: 0, ui: 0, l: 0n, ul: 0n, f: 0, d: 0, text: "", inner },
  lists: { b: [], c: [], o: new Uint8Array(0), s: [], us: [], i: [], ui: [], l: [], ul: [], f: [], d: [], text: [], inner: [] },
  fixed: {
    b: [false, false, false], c: three, o: three, s: three, us: three, i: three, ui: three, l: [0n, 0n, 0n], ul: [0n, 0n, 0n],
    f: three, d: three, text: ["", ""], inner: [inner, inner],
  },
};

/** Gives everything back. */
class Echo extends EchoService {
  override echo_bool = (value: boolean) => value;
  override echo_char = (value: number) => value;
  override echo_byte = (value: number) => value;
  override echo_short = (value: number) => value;
  override echo_unsigned_short = (value: number) => value;
  override echo_int = (value: number) => value;
  override echo_unsigned_int = (value: number) => value;
  override echo_long = (value: bigint) => value;
  override echo_unsigned_long = (value: bigint) => value;
  override echo_float = (value: number) => value;
  override echo_double = (value: number) => value;
  override echo_string = (value: string) => value;
  override echo_singles = (value: everything.Singles) => value;
  override echo_lists = (value: everything.Lists) => value;
  override echo_fixed = (value: everything.Fixed) => value;
  override echo_ranges = (value: everything.Ranges) => value;
  override echo_flags = (value: boolean[]) => value;
  override echo_two_flags = (value: boolean[]) => value;
  override echo_strings = (value: string[]) => value;
  override echo_inners = (value: everything.Inner[]) => value;
  override echo_ranged = (value: everything.Ranges[], small: Uint8Array) => value.slice(0, small.length);
  override echo_mode = (value: everything.Mode) => value;
  override echo_frame = (value: geometry.Frame) => value;
  override echo_choices = (value: everything.Choices) => value;
  override echo_modes = (value: everything.Mode[]) => value;
  override echo_two = (value: everything.Small[]) => value;
  override change_mode(mode: everything.Mode): void {
    this.raise_ModeChanged({ mode, before: [] });
  }
  override delete(...all: [number, number, number, number, number, number, Call]): number {
    return all.slice(0, 6).reduce<number>((sum, each) => sum * 10 + Number(each), 0);
  }
  override async request_(name: string, part: number): Promise<void> {
    if (name === "fail") throw new Error(`no part of ${part}`);
  }
  override nothing(): void {
    this.raise_Everything(nothing);
  }
}

/** Where it stands it says later, and how many went before that. */
class Wheels extends ChassisService {
  private left = 0;
  private speed: [number, number] = [0, 0];
  override setVelocity(left: number, right: number): void {
    this.speed = [left, right];
  }
  override async follow({ points }: chassis.Route, _speed: number, call: Call): Promise<number> {
    call.demand("map", "configure");
    return points.length;
  }
  override where(): geometry.Pose {
    return { x: this.speed[0], y: this.speed[1], heading: this.left };
  }
  override async whereItStands(limit: number, call: Call): Promise<geometry.Pose> {
    if (limit === 0) throw new RideError(Code.failed, "it is driving");
    if (limit === 60) {
      await new Promise((resolve) => call.signal.addEventListener("abort", resolve));
      ++this.left;
    }
    await new Promise((resolve) => setTimeout(resolve, limit));
    const pose = { x: 3, y: 0, heading: 0.5 };
    this.raise_Arrived({ pose, at: 1n });
    return pose;
  }
  override touched(call: Call): boolean[] {
    return [call.allows("wheels", "read"), call.allows("wheels", "configure")];
  }
}

class Workshop extends ChassisService_Service {
  override setGains(): number {
    return 1;
  }
}

const host = new Host({ allows: policy("allow local read,command *"), log: () => {} });
host.add("echo", new Echo());
host.add("wheels", new Wheels());
host.add("workshop", new Workshop());
const { address } = await listen("tcp://127.0.0.1:0", host);
const caller = process.env["CALLER"];
if (caller === undefined) {
  console.log(address);
  process.stdin.on("end", () => process.exit(0)).resume();
} else {
  spawn(caller, { stdio: "inherit", env: { ...process.env, SERVICE: address } }).on("exit", async (code) => {
    // What is not known to be there is not waited for.
    const peer = await connect(address);
    process.exit(code === 0 && (await peer.list()).length === 3 ? 0 : 1);
  });
}
