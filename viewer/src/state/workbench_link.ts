/** The split screen as plain data, for permanent links. */

import type { CellRef } from "../scene/api";
import { isKept, keptOf, type KeptResult } from "./kept_result";
import { cellOf, type Side, type Step, type Workbench } from "./workbench";
import { isWorkbenchStatement } from "./workbench_operations";

/** An input of a step: the number of an earlier step, or a cell of the n-th statement of the link. */
type LinkInput = number | readonly [number, number, string];

export interface LinkStep {
  readonly label: string;
  readonly statement: string;
  readonly inputs: Readonly<Record<string, LinkInput>>;
  /** Its result, if the page is that of this browser. */
  readonly kept?: KeptResult;
}

interface LinkSide {
  /** Numbers of the steps that led to the mesh. */
  readonly steps: readonly number[];
  /** Of those after it, which were left by going back. */
  readonly undone?: readonly number[];
  /** The step whose mesh is drawn over it as control mesh. */
  readonly control: number | null;
  /** What SceneView.toJSON gave. */
  readonly scene: unknown;
}

export interface LinkCompare {
  /** Each after those that it needs. */
  readonly steps: readonly LinkStep[];
  readonly left: LinkSide;
  readonly right: LinkSide;
  readonly sameCamera: boolean;
}

/** Places of results among the statements of the link; null for one that is not among them. */
type PlaceOf = (result: string) => number | null;

/** The split screen for a link; null if a mesh comes from a result that is not in the link. */
export function linkOf(
  workbench: Workbench,
  placeOf: PlaceOf,
  more: {
    readonly left: unknown;
    readonly right: unknown;
    readonly sameCamera: boolean;
    /** The results and what was undone are named, so that this browser can take them up again. */
    readonly keep?: boolean;
  },
): LinkCompare | null {
  const list = new StepList(placeOf, more.keep ?? false);
  const sideOf = (side: Side, scene: unknown): LinkSide => {
    const steps = side.steps.value.map((step) => list.add(step));
    const undone = more.keep ? { undone: side.undone.value.map((step) => list.add(step)) } : {};
    const { result } = side.control.value ?? { result: null };
    const control = list.known().find((step) => cellOf(step).result === result);
    return { steps, ...undone, control: control ? list.add(control) : null, scene };
  };
  const left = sideOf(workbench.left, more.left);
  const right = sideOf(workbench.right, more.right);
  // A control mesh of the left side may be a step of the right one, which is known only now.
  const again = left.control === null ? sideOf(workbench.left, more.left) : left;
  return list.isComplete ? { steps: list.steps, left: again, right, sameCamera: more.sameCamera } : null;
}

/** Numbers steps in an order in which they can be made. */
class StepList {
  readonly steps: LinkStep[] = [];
  isComplete = true;
  private readonly numbers = new Map<Step, number>();

  constructor(
    private readonly placeOf: PlaceOf,
    private readonly keep: boolean,
  ) {}

  known(): readonly Step[] {
    return [...this.numbers.keys()];
  }

  add(step: Step): number {
    const known = this.numbers.get(step);
    if (known !== undefined) return known;
    const inputs = Object.fromEntries(
      Object.entries(step.inputs).map(([name, input]) => [name, this.input(input)]),
    );
    const number = this.steps.length;
    const kept = this.keep ? keptOf(step.outcome) : null;
    this.steps.push({ label: step.label, statement: step.statement, inputs, ...(kept ? { kept } : {}) });
    this.numbers.set(step, number);
    return number;
  }

  private input(input: Step | CellRef): LinkInput {
    if ("statement" in input) return this.add(input);
    const place = this.placeOf(input.result);
    if (place === null) this.isComplete = false;
    return [place ?? 0, input.row, input.column];
  }
}

/** Makes the meshes of a link again and shows them; false if one of them fails, which its side shows. */
export async function restoreSides(
  workbench: Workbench,
  link: LinkCompare,
  results: readonly (string | null)[],
): Promise<boolean> {
  const made: Step[] = [];
  const there = [workbench.left, workbench.right].flatMap(({ steps, undone }) => [
    ...steps.value,
    ...undone.value,
  ]);
  for (const { label, statement, inputs, kept } of link.steps) {
    const number = made.length;
    const side = link.right.steps.includes(number) ? workbench.right : workbench.left;
    const cells = resolved(inputs, made, results);
    const step =
      (kept && there.find(({ outcome }) => outcome.resultId === kept.id)) ??
      (kept && (await side.takeUp(label, statement, cells, kept))) ??
      (await side.make(label, statement, cells));
    if (!step) return false;
    made.push(step);
  }
  const stepsOf = (numbers: readonly number[]): Step[] => numbers.flatMap((number) => made[number] ?? []);
  for (const name of ["left", "right"] as const) {
    const { steps, undone, control } = link[name];
    const mesh = control === null ? null : (made[control] ?? null);
    workbench.side(name).take(stepsOf(steps), stepsOf(undone ?? []), mesh);
  }
  return true;
}

function resolved(
  inputs: LinkStep["inputs"],
  made: readonly Step[],
  results: readonly (string | null)[],
): Step["inputs"] {
  const found: Record<string, Step | CellRef> = {};
  for (const [name, input] of Object.entries(inputs)) {
    const step = typeof input === "number" ? made[input] : undefined;
    if (step) found[name] = step;
    if (typeof input !== "number") {
      const [place, row, column] = input;
      found[name] = { result: results[place] ?? "", row, column };
    }
  }
  return found;
}

/** The steps of a link that a person has to agree to: those that are not operations of the split screen. */
export function foreignSteps({ steps }: LinkCompare): readonly LinkStep[] {
  return steps.filter(({ statement }) => !isWorkbenchStatement(statement));
}

export function isLinkCompare(value: unknown): value is LinkCompare {
  if (typeof value !== "object" || value === null) return false;
  const { steps, left, right } = value as Partial<LinkCompare>;
  return (
    Array.isArray(steps) &&
    steps.every(
      (step: Partial<LinkStep> | null) =>
        typeof step?.label === "string" &&
        typeof step.statement === "string" &&
        typeof step.inputs === "object" &&
        (step.kept === undefined || isKept(step.kept)),
    ) &&
    [left, right].every((side) => Array.isArray(side?.steps))
  );
}
