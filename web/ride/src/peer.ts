// SPDX-License-Identifier: Apache-2.0
import { Calls } from "./calls.ts";
import { deliver, RemoteComponent, type SharedSubscription } from "./component.ts";
import { ComponentEntry, Directory } from "./directory.ts";
import { Code, nameOf, RideError } from "./error.ts";
import { Reader, Writer } from "./fields.ts";
import { Link, type Serving } from "./link.ts";
import { type Handler, type SubscribeOptions, Subscription } from "./subscription.ts";
import type { Dial } from "./transport.ts";
import { array, type EventType, int, parameter, type Parameter, string, type Type, unsignedInt } from "./types.ts";
import { encode, Kind } from "./wire.ts";

/** How a peer works; times in ms. */
export interface PeerOptions {
  /** What the other side's log calls this one. */
  name?: string;
  /** The largest body that is taken; 1 MiB. */
  bodyBytes?: number;
  /** A connection that is silent so long is asked whether it lives, and is lost after three times as long. */
  silence?: number;
  /** The pause before the first attempt to come back; it doubles up to the most. */
  firstPause?: number;
  mostPause?: number;
  /** What is dropped or refused without anybody who waits for it. */
  log?: (line: string) => void;
  /** What answers the commands and requests of the other side; see `Host` of @armature/ride/service. */
  serving?: Serving;
}

/** What has become of the connection. */
export interface PeerChange {
  connected: boolean;
  /** Why it was lost; empty when it came back. */
  text: string;
}

const kDirectoryDeadline = 1000;
const kDefaults = {
  name: "page",
  bodyBytes: 1024 * 1024,
  silence: 1000,
  firstPause: 20,
  mostPause: 2000,
  log: (line: string) => console.warn(line),
};

type Sending = { deadline: number; priority: number };
const kPlain: Sending = { deadline: kDirectoryDeadline, priority: 0 };

/** Another process, by a connection that comes back by itself. Nothing is sent a second time. */
export class Peer {
  readonly address: string;
  /** How often the connection was lost. */
  losses = 0;
  private readonly dial: Dial;
  private readonly options: Required<Omit<PeerOptions, "serving">> & Pick<PeerOptions, "serving">;
  private readonly calls = new Calls();
  private readonly components = new Map<string, RemoteComponent>();
  private readonly subscriptions = new Map<number, SharedSubscription>();
  private readonly changes = new Set<(change: PeerChange) => void>();
  private link: Link;
  private lastSubscription = 0;
  private pause: number;
  private ready = false;
  private closed = false;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private search: ReturnType<typeof setInterval> | undefined;

  constructor(address: string, dial: Dial, options: PeerOptions = {}) {
    this.address = address;
    this.dial = dial;
    this.options = { ...kDefaults, ...options };
    this.pause = this.options.firstPause;
    this.link = this.connect();
  }

  /** Done once it is connected. Fails, and gives up, if the first attempt does. */
  connected(): Promise<Peer> {
    if (this.ready) return Promise.resolve(this);
    return new Promise((resolve, reject) => {
      const told = (change: PeerChange) => {
        this.changes.delete(told);
        if (change.connected) return resolve(this);
        this.close();
        reject(new RideError(Code.notConnected, `${this.address}: ${change.text}`));
      };
      this.changes.add(told);
    });
  }

  isConnected(): boolean {
    return this.ready;
  }

  /** Calls `handler` at each loss and recovery; returns what ends that. */
  on_change(handler: (change: PeerChange) => void): () => void {
    this.changes.add(handler);
    return () => void this.changes.delete(handler);
  }

  /** What the other side hosts. */
  async list(): Promise<ComponentEntry[]> {
    return this.ask(Directory.identifier, Directory.list, [], array(ComponentEntry), kPlain);
  }

  /** Ends the connection, and does not come back. Who waits for it is told. */
  close(): void {
    if (this.closed) return;
    const waitedFor = !this.ready;
    this.closed = true;
    clearTimeout(this.timer);
    this.link.close();
    this.forget("it was closed here");
    if (waitedFor) this.tell({ connected: false, text: "it was closed here" });
  }

  // --- for placeholders --------------------------------------------------------------------------

  /** @internal */
  component(name: string, interfaceName: string, digest: number): RemoteComponent {
    const key = `${interfaceName} ${digest} ${name}`;
    const known = this.components.get(key);
    if (known !== undefined) return known;
    const made = new RemoteComponent(name, interfaceName, digest);
    this.components.set(key, made);
    if (this.link.isOpen()) made.lookedUp = this.lookUp(made);
    return made;
  }

  /** @internal A component that is being looked up is waited for; a connection is not. */
  async request<T>(
    component: RemoteComponent, number: number, parameters: Parameter[], result: Type<T>, sending: Sending,
  ): Promise<T> {
    if (component.identifier === 0 && this.link.isOpen()) await component.lookedUp;
    if (component.identifier === 0) throw component.problem;
    return this.ask(component.identifier, number, parameters, result, sending);
  }

  /** @internal */
  subscribe<T>(
    component: RemoteComponent, type: EventType<T>, handler: Handler<T>, options: SubscribeOptions,
  ): Subscription<T> {
    const known = component.subscriptions.get(type.number);
    const shared = known ?? { identifier: ++this.lastSubscription, type, handlers: new Set<Subscription>() };
    const made = new Subscription(handler, options, () => {
      shared.handlers.delete(made as Subscription);
      if (shared.handlers.size === 0) this.unsubscribe(component, shared);
    });
    shared.handlers.add(made as Subscription);
    if (known === undefined) {
      component.subscriptions.set(type.number, shared);
      this.subscriptions.set(shared.identifier, shared);
      if (component.identifier !== 0) void this.subscribeThere(component, shared);
    }
    return made;
  }

