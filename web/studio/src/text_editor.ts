// SPDX-License-Identifier: Apache-2.0
import { defaultKeymap, indentWithTab } from "@codemirror/commands";
import { yaml } from "@codemirror/lang-yaml";
import { HighlightStyle, indentOnInput, syntaxHighlighting } from "@codemirror/language";
import { type Diagnostic as Mark, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { Annotation, ChangeSet, EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { offset_of } from "./bytes.ts";
import type { Diagnostic } from "./checked.ts";
import { replacements } from "./merge.ts";
import { project, unwritten, write } from "./project.ts";

const kDebounce = 300;  ///< from the last key to the write [ms]
const from_elsewhere = Annotation.define<boolean>();

const colours = HighlightStyle.define([
  { tag: tags.comment, color: "var(--faint-text)", fontStyle: "italic" },
  { tag: [tags.propertyName, tags.definition(tags.propertyName)], color: "var(--lane-0)" },
  { tag: [tags.string, tags.special(tags.string)], color: "var(--good)" },
  { tag: [tags.keyword, tags.labelName, tags.typeName], color: "var(--lane-3)" },
  { tag: [tags.punctuation, tags.separator, tags.brace, tags.squareBracket], color: "var(--soft)" },
]);

const look = EditorView.theme({
  "&": { height: "100%", fontSize: "13px", color: "var(--ink)", backgroundColor: "var(--card)" },
  "&.cm-focused": { outline: "2px solid var(--focus)", outlineOffset: "-2px" },
  ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.5" },
  ".cm-gutters": { backgroundColor: "var(--paper)", color: "var(--faint-text)", border: "none" },
  ".cm-activeLine": { backgroundColor: "var(--select)" },
  ".cm-content": { caretColor: "var(--ink)" },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--select-strong) !important" },
  ".cm-lintRange": { backgroundImage: "none !important", paddingBottom: "0", textDecoration: "underline wavy var(--bad)" },
  ".cm-lintRange-warning, .cm-lintRange-info": { textDecorationColor: "var(--warn)" },
  ".cm-tooltip, .cm-panels": { backgroundColor: "var(--card)", color: "var(--ink)", border: "1px solid var(--line)" },
});

/** An editor of one file. What is typed is written; what others write comes into it. */
export class TextEditor {
  private readonly view: EditorView;
  private version = 0;
  private base = "";     ///< the text of `version`, from which what is typed was made
  private timer: ReturnType<typeof setTimeout> | undefined;
  private writing: Promise<void> | undefined;

  /** The editor makes its own styles; in a shadow root they need no style element. */
  constructor(host: HTMLElement, private readonly path: string) {
    const root = host.shadowRoot ?? host.attachShadow({ mode: "open" });
    const inside = document.createElement("div");
    inside.style.height = "100%";
    root.replaceChildren(inside);
    this.view = new EditorView({ parent: inside, root, state: this.fresh_state("") });
    unwritten.add(this.write_now);
  }

  private fresh_state(doc: string): EditorState {
    return EditorState.create({
      doc,
      extensions: [
        lineNumbers(), drawSelection(), highlightActiveLine(), EditorView.lineWrapping, highlightSelectionMatches(), indentOnInput(), yaml(),
        syntaxHighlighting(colours), look, EditorState.tabSize.of(2), EditorView.contentAttributes.of({ "aria-label": `Text of ${this.path}` }),
        keymap.of([...defaultKeymap, ...searchKeymap, indentWithTab]),
        EditorView.updateListener.of((update) => {
          const typed = update.transactions.some((one) => one.docChanged && !one.annotation(from_elsewhere));
          if (typed) this.write_soon();
        }),
      ],
    });
  }

  private get text(): string {
    return this.view.state.doc.toString();
  }

  /** What the server has now; what is typed here and not there yet stays. */
  take(version: number, text: string): void {
    if (this.writing || version < this.version) return;
    if (this.version === 0) {
      this.view.setState(this.fresh_state(text));
    } else {
      const theirs = ChangeSet.of(replacements(this.base, text), this.base.length);
      const ours = ChangeSet.of(replacements(this.base, this.text), this.base.length);
      if (!theirs.empty && text !== this.text) this.view.dispatch({ changes: theirs.map(ours, true), annotations: from_elsewhere.of(true) });
    }
    this.version = version;
    this.base = text;
  }

  private write_soon(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.write_now(), kDebounce);
  }

  /** Writes what was typed; done once that has an answer. */
  private readonly write_now = async (): Promise<void> => {
    await this.writing;
    clearTimeout(this.timer);
    if (this.text === this.base) return;
    this.writing = this.write(this.text).finally(() => (this.writing = undefined));
    await this.writing;
  };

  private async write(sent: string): Promise<void> {
    const done = await write(this.version, this.path, sent);
    this.writing = undefined;
    if (done) this.base = sent;
    const { texts, textsVersion } = project.get();
    this.take(textsVersion, texts.get(this.path) ?? "");
    if (done && this.text !== this.base) this.write_soon();
  }

  mark(diagnostics: Diagnostic[]): void {
    const text = this.text;
    const marks = diagnostics.filter((one) => one.file === this.path && one.line).map((one): Mark => {
      const from = offset_of(text, one.line!, one.column ?? 1);
      const word = /^[\w.{}+$-]+/.exec(text.slice(from))?.[0].length ?? 1;
      const severity = one.severity === "note" ? "info" : one.severity;
      return { from, to: Math.min(text.length, from + word), severity, message: one.hint ? `${one.message} (${one.hint})` : one.message };
    });
    this.view.dispatch(setDiagnostics(this.view.state, marks));
  }

  go_to(line: number, column: number): void {
    const at = offset_of(this.text, line, column);
    this.view.dispatch({ selection: { anchor: at }, effects: EditorView.scrollIntoView(at, { y: "center" }) });
    this.view.focus();
  }

  /** What was typed last is written, too. */
  close(): void {
    unwritten.delete(this.write_now);
    void this.write_now();
    this.view.destroy();
  }
}
