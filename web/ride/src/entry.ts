// SPDX-License-Identifier: Apache-2.0
import { Code, RideError } from "./error.ts";

/** Exchanges the token behind the `#` of the page's address for a cookie, which no script can read. */
export async function enter(): Promise<void> {
  const token = location.hash.slice(1);
  if (token === "") return; // the cookie of an earlier visit may still be good
  history.replaceState(null, "", location.pathname + location.search);
  const answer = await fetch("/token", { method: "POST", headers: { Authorization: `Bearer ${token}` } });
  if (answer.ok) return;
  const text = `this address is not good any more (${answer.status}): open the one that the application says now`;
  throw new RideError(Code.notAllowed, text);
}
