import type { CellRef } from "../../scene/api";
import { useApp } from "../context";
import { Dialog } from "../ui/Dialog";
import { useNameForm } from "../ui/name_form";
import { NameField } from "../ui/NameField";

/** Asks for the name under which a cell is stored. */
export function NameDialog() {
  const { workspace } = useApp();
  const cell = workspace.naming.value;
  return cell ? <StoreForm cell={cell} /> : null;
}

function StoreForm({ cell }: { cell: CellRef }) {
  const { store, workspace } = useApp();
  const close = () => (workspace.naming.value = null);
  const form = useNameForm("", async (name) => {
    const refusal = await store.save(`let ${name} = $a`, { parameters: { a: cell } });
    if (refusal === "") close();
    return refusal;
  });
  return (
    <Dialog title="Store as object" onClose={close} testId="name-dialog">
      <form class="dialog-body" onSubmit={form.submit}>
        <NameField form={form} label="Name" autofocus />
        <div class="row">
          <span class="grow" />
          <button type="button" class="btn" onClick={close}>
            Cancel
          </button>
          <button type="submit" class="btn primary" disabled={!form.canSubmit}>
            Store
          </button>
        </div>
      </form>
    </Dialog>
  );
}