  // --- messages ----------------------------------------------------------------------------------

  private async ask<T>(
    recipient: number, number: number, parameters: Parameter[], result: Type<T>, { deadline, priority }: Sending,
  ): Promise<T> {
    const body = new Writer();
    body.count(number);
    const place = body.place(4, 4);
    for (const each of parameters) each(body);
    const answer = await this.calls.ask(deadline, (call) => {
      body.view.setUint32(place, call, true);
      this.link.send(encode(Kind.request, priority, recipient, body.body()));
    });
    const from = new Reader(answer);
    try {
      const value = result.take(from);
      from.end();
      return value;
    } catch (error) {
      if (!(error instanceof RideError)) throw error;
      throw new RideError(error.code, `the answer ${error.message}`);
    }
  }

  private takeEvent(subscription: number, body: Uint8Array): void {
    const found = this.subscriptions.get(subscription);
    if (found === undefined) return; // it may have been on its way when it was unsubscribed
    try {
      deliver(found, body);
    } catch (error) {
      this.countLost(subscription);
      this.options.log(`${this.address}: an event ${found.type.event} was dropped: ${String(error)}`);
    }
  }

  private countLost(subscription: number): void {
    for (const each of this.subscriptions.get(subscription)?.handlers ?? []) ++each.dropped;
  }

  // --- the connection ----------------------------------------------------------------------------

  private connect(): Link {
    return new Link(this.dial, this.options, {
      open: () => void this.lookUpAll(),
      reply: (call, body) => this.calls.answer(call, body),
      refused: (call, error) => {
        if (!this.calls.fail(call, error)) this.options.log(`${this.address}: ${error.message}`);
      },
      event: (subscription, body) => this.takeEvent(subscription, body),
      lost: (subscription) => this.countLost(subscription),
      hello: () => {},
      end: (why) => this.lost(why),
    });
  }

  private async lookUpAll(): Promise<void> {
    const link = this.link;
    for (const component of this.components.values()) component.lookedUp = this.lookUp(component);
    await Promise.all([...this.components.values()].map((component) => component.lookedUp));
    if (this.link !== link || !link.isOpen()) return;
    this.ready = true;
    this.pause = this.options.firstPause;
    this.search = setInterval(() => this.lookUpMissing(), this.options.silence);
    this.tell({ connected: true, text: "" });
  }

  private lookUpMissing(): void {
    for (const component of this.components.values()) {
      const missing = component.identifier === 0 && component.problem.code === Code.noSuchComponent;
      if (missing) void this.lookUp(component);
    }
  }

  private async lookUp(component: RemoteComponent): Promise<void> {
    try {
      const find = [parameter("name", string, component.name)];
      const entry = await this.ask(Directory.identifier, Directory.find, find, ComponentEntry, kPlain);
      this.found(component, entry);
      if (component.identifier === 0) return;
      const all = [...component.subscriptions.values()];
      await Promise.all(all.map((each) => this.subscribeThere(component, each)));
    } catch (error) {
      component.problem = error instanceof RideError ? error : new RideError(Code.failed, String(error));
    }
  }

  private found(component: RemoteComponent, entry: ComponentEntry): void {
    if (entry.identifier === 0) {
      component.problem = new RideError(Code.noSuchComponent, "no component has this name");
    } else if (entry.interface !== component.interfaceName) {
      const text = `has the interface '${entry.interface}', expected '${component.interfaceName}'`;
      component.problem = new RideError(Code.wrongInterface, text);
    } else {
      component.identifier = entry.identifier;
      if (entry.digest !== component.digest) {
        this.options.log(`${this.address}: '${component.name}' has another definition of '${entry.interface}'`);
      }
    }
  }

  private async subscribeThere(component: RemoteComponent, shared: SharedSubscription): Promise<void> {
    const parameters = [
      parameter("component", int, component.identifier),
      parameter("event", unsignedInt, shared.type.number),
      parameter("subscription", int, shared.identifier),
    ];
    const told = (why: string) =>
      this.options.log(`${this.address}: no events '${shared.type.event}' of '${component.name}': ${why}`);
    try {
      const code = await this.ask(Directory.identifier, Directory.subscribe, parameters, int, kPlain);
      if (code !== 0) told(nameOf(code));
    } catch (error) {
      told(String(error));
    }
  }

  private unsubscribe(component: RemoteComponent, shared: SharedSubscription): void {
    component.subscriptions.delete(shared.type.number);
    this.subscriptions.delete(shared.identifier);
    if (component.identifier === 0 || !this.link.isOpen()) return;
    const parameters = [parameter("subscription", int, shared.identifier)];
    this.ask(Directory.identifier, Directory.unsubscribe, parameters, int, kPlain).catch(() => {});
  }

  private lost(why: string): void {
    if (this.ready) ++this.losses;
    this.forget(`the connection was lost: ${why}`);
    this.tell({ connected: false, text: why });
    if (this.closed) return;
    const differing = this.pause * (0.75 + 0.5 * Math.random());
    this.timer = setTimeout(() => (this.link = this.connect()), differing);
    this.pause = Math.min(2 * this.pause, this.options.mostPause);
  }

  private forget(why: string): void {
    this.ready = false;
    clearInterval(this.search);
    const problem = new RideError(Code.notConnected, "is not connected");
    for (const component of this.components.values()) Object.assign(component, { identifier: 0, problem });
    this.calls.failAll(new RideError(Code.lost, why));
  }

  private tell(change: PeerChange): void {
    for (const handler of [...this.changes]) handler(change);
  }
}
