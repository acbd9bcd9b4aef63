// SPDX-License-Identifier: Apache-2.0
import { Code, type Link, type Message, RideError } from "@armature/ride";
import { type Access, type Call, Service, type Subscriber } from "./served.ts";

type Policy = (question: { who: string; component: string; access: Access }) => boolean;

/** The other side of a connection, as far as it asks for something: who it is, and what it is owed. */
export class Caller implements Call {
  readonly who: string;
  /** Calls whose promises are open. */
  owed = 0;
  /** Events and answers that it had no room for. */
  dropped = 0;
  private readonly link: Link;
  private readonly policy: Policy;
  private readonly gone = new AbortController();
  private readonly subscribed = new Map<number, { service: Service; subscriber: Subscriber }>();

  constructor(link: Link, who: string, policy: Policy) {
    this.link = link;
    this.who = who;
    this.policy = policy;
  }

  get signal(): AbortSignal {
    return this.gone.signal;
  }
  allows(component: string, access: Access): boolean {
    return this.policy({ who: this.who, component, access });
  }
  demand(component: string, access: Access): void {
    const refusal = this.refusal(component, access);
    if (refusal !== undefined) throw new RideError(Code.notAllowed, refusal);
  }
  /** Why it may not; undefined: it may. */
  refusal(component: string, access: Access): string | undefined {
    return this.allows(component, access) ? undefined : `${this.who} may not ${access} '${component}'`;
  }

  refuse(message: Message, code: number, text: string): void {
    this.link.refuse(message, code, text);
  }

  /** Whoever leaves more answers than are kept for it is disconnected: none is lost in silence. */
  answer(reply: Uint8Array): void {
    if (this.send(reply) || !this.link.isOpen()) return;
    this.link.shutDown("its answers are not taken");
  }

  // --- subscriptions -----------------------------------------------------------------------------

  get subscriptions(): number {
    return this.subscribed.size;
  }
  has(subscription: number): boolean {
    return this.subscribed.has(subscription);
  }
  /** False: the service raises no such event. */
  subscribe(service: Service, event: number, subscription: number): boolean {
    const subscriber = { subscription, send: (message: Uint8Array) => this.send(message) };
    if (!Service.subscribe(service, event, subscriber)) return false;
    this.subscribed.set(subscription, { service, subscriber });
    return true;
  }
  /** False: there is none of this number. */
  unsubscribe(subscription: number): boolean {
    const found = this.subscribed.get(subscription);
    if (found !== undefined) Service.unsubscribe(found.service, found.subscriber);
    return this.subscribed.delete(subscription);
  }
  /** Ends all that it has of `service`. */
  forget(service: Service): void {
    for (const [subscription, each] of [...this.subscribed]) {
      if (each.service === service) this.unsubscribe(subscription);
    }
  }

  /** Of the connection. */
  end(): void {
    for (const subscription of [...this.subscribed.keys()]) this.unsubscribe(subscription);
    this.gone.abort();
  }

  private send(message: Uint8Array): boolean {
    try {
      this.link.send(message);
      return true;
    } catch {
      ++this.dropped;
      return false;
    }
  }
}
