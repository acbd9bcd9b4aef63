// SPDX-License-Identifier: Apache-2.0
// A button that does something as long as it is held, by mouse, finger or keyboard.
import { type KeyboardEvent, type PointerEvent, useEffect, useRef, useState } from "react";

/** Begins something; returns what ends it. */
export type Press = () => () => void;

/** What a button needs to be held. Whatever takes the hand, the key or the page away ends it. */
export function useHeld(press: Press) {
  const end = useRef<() => void>(undefined);
  const [held, set_held] = useState(false);
  const let_go = (): void => {
    end.current?.();
    end.current = undefined;
    set_held(false);
  };
  const begin = (): void => {
    if (end.current) return;
    end.current = press();
    set_held(true);
  };
  useEffect(() => leave_when_gone(let_go), []);
  return {
    held,
    props: {
      onPointerDown: (event: PointerEvent<HTMLElement>) => {
        if (event.button !== 0 || !event.isPrimary) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        begin();
      },
      onPointerUp: let_go,
      onPointerCancel: let_go,
      onLostPointerCapture: let_go,
      onContextMenu: (event: { preventDefault(): void }) => event.preventDefault(), // of a finger that rests
      onKeyDown: (event: KeyboardEvent<HTMLElement>) => {
        if (event.key !== " " && event.key !== "Enter") return;
        event.preventDefault();
        if (!event.repeat) begin();
      },
      onKeyUp: let_go,
      onBlur: let_go,
    },
  };
}

function leave_when_gone(let_go: () => void): () => void {
  const on_escape = (event: globalThis.KeyboardEvent) => event.key === "Escape" && let_go();
  const on_hidden = () => document.hidden && let_go();
  addEventListener("blur", let_go);
  addEventListener("pagehide", let_go);
  document.addEventListener("visibilitychange", on_hidden);
  document.addEventListener("keydown", on_escape, true);
  return () => {
    let_go();
    removeEventListener("blur", let_go);
    removeEventListener("pagehide", let_go);
    document.removeEventListener("visibilitychange", on_hidden);
    document.removeEventListener("keydown", on_escape, true);
  };
}
