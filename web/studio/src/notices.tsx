// SPDX-License-Identifier: Apache-2.0
import { clear_refusal, project, reload } from "./project.ts";
import { selection } from "./selection.ts";

/** What the user must know, above everything else. */
export function Notices() {
  const { connected, trouble, state, refusal } = project.use((all) => all);
  const told = selection.use((all) => all.told);
  const refused = refusal && !shown_elsewhere(refusal.about) ? refusal.diagnostics.find((one) => one.severity === "error") : undefined;
  return (
    <div className="notices" role="status" aria-live="polite">
      {!connected && <p className="banner error">The connection to the studio is lost{trouble && `: ${trouble}`}. A run goes on without it. Start the studio again, with the same file and at the same address: this page then comes back by itself.</p>}
      {connected && trouble && <p className="banner error">{trouble}</p>}
      {state.notice && state.elsewhere && <p className="banner error">{state.notice}</p>}
      {state.notice && !state.elsewhere && <p className="banner">{state.notice} <button type="button" className="small" onClick={() => void reload()}>Take what the disk has</button></p>}
      {refused && <p className="banner error">{refused.message} <button type="button" className="small" onClick={clear_refusal}>Dismiss</button></p>}
      {told && <p className="banner">{told} <button type="button" className="small" onClick={() => selection.set({ told: "" })}>Dismiss</button></p>}
    </div>
  );
}

/** Fields and texts say below themselves why they were refused; the canvas and Undo have no such place. */
const shown_elsewhere = (about: string): boolean => about !== "" && about !== "canvas";
