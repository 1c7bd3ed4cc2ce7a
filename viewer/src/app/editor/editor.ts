import {
  acceptCompletion,
  autocompletion,
  closeBrackets,
  closeBracketsKeymap,
  completionKeymap,
} from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab, toggleComment } from "@codemirror/commands";
import { bracketMatching } from "@codemirror/language";
import { setDiagnostics, type Diagnostic } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { Compartment, EditorState, Prec } from "@codemirror/state";
import {
  EditorView,
  drawSelection,
  highlightActiveLine,
  highlightActiveLineGutter,
  hoverTooltip,
  keymap,
  lineNumbers,
  placeholder,
  type Tooltip,
} from "@codemirror/view";
import { complete, type Known } from "./completion";
import { wordBetween } from "./word_between";
import { language, type Words } from "./language";

export interface EditorOptions {
  readonly text: string;
  /** The id of the element that says how to use it by the keyboard. */
  readonly describedBy: string;
  readonly known: () => Known;
  /** Runs the statement at the cursor, or the selected text. */
  readonly onRun: () => void;
  readonly onRunAll: () => void;
  readonly onChange: (text: string) => void;
}

/** The editor of statements; a thin cover of CodeMirror. */
export class Editor {
  readonly view: EditorView;
  readonly #language = new Compartment();

  constructor(parent: HTMLElement, options: EditorOptions) {
    const commands = Prec.highest(
      keymap.of([
        { key: "Mod-Enter", run: () => (options.onRun(), true) },
        { key: "Shift-Mod-Enter", run: () => (options.onRunAll(), true) },
        { key: "Mod-/", run: toggleComment },
      ]),
    );
    this.view = new EditorView({
      parent,
      state: EditorState.create({
        doc: options.text,
        extensions: [
          commands,
          lineNumbers(),
          highlightActiveLine(),
          highlightActiveLineGutter(),
          history(),
          drawSelection(),
          bracketMatching(),
          closeBrackets(),
          highlightSelectionMatches(),
          search({ top: true }),
          autocompletion({ icons: false, override: [(context) => complete(context, options.known())] }),
          hoverTooltip((view, position) => describeWord(view, position, options.known())),
          keymap.of([
            { key: "Tab", run: acceptCompletion },
            ...closeBracketsKeymap,
            ...completionKeymap,
            ...searchKeymap,
            ...historyKeymap,
            ...defaultKeymap,
            indentWithTab,
          ]),
          placeholder("Write a statement, for example: query createSphere(makePoint3D(0, 0, 0), 1, 24);"),
          EditorView.lineWrapping,
          EditorView.contentAttributes.of({
            "aria-label": "Statements",
            "aria-describedby": options.describedBy,
            spellcheck: "false",
          }),
          EditorView.updateListener.of((update) => {
            if (update.docChanged) options.onChange(update.state.doc.toString());
          }),
          this.#language.of([]),
        ],
      }),
    });
  }

  get text(): string {
    return this.view.state.doc.toString();
  }

  /** The selected range; empty if it is only a cursor. */
  get selection(): { readonly from: number; readonly to: number } {
    const { from, to } = this.view.state.selection.main;
    return { from, to };
  }

  setText(text: string): void {
    this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text } });
  }

  /** Puts a name at the cursor, or in place of the selection, apart from words beside it. */
  insert(name: string): void {
    const { state } = this.view;
    const { from, to } = state.selection.main;
    const text = wordBetween(state.sliceDoc(Math.max(0, from - 1), from), name, state.sliceDoc(to, to + 1));
    this.view.dispatch(state.replaceSelection(text));
    this.view.focus();
  }

  /** Puts a text at the end, as a statement of its own, and the cursor into it. */
  append(text: string): void {
    const before = this.text.trimEnd();
    const insert = `${before}${before ? "\n\n" : ""}${text}`;
    this.view.dispatch({
      changes: { from: 0, to: this.view.state.doc.length, insert },
      selection: { anchor: insert.length },
      scrollIntoView: true,
    });
    this.view.focus();
  }

  setWords(words: Words): void {
    this.view.dispatch({ effects: this.#language.reconfigure(language(words)) });
  }

  /** Marks errors; an empty list takes the marks away. */
  mark(errors: readonly { readonly from: number; readonly to: number; readonly message: string }[]): void {
    const end = this.view.state.doc.length;
    const diagnostics = errors.map(({ from, to, message }): Diagnostic => ({
      from: Math.min(from, end),
      to: Math.min(to, end),
      severity: "error",
      message,
    }));
    this.view.dispatch(setDiagnostics(this.view.state, diagnostics));
  }

  /** Puts the cursor at an offset. */
  goTo(offset: number): void {
    const anchor = Math.min(offset, this.view.state.doc.length);
    this.view.dispatch({ selection: { anchor }, scrollIntoView: true });
    this.view.focus();
  }

  destroy(): void {
    this.view.destroy();
  }
}

function describeWord(view: EditorView, position: number, known: Known): Tooltip | null {
  const range = view.state.wordAt(position);
  if (!range) return null;
  const name = view.state.sliceDoc(range.from, range.to);
  const operator = known.operators.find((candidate) => candidate.name === name);
  const object = known.objects.find((candidate) => candidate.name === name);
  if (!operator && !object) return null;
  return {
    pos: range.from,
    end: range.to,
    above: true,
    create: () => {
      const dom = document.createElement("div");
      dom.className = "word-tooltip";
      const head = dom.appendChild(document.createElement("code"));
      head.textContent = object ? `${object.name}: ${object.type}` : (operator?.syntax ?? "");
      if (operator && !object) dom.appendChild(document.createElement("p")).textContent = operator.doc;
      return { dom };
    },
  };
}
