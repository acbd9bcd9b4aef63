// SPDX-License-Identifier: Apache-2.0
// What a component is here, for others: operations that are asked for, and events that it raises.
import { Code, type EventType, encode, Failed, Kind, Reader, RideError, taken, type Type, Writer } from "@armature/ride";

/** What a policy speaks of: to look, to move, to change. */
export type Access = "read" | "command" | "configure";

/** A call of an operation, for those who want to know who asks. */
export interface Call {
  /** As policies say it: `local`. */
  readonly who: string;
  /** Aborted when the connection ends by which it came: nobody waits any more. */
  readonly signal: AbortSignal;
  /** Whether the policy lets the caller do so to `component`, which this process need not host. */
  allows(component: string, access: Access): boolean;
  /** Refuses the call with NOT_ALLOWED if it does not. */
  demand(component: string, access: Access): void;
}

/** Takes the parameters of a call, in their order. Throws a RideError that says which is malformed. */
export class Parameters {
  /** All of them were taken, and nothing is left: what fails from now on is the operation. */
  complete = false;
  private readonly from: Reader;
  private readonly by: Call;

  constructor(from: Reader, by: Call) {
    this.from = from;
    this.by = by;
  }
  take<T>(name: string, type: Type<T>): T {
    return taken(name, type, this.from);
  }
  /** There are no more. */
  call(): Call {
    this.from.end();
    this.complete = true;
    return this.by;
  }
}

type Run = (from: Reader, call: Call) => Uint8Array | Promise<Uint8Array>;

/** An operation that others may ask for. */
export interface Operation {
  readonly name: string;
  readonly access: Access;
  /** Takes the parameters at once, executes it, and gives the body of the answer, at once if its function does. */
  readonly run: Run;
}

/** Who hears an event. */
export interface Subscriber {
  /** False: it had no room for it. */
  send(message: Uint8Array): boolean;
  readonly subscription: number;
}

/** Thrown while parameters are taken: the call was malformed, rather than failed. */
class Malformed extends RideError {}

/** True if what was asked was none of the operation's, rather than that it failed. */
export function isMalformed(error: unknown): boolean {
  return error instanceof Malformed;
}

/**
 * A component that others use. rcidl derives an abstract class from it for each interface, from which
 * its author derives; a Host gives it a name.
 *
 * An operation is a function with the interface's parameters and a Call. It returns its result, or a
 * promise of it; a command is done when its promise is. What it throws goes to the caller.
 */
export abstract class Service {
  readonly #interface: string;
  readonly #digest: number;
  readonly #events: ReadonlySet<number>;
  readonly #operations = new Map<number, Operation>();
  readonly #subscribers = new Map<number, Set<Subscriber>>();

  constructor(interfaceName: string, digest: number, events: readonly { readonly number: number }[]) {
    this.#interface = interfaceName;
    this.#digest = digest;
    this.#events = new Set([...events.map(({ number }) => number), Failed.number]);
  }

  /** For generated code: an operation of `service`. */
  static define<T>(
    service: Service, name: string, number: number, access: Access, result: Type<T>,
    run: (parameters: Parameters) => T | Promise<T>,
  ): void {
    service.#operations.set(number, {
      name,
      access,
      run(from, call) {
        const answer = (value: T) => {
          const body = new Writer();
          result.put(body, value);
          return body.body();
        };
        const value = begun(run, from, call);
        return value instanceof Promise ? value.then(answer) : answer(value);
      },
    });
  }

  /**
   * For generated code: tells all subscribers, and returns how many had no room for it. Throws if
   * `members` are not those of the event.
   */
  static raise<T>(service: Service, type: EventType<T>, members: T, priority: number): number {
    const subscribers = service.#subscribers.get(type.number);
    const body = new Writer();
    body.count(type.number);
    type.put(body, members);
    let dropped = 0;
    for (const each of subscribers ?? []) {
      if (!each.send(encode(Kind.event, priority, each.subscription, body.body()))) ++dropped;
    }
    return dropped;
  }

  // --- for the Host ------------------------------------------------------------------------------

  /** @internal */
  static entry(service: Service): { interface: string; digest: number } {
    return { interface: service.#interface, digest: service.#digest };
  }
  /** @internal */
  static operation(service: Service, number: number): Operation | undefined {
    return service.#operations.get(number);
  }
  /** @internal False: it raises no such event. */
  static subscribe(service: Service, event: number, subscriber: Subscriber): boolean {
    if (!service.#events.has(event)) return false;
    const known = service.#subscribers.get(event) ?? new Set();
    service.#subscribers.set(event, known.add(subscriber));
    return true;
  }
  /** @internal */
  static unsubscribe(service: Service, subscriber: Subscriber): void {
    for (const each of service.#subscribers.values()) each.delete(subscriber);
  }
}

/** Parameters are taken in the arguments of the operation's function. */
function begun<T>(run: (parameters: Parameters) => T | Promise<T>, from: Reader, call: Call): T | Promise<T> {
  const parameters = new Parameters(from, call);
  try {
    return run(parameters);
  } catch (error) {
    if (parameters.complete || !(error instanceof RideError)) throw error;
    throw new Malformed(Code.malformed, error.message);
  }
}
