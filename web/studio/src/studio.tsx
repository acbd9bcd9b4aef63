// SPDX-License-Identifier: Apache-2.0
import { connectPage } from "@armature/ride";
import { InspectorPlaceholder } from "@armature/placeholders/inspection";
import { WorkbenchPlaceholder } from "@armature/placeholders/workbench";
import { message_of } from "./backend.ts";
import { show_page } from "./page.tsx";

const kBodyBytes = 16 * 1024 * 1024;

try {
  const peer = await connectPage({ bodyBytes: kBodyBytes });
  show_page({
    workbench: new WorkbenchPlaceholder(peer, "workbench"),
    run: new InspectorPlaceholder(peer, "run"),
    on_connection: (handler) => peer.on_change(handler),
  });
} catch (error) {
  document.getElementById("page")!.textContent = `The studio does not answer: ${message_of(error)}. Open the address that it says now.`;
}
