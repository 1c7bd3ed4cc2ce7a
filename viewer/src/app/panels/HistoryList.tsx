import { useState } from "preact/hooks";
import { useApp } from "../context";
import { IconButton, SearchField } from "../ui/controls";
import { PlainText } from "../ui/PlainText";

/** Statements that were run here; a click puts one into the editor. */
export function HistoryList() {
  const { store, workspace } = useApp();
  const [pattern, setPattern] = useState("");
  const found = (void store.history.entries.value, store.history.search(pattern));
  return (
    <>
      <div class="list-search">
        <SearchField label="Search history" value={pattern} onInput={setPattern} />
        <IconButton icon="close" label="Forget the history" onClick={() => store.history.clear()} />
      </div>
      {found.length === 0 && (
        <p class="empty">{pattern ? "No statement matches." : "Nothing was run yet."}</p>
      )}
      <ul class="list" data-testid="history">
        {found.map(({ text, ok, time }) => (
          <li key={text} class="list-row">
            <button
              type="button"
              class="list-item history-item"
              title={`${text}\n${new Date(time).toLocaleString("en-GB")}`}
              onClick={() => workspace.editor.value?.append(`${text};`)}
            >
              <code class={`ellipsis ${ok ? "" : "error-text"}`}>
                <PlainText text={text.replace(/\s+/g, " ")} />
              </code>
            </button>
            <IconButton small icon="play" label="Run again" onClick={() => void store.run(text)} />
          </li>
        ))}
      </ul>
    </>
  );
}
