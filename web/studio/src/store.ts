// SPDX-License-Identifier: Apache-2.0
import { useSyncExternalStore } from "react";

/** Plain state, of which views see parts. */
export class Store<State extends object> {
  private readonly listeners = new Set<() => void>();

  constructor(private current: State) {}

  get(): State {
    return this.current;
  }

  set(change: Partial<State>): void {
    this.current = { ...this.current, ...change };
    for (const listener of [...this.listeners]) listener();
  }

  subscribe = (listener: () => void): (() => void) => {
    this.listeners.add(listener);
    return () => void this.listeners.delete(listener);
  };

  /** For views; what `part` gives has to be the same object while nothing changed. */
  use<Part>(part: (state: State) => Part): Part {
    return useSyncExternalStore(this.subscribe, () => part(this.current));
  }
}
