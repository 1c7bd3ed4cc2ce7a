import { useState } from "preact/hooks";
import type { CellRef } from "../../scene/api";
import { useApp } from "../context";
import { Dialog } from "../ui/Dialog";

/** Asks for the name under which a cell is stored. */
export function NameDialog() {
  const { workspace } = useApp();
  const cell = workspace.naming.value;
  return cell ? <NameForm cell={cell} /> : null;
}

function NameForm({ cell }: { cell: CellRef }) {
  const { store, workspace } = useApp();
  const [name, setName] = useState("");
  const close = () => (workspace.naming.value = null);
  const problem = nameProblem(
    name,
    store.catalogue.objects.value.map((object) => object.name),
  );
  return (
    <Dialog title="Store as object" onClose={close} testId="name-dialog">
      <form
        class="dialog-body"
        onSubmit={(event) => {
          event.preventDefault();
          if (problem) return;
          close();
          void store.run(`let ${name} = $a`, { parameters: { a: cell } });
        }}
      >
        <label class="field">
          <span>Name</span>
          <input class="input" value={name} onInput={(event) => setName(event.currentTarget.value)} />
        </label>
        {name && problem && <p class="error-text">{problem}</p>}
        <div class="row">
          <span class="grow" />
          <button type="button" class="btn" onClick={close}>
            Cancel
          </button>
          <button type="submit" class="btn primary" disabled={problem !== ""}>
            Store
          </button>
        </div>
      </form>
    </Dialog>
  );
}

/** Why a name cannot be that of a new object; "" if it can. */
export function nameProblem(name: string, taken: readonly string[]): string {
  if (!/^[A-Za-z][A-Za-z0-9_]*$/.test(name)) return "A name is a letter, followed by letters, digits and _.";
  if (taken.includes(name)) return `There is an object ${name} already.`;
  return "";
}
