// SPDX-License-Identifier: Apache-2.0
import { project, reload } from "./project.ts";
import { selection } from "./selection.ts";

/** What the user must know, above everything else. */
export function Notices() {
  const { connected, trouble, state } = project.use((all) => all);
  const told = selection.use((all) => all.told);
  return (
    <div className="notices" role="status" aria-live="polite">
      {!connected && <p className="banner error">The connection to the studio is lost{trouble && `: ${trouble}`}. A run goes on without it; this page comes back by itself.</p>}
      {connected && trouble && <p className="banner error">{trouble}</p>}
      {state.notice && <p className="banner">{state.notice} <button type="button" className="small" onClick={() => void reload()}>Take what the disk has</button></p>}
      {told && <p className="banner">{told} <button type="button" className="small" onClick={() => selection.set({ told: "" })}>Dismiss</button></p>}
    </div>
  );
}
