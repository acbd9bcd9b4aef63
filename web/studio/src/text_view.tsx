// SPDX-License-Identifier: Apache-2.0
// The files' text. It comes with the editor, so it is loaded when it is opened.
import { useEffect, useMemo, useRef, useState } from "react";
import { project } from "./project.ts";
import { selection } from "./selection.ts";
import { TextEditor } from "./text_editor.ts";

const kPlaces = ".studio.json";  ///< where boxes are: nobody types that

export default function TextView() {
  const all = project.use((state) => state.state.files);
  const files = useMemo(() => all.filter((file) => !file.path.endsWith(kPlaces)), [all]);
  const place = selection.use((state) => state.textPlace);
  const [path, set_path] = useState(place?.file ?? files[0]?.path ?? "");
  useEffect(() => {
    if (place && files.some((file) => file.path === place.file)) set_path(place.file);
  }, [place, files]);
  const shown = files.some((file) => file.path === path) ? path : files[0]?.path ?? "";
  return (
    <>
      <div role="tablist" aria-label="Files">
        {files.map((file) => (
          <button key={file.path} type="button" role="tab" aria-selected={file.path === shown} title={file.path} onClick={() => set_path(file.path)}>
            {file.path.split("/").pop()}{file.changed && <span title="not saved"> •</span>}
          </button>
        ))}
      </div>
      {shown && <Editor key={shown} path={shown} />}
      <Refusal path={shown} />
    </>
  );
}

function Editor({ path }: { path: string }) {
  const host = useRef<HTMLDivElement>(null);
  const editor = useRef<TextEditor>(null);
  const version = project.use((state) => state.textsVersion);
  const text = project.use((state) => state.texts.get(path) ?? "");
  const diagnostics = project.use((state) => state.checked?.diagnostics);
  const place = selection.use((state) => state.textPlace);
  useEffect(() => {
    editor.current = new TextEditor(host.current!, path);
    return () => editor.current?.close();
  }, [path]);
  useEffect(() => editor.current?.take(version, text), [version, text, path]);
  useEffect(() => editor.current?.mark(diagnostics ?? []), [diagnostics, path, text]);
  useEffect(() => {
    if (place?.file === path) editor.current?.go_to(place.line, place.column);
  }, [place, path]);
  return <div className="editor" ref={host} />;
}

function Refusal({ path }: { path: string }) {
  const refusal = project.use((state) => (state.refusal?.about === `text:${path}` ? state.refusal : undefined));
  return refusal ? <p className="error" role="alert">{refusal.diagnostics.map((one) => one.message).join("; ")}</p> : null;
}
