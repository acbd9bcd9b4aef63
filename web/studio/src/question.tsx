// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef } from "react";
import { own_file, project, type Question } from "./project.ts";

/** Asked before something changes that an included file says. */
export function QuestionView() {
  const question = project.use((state) => state.question);
  return question ? <Dialog key={question.file} question={question} /> : null;
}

/** Not modal: Stop can be pressed meanwhile. */
function Dialog({ question }: { question: Question }) {
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current?.show(), []);
  const on_key = (event: React.KeyboardEvent) => event.key === "Escape" && !event.shiftKey && question.answer(undefined);
  const included = question.file.split("/").pop();
  const own = own_file().split("/").pop();
  return (
    <dialog ref={dialog} aria-labelledby="question" onKeyDown={on_key}>
      <h2 id="question">{`${included} says this`}</h2>
      <p>{`${own} includes it, and others may, too. Where do you want the change? The answer counts for this file until you close the page.`}</p>
      <p className="actions">
        <button type="button" className="primary" onClick={() => question.answer("here")}>{`Override it in ${own}`}</button>
        <button type="button" onClick={() => question.answer("there")}>{`Change ${included}`}</button>
        <button type="button" onClick={() => question.answer(undefined)}>Cancel</button>
      </p>
    </dialog>
  );
}
