import { useId } from "preact/hooks";
import type { NameForm } from "./name_form";

interface Props {
  readonly form: NameForm;
  readonly label: string;
  /** Its width in characters; the field grows if there is none. */
  readonly size?: number;
  readonly autofocus?: boolean;
}

/** The field for the name of a new object, with what is wrong with it below. */
export function NameField({ form, label, size, autofocus }: Props) {
  const problem = useId();
  return (
    <div class={size ? "name-field" : "name-field grow"}>
      <input
        class="input"
        aria-label={label}
        placeholder="Name"
        autofocus={autofocus ?? false}
        {...(size ? { size } : {})}
        aria-invalid={form.problem !== ""}
        aria-describedby={problem}
        value={form.name}
        onInput={(event) => form.setName(event.currentTarget.value)}
      />
      <p id={problem} class="error-text" role="alert" data-testid="name-problem">
        {form.problem}
      </p>
    </div>
  );
}
