import { batch, computed, signal, type ReadonlySignal } from "@preact/signals";
import { isAbort, isGone, messageOf } from "../api/errors";
import type { Json, QueryAnswer, Row } from "../api/types";
import type { CellRef } from "../scene/api";
import { takeUp, type KeptResult } from "./kept_result";
import { makeOutcome, type Outcome, type Parameters } from "./outcome";
import type { Store } from "./store";
import {
  factsStatement,
  isMeshType,
  limit,
  type LimitScheme,
  volumeStatement,
  type MeshType,
  type Operation,
} from "./workbench_operations";

export type SideName = "left" | "right";

/** A state of a mesh and how it was made, so that it can be made again if the server has dropped it. */
export interface Step {
  readonly label: string;
  readonly statement: string;
  readonly inputs: Readonly<Record<string, Step | CellRef>>;
  /** Where the mesh is now. */
  outcome: Outcome;
  readonly type: MeshType;
}

/** Numbers about a mesh, in the order in which they are shown. */
export type Facts = readonly { readonly name: string; readonly value: Json }[];

/** One side of the split screen: a mesh, and the list of its states. */
export class Side {
  readonly name: SideName;
  readonly step: ReadonlySignal<Step | null>;
  /** The states that led here, the first one first. */
  readonly steps: ReadonlySignal<readonly Step[]>;
  /** The states after it that were left by going back. */
  readonly undone: ReadonlySignal<readonly Step[]>;
  /** What is being done, with how far it is; "" if nothing. */
  readonly busy = signal("");
  readonly error = signal("");
  readonly facts = signal<Facts | null>(null);
  /** Statistics are being computed. */
  readonly counting = signal(false);
  /** A mesh whose edges are drawn over this one: the control mesh of a limit surface. */
  readonly control = signal<CellRef | null>(null);
  readonly #store: Store;
  readonly #all = signal<readonly Step[]>([]);
  /** The place of the state that is shown. */
  readonly #at = signal(-1);
  #travels: Promise<void> = Promise.resolve();
  #abort: AbortController | null = null;
  /** Of the statistics that are being computed. */
  #counting = new AbortController();

