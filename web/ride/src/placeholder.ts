// SPDX-License-Identifier: Apache-2.0
import { nameOf, RideError } from "./error.ts";
import type { Peer } from "./peer.ts";
import type { RemoteComponent } from "./component.ts";
import { type Handler, type SubscribeOptions, Subscription } from "./subscription.ts";
import { event, type EventType, nothing, type Parameter, string, type Type } from "./types.ts";

/** How a request is sent, and how long its answer is waited for. */
export interface CallOptions {
  /** In ms; Infinity: as long as the connection lasts. A request's is 1000, a command's Infinity. */
  deadline?: number;
  /** 0 to 255, the most urgent. */
  priority?: number;
}

/** The name of a command that failed, and why. */
export interface Failed {
  command: string;
  reason: string;
}
export const Failed = event<Failed>("Failed", 0xfe87f3c0, { command: string, reason: string });

const kRequestDeadline = 1000;

/** Stands for a component of another process. rcidl derives a class from it for each interface. */
export class Placeholder {
  readonly peer: Peer;
  /** The component's name at the other side. */
  readonly name: string;
  private readonly component: RemoteComponent;

  constructor(peer: Peer, name: string, interfaceName: string, digest: number) {
    this.peer = peer;
    this.name = name;
    this.component = peer.component(name, interfaceName, digest);
  }

  /** Calls `handler` for each command of the component that was sent and failed. */
  on_failed(handler: Handler<Failed>, options?: SubscribeOptions): Subscription<Failed> {
    return this.subscribe(Failed, handler, options);
  }

  /** Sends a request; done with its result. */
  protected request<T>(
    operation: string,
    number: number,
    parameters: Parameter[],
    result: Type<T>,
    options: CallOptions = {},
  ): Promise<T> {
    const all = { deadline: kRequestDeadline, priority: 0, ...options };
    return this.peer.request(this.component, number, parameters, result, all).catch((error: unknown) => {
      throw this.named(operation, error);
    });
  }

  /** Begins a command; done when it has ended, and failed if it was refused, failed or cancelled. */
  protected command(
    operation: string,
    number: number,
    parameters: Parameter[],
    options: CallOptions = {},
  ): Promise<void> {
    return this.request(operation, number, parameters, nothing, { deadline: Infinity, ...options });
  }

  protected subscribe<T>(type: EventType<T>, handler: Handler<T>, options: SubscribeOptions = {}): Subscription<T> {
    return this.peer.subscribe(this.component, type, handler, options);
  }

  private named(operation: string, error: unknown): unknown {
    if (!(error instanceof RideError)) return error;
    const text = error.message || nameOf(error.code);
    return new RideError(error.code, `'${this.name}' at ${this.peer.address}, ${operation}: ${text}`);
  }
}
