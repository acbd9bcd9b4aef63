// SPDX-License-Identifier: Apache-2.0
// The page over the mock: index.html?arm shows the deployment `arm`, ?many=1000 one of 1000 boxes,
// ?captured=NAME what NAME.json has: {check, models, texts} of the real program.
import { show_page } from "../../src/page.tsx";
import { MockInspector } from "./inspector.ts";
import { kDeployments, many } from "./texts.ts";
import { MockWorkbench } from "./workbench.ts";

const query = new URLSearchParams(location.search);
const count = Number(query.get("many") ?? 0);
const captured = query.has("captured") ? await (await fetch(`${query.get("captured")}.json`)).json() : undefined;
const texts = captured?.texts ?? (count > 0 ? many(count) : kDeployments[[...query.keys()][0] ?? "wave"]!);
const workbench = new MockWorkbench(Object.keys(texts)[0]!, texts, captured);
const told = new Set<(change: { connected: boolean; text: string }) => void>();
const mock = { workbench, run: new MockInspector(workbench), connection: (connected: boolean, text = "") => told.forEach((one) => one({ connected, text })) };
Object.assign(window, { mock });
show_page({ ...mock, on_connection: (handler) => void told.add(handler) });
