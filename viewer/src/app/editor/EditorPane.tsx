import { effect } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import type { Running } from "../../state/runner";
import { useApp, type App } from "../context";
import { Icon } from "../ui/Icon";
import { IconButton } from "../ui/controls";
import { WithCode } from "../ui/WithCode";
import { seconds } from "../table/format";
import { Editor } from "./editor";

const isMac = /Mac|iPhone|iPad/.test(navigator.userAgent);
const control = isMac ? "⌘" : "Ctrl";
const keysHint = "editor-keys";

/** The editor of statements, what is running, and the latest failure. */
export function EditorPane() {
  const app = useApp();
  const { store } = app;
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => (place.current ? mountEditor(place.current, app) : undefined), []);
  const running = store.runner.running.value;
  return (
    <section class="panel editor-pane" aria-label="Editor">
      <div class="editor-bar">
        <button
          type="button"
          class="btn primary"
          data-testid="run"
          title={`Run the statement at the cursor, or the selection (${control}+Enter)`}
          onClick={() => void runHere(app)}
        >
          <Icon name="play" /> Run
        </button>
        <div ref={place} class="editor" data-testid="editor" />
        <button
          type="button"
          class="btn quiet"
          title={`Run all statements (Shift+${control}+Enter)`}
          onClick={() => void runAll(app)}
        >
          Run all
        </button>
      </div>
      <p id={keysHint} class="muted hint editor-keys">
        <kbd>{control}</kbd> <kbd>Enter</kbd> runs the statement, Tab indents; <kbd>Esc</kbd> then{" "}
        <kbd>Tab</kbd> leaves the editor.
      </p>
      {running.map((each) => (
        <RunningLine key={each.id} running={each} />
      ))}
      <FailureBox />
    </section>
  );
}

function mountEditor(parent: HTMLElement, app: App): () => void {
  const { store, workspace } = app;
  const { catalogue } = store;
  const editor = new Editor(parent, {
    text: store.editorText.peek(),
    describedBy: keysHint,
    known: () => ({
      keywords: catalogue.keywords.peek(),
      operators: catalogue.operators.peek(),
      types: catalogue.types.peek(),
      objects: catalogue.objects.peek(),
      columns: store.results.active.peek()?.table?.columns ?? [],
    }),
    onRun: () => void runHere(app),
    onRunAll: () => void runAll(app),
    onChange: (text) => (store.editorText.value = text),
  });
  workspace.editor.value = editor;
  const stopWords = effect(() =>
    editor.setWords({
      keywords: new Set([...catalogue.keywords.value, "value", "const"]),
      operators: new Set(catalogue.operators.value.map(({ name }) => name)),
      types: new Set(catalogue.types.value.map(({ name }) => name)),
      objects: new Set(catalogue.objects.value.map(({ name }) => name)),
    }),
  );
  const stopMarks = effect(() => {
    const failure = store.failure.value;
    editor.mark(failure?.range ? [{ ...failure.range, message: failure.message }] : []);
  });
  return () => {
    stopWords();
    stopMarks();
    workspace.editor.value = null;
    editor.destroy();
  };
}

async function runHere({ store, workspace }: App): Promise<void> {
  const editor = workspace.editor.value;
  if (!editor) return;
  const { from, to } = editor.selection;
  if (isEmpty(store, editor.text)) return;
  if (from < to) await store.runText(editor.text.slice(from, to), from);
  else await store.runAt(editor.text, from);
}

async function runAll({ store, workspace }: App): Promise<void> {
  const text = workspace.editor.value?.text ?? "";
  if (!isEmpty(store, text)) await store.runText(text);
}

/** Whether there is nothing to run; then it says what to do. */
function isEmpty(store: App["store"], text: string): boolean {
  if (text.trim() !== "") return false;
  const object = store.catalogue.objects.value.find(({ shape }) => shape)?.name;
  const example = object ? `query ${object}` : "query createSphere(makePoint3D(0, 0, 0), 1, 24)";
  const message = "The editor is empty.";
  const remedy = `Write a statement, such as \`${example}\`, click an object in the list, or try an example.`;
  store.fail({ statement: "", message, remedy, code: "empty", place: null }, null);
  return true;
}

/** A running statement: its time, how far it is, and a button that stops it. */
function RunningLine({ running }: { running: Running }) {
  const [now, setNow] = useState(Date.now());
  useEffect(() => {
    const timer = setInterval(() => setNow(Date.now()), 200);
    return () => clearInterval(timer);
  }, []);
  return (
    <div class="running-line" role="status" data-testid="running">
      <span class="spinner" aria-hidden="true" />
      <span class="ellipsis grow" title={running.statement}>
        {running.progress.value || "Running"}
      </span>
      <span class="muted">{seconds(Math.max(0, now - running.started) / 1000)}</span>
      <button type="button" class="btn small danger" data-testid="stop" onClick={running.stop}>
        <Icon name="stop" /> Stop
      </button>
    </div>
  );
}

function FailureBox() {
  const { store, workspace } = useApp();
  const failure = store.failure.value;
  if (!failure) return null;
  const { range, place } = failure;
  return (
    <div class="callout error failure" role="alert" data-testid="failure">
      <div class="grow">
        <div>
          <WithCode text={failure.message} />
        </div>
        {failure.remedy && (
          <div class="muted">
            <WithCode text={failure.remedy} />
          </div>
        )}
      </div>
      {range && place && (
        <button type="button" class="btn small" onClick={() => workspace.editor.value?.goTo(range.from)}>
          Line {lineOf(workspace.editor.value?.text ?? "", range.from)}
        </button>
      )}
      <IconButton small icon="close" label="Close" onClick={() => (store.failure.value = null)} />
    </div>
  );
}

function lineOf(text: string, offset: number): number {
  return text.slice(0, offset).split("\n").length;
}
