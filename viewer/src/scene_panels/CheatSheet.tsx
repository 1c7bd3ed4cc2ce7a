import { useEffect, useRef, useState } from "preact/hooks";

import { searchShortcuts } from "../scene";
import type { Shortcut } from "../scene";

/** All shortcuts, with a search. A click on one carries it out. */
export function CheatSheet({ onClose, onAct }: { onClose: () => void; onAct: (action: string) => void }) {
  const [text, setText] = useState("");
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current?.showModal(), []);
  const found = searchShortcuts(text);
  const groups = [...new Set(found.map(({ group }) => group))];
  const act = (shortcut: Shortcut | undefined): void => {
    if (!shortcut) return;
    onClose();
    onAct(shortcut.action);
  };
  return (
    <dialog ref={dialog} class="dialog cheat-sheet" aria-label="Keyboard shortcuts" onClose={onClose}>
      <form
        method="dialog"
        class="row"
        onSubmit={(event) => {
          event.preventDefault();
          act(found[0]);
        }}
      >
        <input
          class="input grow"
          type="search"
          placeholder="Search shortcuts"
          aria-label="Search shortcuts"
          value={text}
          onInput={(event) => setText(event.currentTarget.value)}
          onKeyDown={(event) => {
            // A search field would take the key to empty itself.
            if (event.key === "Escape") onClose();
          }}
        />
        <button type="button" class="btn quiet" onClick={onClose}>
          Close
        </button>
      </form>
      <div class="cheat-sheet-body">
        {groups.map((group) => (
          <section key={group}>
            <h3>{group}</h3>
            <ul class="list">
              {found
                .filter((shortcut) => shortcut.group === group)
                .map((shortcut) => (
                  <li key={shortcut.action}>
                    <button type="button" class="list-item" onClick={() => act(shortcut)}>
                      <span class="grow">{shortcut.title}</span>
                      <Keys keys={shortcut.keys} />
                    </button>
                  </li>
                ))}
            </ul>
          </section>
        ))}
        {found.length === 0 && <p class="muted">No shortcut has these words.</p>}
      </div>
    </dialog>
  );
}

const kKeyNames: Readonly<Record<string, string>> = {
  ArrowLeft: "←",
  ArrowRight: "→",
  ArrowUp: "↑",
  ArrowDown: "↓",
  Escape: "Esc",
};

function Keys({ keys }: { keys: string }) {
  return (
    <span>
      {keys.split(" ").map((combination, index) => (
        <span key={combination}>
          {index > 0 && " or "}
          {partsOf(combination).map((key) => (
            <kbd key={key}>{kKeyNames[key] ?? (key.length === 1 ? key.toUpperCase() : key)}</kbd>
          ))}
        </span>
      ))}
    </span>
  );
}

function partsOf(combination: string): string[] {
  return combination === "+" ? ["+"] : combination.split("+");
}