  constructor(name: SideName, store: Store) {
    this.name = name;
    this.#store = store;
    this.step = computed(() => this.#all.value[this.#at.value] ?? null);
    this.steps = computed(() => this.#all.value.slice(0, this.#at.value + 1));
    this.undone = computed(() => this.#all.value.slice(this.#at.value + 1));
  }

  /** Takes the mesh of a cell of a result. */
  async load(cell: CellRef, label = "cell"): Promise<void> {
    await this.#work(async (signal) => this.#push(await this.#make(label, "query $a", { a: cell }, signal)));
  }

  /** Takes the value of an object. */
  async loadObject(name: string): Promise<void> {
    await this.#work(async (signal) => this.#push(await this.#make(name, `query ${name}`, {}, signal)));
  }

  /** Applies operations one after the other; `operation` gets the type of the mesh before each. */
  async apply(operation: (type: MeshType) => Operation, other: Step | null = null, times = 1): Promise<void> {
    await this.#work(async (signal) => {
      for (let count = 1; count <= times; count++) {
        const step = this.step.value;
        if (!step) return;
        const { label, expression, needsOther } = operation(step.type);
        if (needsOther && !other) throw new Error("There is no mesh on the other side.");
        this.busy.value = times > 1 ? `${label}, step ${count} of ${times}` : label;
        const inputs = needsOther && other ? { a: step, b: other } : { a: step };
        this.#push(await this.#make(label, `query ${expression}`, inputs, signal));
      }
    });
  }

  /** Makes a state from others, without showing it; null if that fails, and `error` says why. */
  async make(label: string, statement: string, inputs: Step["inputs"]): Promise<Step | null> {
    let made: Step | null = null;
    await this.#work(async (signal) => {
      made = await this.#make(label, statement, inputs, signal);
    });
    return made;
  }

  /** Takes up a state whose result the server still has; null if it has not, or another statement made it. */
  async takeUp(
    label: string,
    statement: string,
    inputs: Step["inputs"],
    kept: KeptResult,
  ): Promise<Step | null> {
    if (!isMeshType(kept.type)) return null;
    const outcome = await takeUp(this.#store.client, statement, {}, kept).catch(() => null);
    return outcome && { label, statement, inputs, outcome, type: kept.type };
  }

  /** Takes states in place of those that there are; that before `undone` is shown, with the edges of `control` over it. */
  take(steps: readonly Step[], undone: readonly Step[], control: Step | null): void {
    this.stop();
    batch(() => {
      this.#show([...steps, ...undone], steps.length - 1);
      this.control.value = control ? cellOf(control) : null;
    });
  }

  /** Stops a running operation; without one, the counting. After the first, what is shown is still to be counted. */
  stop(): void {
    if (this.#abort) this.#abort.abort();
    else this.#counting.abort();
  }

  /** Goes back or on by a number of states. */
  async travel(by: number): Promise<void> {
    await this.#next(() => this.#go(this.#at.value + by));
  }

  /** Shows a state of the list. */
  async show(step: Step): Promise<void> {
    await this.#next(() => this.#go(this.#all.value.indexOf(step)));
  }

  clear(): void {
    this.stop();
    this.#show([], -1);
  }

  /** Stores the mesh as an object of the database; why that failed, or "". */
  async save(name: string): Promise<string> {
    const step = this.step.value;
    if (!step) return "There is no mesh on this side.";
    return this.#store.save(`let ${name} = $a`, { parameters: { a: cellOf(step) } });
  }

  /** Takes what an operation makes of a mesh of the other side, which is drawn over it as control mesh. */
  async derive(from: Step, { label, expression }: Operation): Promise<void> {
    await this.#work(async (signal) => {
      this.busy.value = label;
      this.#push(await this.#make(label, `query ${expression}`, { a: from }, signal));
      this.control.value = cellOf(from);
    });
  }

  /** Goes from one state to another in the order in which it is asked for, however fast that is. */
  async #next(travel: () => Promise<void>): Promise<void> {
    this.#travels = this.#travels.then(travel);
    await this.#travels;
  }

  async #go(at: number): Promise<void> {
    const target = this.#all.value[at];
    if (!target || at === this.#at.value) return;
    await this.#work(async (signal) => {
      await this.#ensure(target, signal);
      this.#show(this.#all.value, at);
    });
  }

  #push(step: Step): void {
    this.#show([...this.steps.value, step], this.steps.value.length);
  }

  /** What is no longer in the list is dropped on the server; should the page be taken back to it, it is made again. */
  #show(all: readonly Step[], at: number): void {
    const kept = new Set(all);
    for (const step of this.#all.value) if (!kept.has(step)) this.#release(step);
    batch(() => {
      this.control.value = null;
      this.#all.value = all;
      this.#at.value = at;
      this.facts.value = null;
      this.counting.value = false;
    });
    this.#counting.abort();
    this.#counting = new AbortController();
    void this.#readFacts(this.#counting.signal);
  }

  /** Does one thing at a time; an error is shown at the side. */
  async #work(action: (signal: AbortSignal) => Promise<void>): Promise<void> {
    if (this.#abort) return;
    const abort = new AbortController();
    this.#abort = abort;
    batch(() => {
      this.error.value = "";
      this.busy.value ||= "working";
    });
    try {
      await action(abort.signal);
    } catch (error) {
      this.error.value = isAbort(error) ? "Stopped." : messageOf(error);
    } finally {
      this.#abort = null;
      this.busy.value = "";
    }
  }

  async #make(label: string, statement: string, inputs: Step["inputs"], signal: AbortSignal): Promise<Step> {
    this.busy.value ||= label;
    const outcome = await this.#query(statement, inputs, signal);
    const type = outcome.answer.type ?? "";
    if (!isMeshType(type))
      throw new Error(`A ${type || "command"} is not a mesh; expected a solid, surface or mesh.`);
    if (outcome.resultId === null || outcome.answer.value === null) {
      const reason = outcome.answer.diagnostics.join(" ");
      throw new Error(`${label} is undefined. ${reason}`.trim());
    }
    return { label, statement, inputs, outcome, type };
  }

  /** Runs a statement on other states; makes them again if the server has dropped them. */
  async #query(statement: string, inputs: Step["inputs"], signal: AbortSignal): Promise<Outcome> {
    try {
      return await this.#ask(statement, inputs, signal);
    } catch (error) {
      if (!isGone(error)) throw error;
      for (const input of Object.values(inputs)) if (isStep(input)) await this.#remake(input, signal);
      return this.#ask(statement, inputs, signal);
    }
  }

  async #ask(statement: string, inputs: Step["inputs"], signal: AbortSignal): Promise<Outcome> {
    const cells = Object.entries(inputs).map(
      ([key, input]) => [key, isStep(input) ? cellOf(input) : input] as const,
    );
    const parameters: Parameters = Object.fromEntries(cells);
    const answer = await this.#store.runner.answer(statement, parameters, signal);
    return makeOutcome(this.#store.client, statement, parameters, answer);
  }

  async #remake(step: Step, signal: AbortSignal): Promise<void> {
    step.outcome = await this.#query(step.statement, step.inputs, signal);
  }

  /** Makes sure that the server has the mesh of a state. */
  async #ensure(step: Step, signal: AbortSignal): Promise<void> {
    try {
      await this.#store.client.rows(cellOf(step).result, 0, 1, signal);
    } catch (error) {
      if (!isGone(error)) throw error;
      await this.#remake(step, signal);
    }
  }

  #release(step: Step): void {
    void this.#store.client.drop(cellOf(step).result).catch(() => undefined);
  }

  async #readFacts(signal: AbortSignal): Promise<void> {
    const step = this.step.value;
    if (!step) return;
    this.counting.value = true;
    await this.#tellFacts(step, signal);
    if (this.step.value === step) this.counting.value = false;
  }

  async #tellFacts(step: Step, signal: AbortSignal): Promise<void> {
    const parameters = { a: cellOf(step) };
    const facts: { name: string; value: Json }[] = [];
    const tell = () => {
      if (this.step.value === step) this.facts.value = [{ name: "Type", value: step.type }, ...facts];
    };
    try {
      const counts = await this.#count(factsStatement(step.type), parameters, signal);
      const [row = {}] = counts.value as readonly Row[];
      for (const [name, value] of Object.entries(row)) facts.push({ name, value });
      tell();
      if (step.type === "surface3d" || row["Closed"] !== true) return;
      const volume = await this.#count(volumeStatement(step.type), parameters, signal);
      facts.push({ name: "Volume", value: volume.value });
      tell();
    } catch (error) {
      if (isAbort(error)) tell();
      else if (this.step.value === step)
        this.error.value = `The statistics cannot be computed. ${messageOf(error)}`;
    }
  }

  /** Runs a statement for its value alone. Aborting ends it on the server, too: that closes the connection. */
  async #count(statement: string, parameters: Parameters, signal: AbortSignal): Promise<QueryAnswer> {
    const { client } = this.#store;
    const answer = await client.query({ statement, parameters }, signal);
    if (answer.result) void client.drop(answer.result.id).catch(() => undefined);
    return answer;
  }
}

/** The two sides of the split screen. */
export class Workbench {
  readonly left: Side;
  readonly right: Side;

  constructor(store: Store) {
    this.left = new Side("left", store);
    this.right = new Side("right", store);
  }

  side(name: SideName): Side {
    return name === "left" ? this.left : this.right;
  }

  /** Shows the limit surface of a side's mesh on the other side. */
  async showLimit(name: SideName, scheme: LimitScheme, steps: number, variant = ""): Promise<void> {
    const step = this.side(name).step.value;
    if (step) await this.other(name).derive(step, limit(step.type, scheme, steps, variant));
  }

  other(name: SideName): Side {
    return name === "left" ? this.right : this.left;
  }
}

/** The cell in which the mesh of a state lies: results of single values have one row and the column `value`. */
export function cellOf(step: Step): CellRef {
  return { result: step.outcome.resultId ?? "", row: 0, column: "value" };
}

const isStep = (input: Step | CellRef): input is Step => "statement" in input;

/** The mesh that was chosen last among the states of a side; those after it were made from it. */
export function chosenOf(steps: readonly Step[]): Step | null {
  return steps.findLast(({ inputs }) => !Object.values(inputs).some(isStep)) ?? steps[0] ?? null;
}
