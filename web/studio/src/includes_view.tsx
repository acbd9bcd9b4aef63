// SPDX-License-Identifier: Apache-2.0
// Files whose components are the deployment's, too.
import { Fragment, useState } from "react";
import { items_of, section_of, unquoted } from "./flow_text.ts";
import { change, edit, own_file, project } from "./project.ts";
import { Refused } from "./refused.tsx";

const kAbout = "includes";

export function Includes() {
  const texts = project.use((state) => state.texts);
  const [wanted, set_wanted] = useState("");
  const included = items_of(section_of(texts.get(own_file()) ?? "", "include")).map(unquoted);
  const add = async () => {
    if (wanted.trim() && (await edit([change("include", wanted.trim())], { field: kAbout }))) set_wanted("");
  };
  return (
    <section className="peers" aria-label="Included files">
      <h3>Included files</h3>
      {included.length > 0 && (
        <ul className="chips">
          {included.map((file) => (
            <li key={file}><span>{file.split("/").map((part, i) => <Fragment key={i}>{i > 0 && <>/<wbr /></>}{part}</Fragment>)}</span><button type="button" aria-label={`Include ${file} no more`} onClick={() => void edit([change("no_include", file)], { field: kAbout })}>×</button></li>
          ))}
        </ul>
      )}
      <form className="row" onSubmit={(event) => (event.preventDefault(), void add())}>
        <input aria-label="File to include" placeholder="such as robot.yaml" value={wanted} spellCheck={false} onChange={(event) => set_wanted(event.target.value)} />
        <button type="submit" disabled={!wanted.trim()}>Include</button>
      </form>
      <p className="hint">Its components stand on the canvas beside those of this file. The path counts from this file's folder.</p>
      <Refused about={kAbout} />
    </section>
  );
}
