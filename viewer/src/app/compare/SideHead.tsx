import { useState } from "preact/hooks";
import { chosenOf, type Side } from "../../state/workbench";
import { isMeshType } from "../../state/workbench_operations";
import { useApp } from "../context";
import { IconButton } from "../ui/controls";
import { useNameForm } from "../ui/name_form";
import { NameField } from "../ui/NameField";

/** Which mesh a side has, undo and redo, and saving. */
export function SideHead({ side }: { side: Side }) {
  const { store } = useApp();
  const [saving, setSaving] = useState(false);
  const objects = store.catalogue.objects.value.filter(({ type, hasValue }) => isMeshType(type) && hasValue);
  const { readOnly } = store.connection.info.value ?? { readOnly: false };
  return (
    <header class="side-head">
      <div class="row">
        <h2 class="panel-title grow ellipsis" title={titleOf(side)} data-testid="side-title">
          {titleOf(side)}
        </h2>
        <select
          class="input"
          aria-label="Mesh of this side"
          value=""
          onChange={(event) => {
            const name = event.currentTarget.value;
            event.currentTarget.value = "";
            if (name === "selected") loadSelected(side, store);
            else if (name) void side.loadObject(name);
          }}
        >
          <option value="">{side.step.value ? "Another mesh…" : "Choose a mesh…"}</option>
          <option value="selected" disabled={store.results.selected.value === null}>
            The selected object
          </option>
          {objects.map(({ name }) => (
            <option key={name} value={name}>
              {name}
            </option>
          ))}
        </select>
        <IconButton
          icon="undo"
          label="Undo"
          disabled={side.steps.value.length < 2}
          onClick={() => void side.travel(-1)}
        />
        <IconButton
          icon="redo"
          label="Redo"
          disabled={side.undone.value.length === 0}
          onClick={() => void side.travel(1)}
        />
        {saving ? (
          <SaveForm side={side} onDone={() => setSaving(false)} />
        ) : (
          <IconButton
            icon="save"
            label="Save as a new object"
            disabled={!side.step.value || readOnly}
            onClick={() => setSaving(true)}
          />
        )}
        <IconButton
          icon="close"
          label="Clear this side"
          disabled={!side.step.value}
          onClick={() => side.clear()}
        />
      </div>
      <StepList side={side} />
    </header>
  );
}

/** The name of the mesh that was chosen last; what was made of it is told by its steps. */
function titleOf({ steps }: Side): string {
  return chosenOf(steps.value)?.label ?? "No mesh";
}

/** What was done to the mesh; a click shows the state after a step. */
function StepList({ side }: { side: Side }) {
  const shown = side.step.value;
  const all = [...side.steps.value, ...side.undone.value];
  if (all.length < 2) return null;
  return (
    <ol class="steps" aria-label="What was done">
      {all.map((step, index) => (
        <li key={index}>
          <button
            type="button"
            class="btn small quiet"
            aria-current={step === shown ? "step" : undefined}
            data-undone={side.undone.value.includes(step)}
            disabled={side.busy.value !== ""}
            title={step.statement}
            onClick={() => void side.show(step)}
          >
            {index + 1}. {step.label}
          </button>
        </li>
      ))}
    </ol>
  );
}

function loadSelected(side: Side, store: ReturnType<typeof useApp>["store"]): void {
  const selected = store.results.selected.value;
  const outcome = selected ? store.results.ofResult(selected.result) : null;
  const column = selected?.column ?? outcome?.shapeColumns[0];
  if (selected && column !== undefined)
    void side.load({ ...selected, column }, `${column}, row ${selected.row + 1}`);
}

function SaveForm({ side, onDone }: { side: Side; onDone: () => void }) {
  const form = useNameForm("", async (name) => {
    const refusal = await side.save(name);
    if (refusal === "") onDone();
    return refusal;
  });
  return (
    <form
      class="row save-form"
      onSubmit={form.submit}
      onKeyDown={(event) => event.key === "Escape" && onDone()}
    >
      <NameField form={form} label="Name of the new object" size={12} autofocus />
      <button type="submit" class="btn primary" disabled={!form.canSubmit}>
        Save
      </button>
    </form>
  );
}
