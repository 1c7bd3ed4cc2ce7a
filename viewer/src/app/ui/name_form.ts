import { useState } from "preact/hooks";
import { useApp } from "../context";

/** The field and the submission of a form that asks for the name of a new object. */
export interface NameForm {
  readonly name: string;
  readonly setName: (name: string) => void;
  /** Why the name cannot be used, or why the server refused to store it; "" if nothing is wrong. */
  readonly problem: string;
  readonly canSubmit: boolean;
  readonly submit: (event: Event) => void;
}

/** `save` stores under the name and answers with why it failed, or "". */
export function useNameForm(first: string, save: (name: string) => Promise<string>): NameForm {
  const { store } = useApp();
  const [name, setName] = useState(first);
  const [refusal, setRefusal] = useState("");
  const [busy, setBusy] = useState(false);
  const taken = store.catalogue.objects.value.map((object) => object.name);
  const wrong = nameProblem(name, taken);
  const submit = (event: Event): void => {
    event.preventDefault();
    if (wrong || busy) return;
    setBusy(true);
    setRefusal("");
    void save(name)
      .then(setRefusal)
      .finally(() => setBusy(false));
  };
  const change = (next: string): void => {
    setName(next);
    setRefusal("");
  };
  const problem = name === "" ? "" : wrong || refusal;
  return { name, setName: change, problem, canSubmit: wrong === "" && !busy, submit };
}

/** Why a name cannot be that of a new object; "" if it can. */
export function nameProblem(name: string, taken: readonly string[]): string {
  if (!/^[A-Za-z][A-Za-z0-9_]*$/.test(name)) return "A name is a letter, followed by letters, digits and _.";
  if (taken.includes(name)) return `There is an object ${name} already.`;
  return "";
}
