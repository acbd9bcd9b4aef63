// SPDX-License-Identifier: Apache-2.0
// A node's side of connections: its components by their names, and who may do what with them.
import {
  type Accepting, array, Code, ComponentEntry, type Dial, Directory, encode, Failed, int, Kind, Link, type Message, Reader,
  RideError, type Serving, string, type Type, unsignedInt, Writer,
} from "@armature/ride";
import { Caller } from "./caller.ts";
import { type Access, isMalformed, type Operation, Service } from "./served.ts";

/** Who wants to do what. */
export interface Question {
  /** `local`, of a process of this machine that proves nothing. */
  readonly who: string;
  readonly component: string;
  readonly access: Access;
}

/** How a host works. */
export interface HostOptions {
  /** What the other side's log calls it. */
  name?: string;
  /** Who may do what, such as `policy(text)`; without, whoever reaches it may do everything. */
  allows?: (question: Question) => boolean;
  /** The largest body that is taken; 1 MiB. */
  bodyBytes?: number;
  /** In ms: a connection that is silent so long is asked whether it lives, and is lost after three times as long. */
  silence?: number;
  /** Connections at a time; later ones are sent away. 32. */
  connections?: number;
  /** Calls of one connection whose promises are open; later ones are BUSY. 1024. */
  owed?: number;
  /** Subscriptions of one connection; 256. */
  subscriptions?: number;
  /** Refusals, failures and losses. */
  log?: (line: string) => void;
}

const kDefaults = {
  name: "node",
  allows: () => true,
  bodyBytes: 1024 * 1024,
  silence: 1000,
  connections: 32,
  owed: 1024,
  subscriptions: 256,
  log: (line: string) => console.warn(line),
};

interface Hosted {
  readonly identifier: number;
  readonly name: string;
  readonly service: Service;
}

/** Hosts components: answers what others ask of them, over any number of connections. */
export class Host implements Accepting {
  private readonly options: Required<HostOptions>;
  private readonly hosted = new Map<number, Hosted>();
  private readonly callers = new Map<Link, Caller>();
  private last = 0;

  constructor(options: HostOptions = {}) {
    this.options = { ...kDefaults, ...options };
  }

  /** Gives a component a name, by which others find it. Throws if another one has it. */
  add(name: string, service: Service): void {
    if (this.named(name) !== undefined) throw new RideError(Code.failed, `a component '${name}' is there already`);
    const identifier = ++this.last;
    this.hosted.set(identifier, { identifier, name, service });
  }

  /** It is not found any more, and its subscriptions end. */
  remove(service: Service): void {
    for (const { identifier, service: other } of this.hosted.values()) {
      if (other !== service) continue;
      this.hosted.delete(identifier);
      for (const caller of this.callers.values()) caller.forget(service);
    }
  }

  /** Takes a connection of a program that listens. */
  accept(dial: Dial, transport: string): boolean {
    if (this.callers.size >= this.options.connections) return false;
    const { name, bodyBytes, silence } = this.options;
    const serving = this.serving(transport);
    const ignore = () => {};
    const link: Link = new Link(dial, { name, bodyBytes, silence, accepted: true, serving }, {
      open: ignore, reply: ignore, refused: ignore, event: ignore, lost: ignore, hello: ignore, end: ignore,
    });
    this.callers.set(link, this.caller(link, transport));
    return true;
  }

  /** For a Peer's options: what the other side of a connection asks for that this side has begun. */
  serving(transport: string): Serving {
    return {
      take: (link, message) => {
        const known = this.callers.get(link) ?? this.caller(link, transport);
        this.callers.set(link, known);
        this.take(known, message);
      },
      ended: (link) => {
        this.callers.get(link)?.end();
        this.callers.delete(link);
      },
    };
  }

  /** Tells everyone that it ends, and ends all connections. */
  close(): void {
    for (const link of [...this.callers.keys()]) link.shutDown("the program ends");
  }

  /** Events that subscribers had no room for, and answers that nobody took. */
  get dropped(): number {
    let sum = 0;
    for (const { dropped } of this.callers.values()) sum += dropped;
    return sum;
  }

  private caller(link: Link, transport: string): Caller {
    const who = transport === "tcp" || transport === "unix" ? "local" : `nobody@${transport}`;
    return new Caller(link, who, this.options.allows);
  }

  private named(name: string): Hosted | undefined {
    return [...this.hosted.values()].find((each) => each.name === name);
  }

  // --- messages ----------------------------------------------------------------------------------

