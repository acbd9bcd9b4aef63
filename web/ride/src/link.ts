// SPDX-License-Identifier: Apache-2.0
import { Assembler } from "./assembler.ts";
import { Code, nameOf, RideError } from "./error.ts";
import type { Connection, Dial } from "./transport.ts";
import { type Control, decodeControl, encodeControl, Kind, type Message, Stream } from "./wire.ts";

/** So much may wait for the other side to take it. */
const kMostUnsent = 1024 * 1024;

/** What answers the commands and requests of the other side. */
export interface Serving {
  /** The message is good as long as the call lasts. */
  take(link: Link, message: Message): void;
  ended(link: Link): void;
}

export interface LinkOptions {
  name: string;
  bodyBytes: number;
  /** In ms: who is silent so long is asked whether it lives. */
  silence: number;
  /** This side was connected to: it greets when it was greeted. */
  accepted?: boolean;
  /** Without: all that the other side asks for is refused. */
  serving?: Serving | undefined;
}

/** What a link tells of the messages that came. */
export interface LinkEvents {
  open(): void;
  reply(call: number, body: Uint8Array): void;
  refused(call: number, error: RideError): void;
  event(subscription: number, body: Uint8Array): void;
  /** An event that was larger than this side takes. */
  lost(subscription: number): void;
  /** Who the other side says it is. */
  hello(text: string): void;
  end(why: string): void;
}

/** One connection from its beginning to its end: messages in, messages out, and whether it lives. */
export class Link {
  private readonly connection: Connection;
  private readonly stream = new Stream();
  private readonly bodies: Assembler;
  private readonly options: LinkOptions;
  private readonly events: LinkEvents;
  private heartbeat: ReturnType<typeof setInterval> | undefined;
  private heardAt = 0;
  private asked = 0;
  private opened = false;
  private greeted = false;
  private ended = false;

  constructor(dial: Dial, options: LinkOptions, events: LinkEvents) {
    this.options = options;
    this.events = events;
    this.bodies = new Assembler(options.bodyBytes);
    this.connection = dial({
      open: () => this.begin(),
      bytes: (chunk) => this.receive(chunk),
      end: (why) => this.end(why),
    });
  }

  isOpen(): boolean {
    return this.opened && !this.ended;
  }

  /** Throws if the link is not open, or the other side has not taken earlier messages. */
  send(message: Uint8Array): void {
    if (!this.isOpen()) throw new RideError(Code.notConnected, "is not connected");
    if (this.connection.unsent() + message.length > kMostUnsent + this.options.bodyBytes) {
      throw new RideError(Code.queueFull, "the other side has not taken earlier messages");
    }
    this.connection.send(message);
  }

  /** What the other side has not taken yet. */
  unsent(): number {
    return this.connection.unsent();
  }

  /** @param why  is said to the other side */
  shutDown(why: string): void {
    this.control(0, Code.shuttingDown, why);
    this.close();
  }

  close(): void {
    this.stop();
    this.connection.close();
  }

  private begin(): void {
    this.opened = true;
    this.heardAt = Date.now();
    this.heartbeat = setInterval(() => this.beat(), this.options.silence);
    if (this.options.accepted !== true) this.greet();
    this.events.open();
  }

  private receive(chunk: Uint8Array): void {
    this.heardAt = Date.now();
    this.asked = 0;
    try {
      this.stream.add(chunk, (message) => {
        if (!this.ended) this.take(message);
      });
    } catch (error) {
      this.connection.close();
      this.end(error instanceof RideError ? `it ${error.message}` : String(error));
    }
  }

  private take(part: Message): void {
    const assembled = this.bodies.add(part);
    if (assembled === undefined) return;
    if ("tooLarge" in assembled) return this.takeTooLarge(assembled.tooLarge);
    const { kind, identifier, body } = assembled.message;
    if (kind === Kind.reply) return this.events.reply(identifier, body);
    if (kind === Kind.event) return this.events.event(identifier, body);
    if (kind === Kind.control) return this.takeControl(identifier, decodeControl(body));
    if (kind !== Kind.request && kind !== Kind.command) {
      return this.refuse(assembled.message, Code.malformed, `unknown type ${kind}`);
    }
    if (this.options.serving !== undefined) return this.options.serving.take(this, assembled.message);
    this.refuse(assembled.message, Code.noSuchComponent, "a page has no components");
  }

  /** Says what is at fault with a message. */
  refuse({ kind, identifier, body }: Message, code: number, text: string): void {
    const isRequest = kind === Kind.request && body.length >= 8;
    const fields = new DataView(body.buffer, body.byteOffset, body.length);
    this.control(isRequest ? fields.getUint32(4, true) : 0, code, text, {
      type: kind,
      recipient: identifier,
      operation: body.length >= 4 ? fields.getUint32(0, true) : 0,
    });
  }

  private takeTooLarge(message: Message): void {
    const { kind, identifier } = message;
    const most = `larger than ${this.options.bodyBytes} bytes`;
    if (kind === Kind.reply) {
      this.events.refused(identifier, new RideError(Code.tooLarge, `its answer is ${most}`));
    } else if (kind === Kind.event) {
      this.events.lost(identifier);
    } else {
      this.refuse(message, Code.tooLarge, `the body is ${most}`);
    }
  }

  private takeControl(call: number, control: Control): void {
    if (control.code === Code.ping) return this.control(0, Code.pong, control.text);
    if (control.code === Code.pong) return;
    if (control.code === Code.hello) return this.takeHello(control.text);
    if (control.code === Code.shuttingDown) {
      this.connection.close();
      return this.end("the other side shuts down");
    }
    const text = control.text || nameOf(control.code);
    this.events.refused(call, new RideError(control.code, text));
  }

  private takeHello(text: string): void {
    if (this.options.accepted === true && !this.greeted) this.greet();
    this.events.hello(text);
  }

  private greet(): void {
    this.greeted = true;
    this.control(0, Code.hello, `${this.options.name} armature-web/0.1.0`);
  }

  /** Answers of this side that nobody takes are dropped: who floods with PING fills no memory. */
  private control(call: number, code: number, text: string, about = { type: 0, recipient: 0, operation: 0 }): void {
    if (!this.isOpen() || this.connection.unsent() > kMostUnsent) return;
    this.connection.send(encodeControl(call, { code, text, ...about }));
  }

  /** Whoever stood still itself, as a page in the background does, asks before it gives up. */
  private beat(): void {
    const { silence } = this.options;
    if (Date.now() - this.heardAt < silence) return;
    if (this.asked < 2) {
      ++this.asked;
      return this.control(0, Code.ping, "");
    }
    this.connection.close();
    this.end(`it was silent for ${Date.now() - this.heardAt} ms, and did not answer`);
  }

  private end(why: string): void {
    if (this.ended) return;
    this.stop();
    this.events.end(why);
  }

  private stop(): void {
    if (this.ended) return;
    this.ended = true;
    clearInterval(this.heartbeat);
    this.options.serving?.ended(this);
  }
}

