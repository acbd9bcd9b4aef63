// SPDX-License-Identifier: Apache-2.0
import { connect_by_name } from "./scene.ts";

/** With no boxes: all of them. */
export function ConnectByName({ boxes = [] }: { boxes?: string[] }) {
  return (
    <button type="button" onClick={() => void connect_by_name(boxes)}
      title="Connects each input that needs a writer with the only output of its name, type, unit and size, and adds peers that have what a component calls or hears">
      Connect what fits
    </button>
  );
}