  private take(caller: Caller, message: Message): void {
    const from = new Reader(message.body);
    let number = 0;
    let call = 0;
    try {
      number = from.view.getUint32(from.place(4, 4), true);
      if (message.kind === Kind.request) call = from.view.getUint32(from.place(4, 4), true);
    } catch {
      return caller.refuse(message, Code.malformed, "is too short for an operation");
    }
    if (message.identifier === Directory.identifier) return this.direct(caller, message, number, call, from);
    const hosted = this.hosted.get(message.identifier);
    if (hosted === undefined) return caller.refuse(message, Code.noSuchComponent, "no component has this identifier");
    const operation = Service.operation(hosted.service, number);
    if (operation === undefined) {
      return caller.refuse(message, Code.noSuchOperation, `'${hosted.name}' has no operation 0x${number.toString(16)}`);
    }
    const refusal = caller.refusal(hosted.name, operation.access);
    if (refusal !== undefined) return this.refuse(caller, message, Code.notAllowed, refusal);
    if (caller.owed >= this.options.owed) return caller.refuse(message, Code.busy, "too many answers are owed");
    this.execute(caller, message, hosted, operation, from, call);
  }

  private refuse(caller: Caller, message: Message, code: number, text: string): void {
    this.options.log(text);
    caller.refuse(message, code, text);
  }

  /** What does not take its time has ended before the next message is looked at: its body is used no longer. */
  private execute(
    caller: Caller, message: Message, hosted: Hosted, operation: Operation, from: Reader, call: number,
  ): void {
    const { kind, priority } = message;
    const answer = (body: Uint8Array) => {
      if (kind === Kind.request) caller.answer(encode(Kind.reply, priority, call, body));
    };
    try {
      const body = operation.run(from, caller);
      if (!(body instanceof Promise)) return answer(body);
      const begin = { ...message, body: message.body.slice(0, 8) };
      ++caller.owed;
      body
        .then(answer, (error: unknown) => this.failed(caller, begin, hosted, operation, error))
        .finally(() => --caller.owed);
    } catch (error) {
      this.failed(caller, message, hosted, operation, error);
    }
  }

  private failed(caller: Caller, message: Message, hosted: Hosted, operation: Operation, error: unknown): void {
    const text = error instanceof Error ? error.message : String(error);
    if (isMalformed(error)) return caller.refuse(message, Code.malformed, text);
    const denied = error instanceof RideError && error.code === Code.notAllowed;
    if (denied) return this.refuse(caller, message, Code.notAllowed, text);
    if (message.kind === Kind.request) return caller.refuse(message, Code.failed, text);
    this.options.log(`'${hosted.name}', ${operation.name} has failed: ${text}`);
    Service.raise(hosted.service, Failed, { command: operation.name, reason: text }, 0);
  }

  // --- the directory -----------------------------------------------------------------------------

  private direct(caller: Caller, message: Message, number: number, call: number, from: Reader): void {
    const answer = <T>(type: Type<T>, value: T) => {
      const body = new Writer();
      type.put(body, value);
      if (message.kind === Kind.request) caller.answer(encode(Kind.reply, message.priority, call, body.body()));
    };
    try {
      if (number === Directory.find) return answer(ComponentEntry, this.find(only(from, string)));
      if (number === Directory.list) {
        from.end();
        return answer(array(ComponentEntry), [...this.hosted.values()].map(entryOf));
      }
      if (number === Directory.subscribe) return answer(int, this.subscribe(caller, from));
      if (number === Directory.unsubscribe) return answer(int, caller.unsubscribe(only(from, int)) ? 0 : 1);
    } catch (error) {
      return caller.refuse(message, Code.malformed, error instanceof Error ? error.message : String(error));
    }
    caller.refuse(message, Code.noSuchOperation, "the directory has no such operation");
  }

  private find(name: string): ComponentEntry {
    const found = this.named(name);
    return found === undefined ? { identifier: 0, name, interface: "", digest: 0 } : entryOf(found);
  }

  /** 0, or the code of why not. */
  private subscribe(caller: Caller, from: Reader): number {
    const component = int.take(from);
    const event = unsignedInt.take(from);
    const subscription = only(from, int);
    const hosted = this.hosted.get(component);
    if (hosted === undefined) return 1;
    if (caller.refusal(hosted.name, "read") !== undefined) return 6;
    if (caller.has(subscription)) return 3;
    if (caller.subscriptions >= this.options.subscriptions) return 7;
    return caller.subscribe(hosted.service, event, subscription) ? 0 : 2;
  }
}

function only<T>(from: Reader, type: Type<T>): T {
  const value = type.take(from);
  from.end();
  return value;
}

function entryOf({ identifier, name, service }: Hosted): ComponentEntry {
  return { identifier, name, ...Service.entry(service) };
}
