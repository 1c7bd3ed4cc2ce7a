import { batch, computed, signal, type ReadonlySignal } from "@preact/signals";
import type { Client } from "../api/client";
import type { CellRef } from "../scene/api";
import type { Outcome } from "./outcome";

/** The outcomes that are kept on this page, the one whose table is shown, and the selected cell. */
export class Results {
  readonly list: ReadonlySignal<readonly Outcome[]>;
  readonly activeKey = signal<number | null>(null);
  readonly active: ReadonlySignal<Outcome | null>;
  /** The selected row, or cell if it was selected in 3D or by its column. */
  readonly selected = signal<{ result: string; row: number; column: string | null } | null>(null);
  /** New results are shown together with earlier ones; else these are hidden in 3D. */
  readonly overlay = signal(false);
  readonly #list = signal<readonly Outcome[]>([]);
  readonly #client: Client;

  constructor(client: Client) {
    this.#client = client;
    this.list = this.#list;
    this.active = computed(() => this.#list.value.find(({ key }) => key === this.activeKey.value) ?? null);
  }

  /** Adds an outcome and makes it the active one. An earlier one of the same statement gives way to it. */
  add(outcome: Outcome): void {
    batch(() => {
      const givesWay = (other: Outcome) => isSame(other, outcome) || other.isPreview;
      for (const other of this.#list.value) if (givesWay(other)) this.#release(other);
      if (!this.overlay.value && outcome.shapeColumns.length > 0) this.hideAll();
      const others = this.#list.value.filter((other) => !givesWay(other));
      this.#list.value = [...others, outcome];
      this.activeKey.value = outcome.key;
    });
  }

  /** Drops an outcome here and on the server. */
  close(outcome: Outcome): void {
    batch(() => {
      const place = this.#list.value.indexOf(outcome);
      this.#list.value = this.#list.value.filter((other) => other !== outcome);
      this.#release(outcome);
      if (this.activeKey.value === outcome.key)
        this.activeKey.value = (this.#list.value[place] ?? this.#list.value.at(-1))?.key ?? null;
    });
  }

  closeAll(): void {
    batch(() => [...this.#list.value].forEach((outcome) => this.close(outcome)));
  }

  /** Shows or hides all drawable columns of an outcome, or one of them. */
  show(outcome: Outcome, shown: boolean, column?: string): void {
    const next = new Set(outcome.shown.value);
    for (const name of column === undefined ? outcome.shapeColumns : [column])
      if (shown) next.add(name);
      else next.delete(name);
    outcome.shown.value = next;
  }

  hideAll(): void {
    for (const outcome of this.#list.value) outcome.shown.value = new Set();
  }

  ofResult(result: string): Outcome | null {
    return this.#list.value.find((outcome) => outcome.resultId === result) ?? null;
  }

  /** Selects the row of a cell, and brings its table to the front. */
  select(cell: CellRef | null): void {
    batch(() => {
      this.selected.value = cell;
      const outcome = cell ? this.ofResult(cell.result) : null;
      if (outcome) this.activeKey.value = outcome.key;
    });
  }

  #release(outcome: Outcome): void {
    outcome.table?.rows.dispose();
    if (this.selected.value?.result === outcome.resultId) this.selected.value = null;
    // If the server cannot be reached it has dropped the result, or will drop it as the oldest one.
    if (outcome.resultId !== null) void this.#client.drop(outcome.resultId).catch(() => undefined);
  }
}

function isSame(a: Outcome, b: Outcome): boolean {
  return (
    a.statement.trim() === b.statement.trim() && JSON.stringify(a.parameters) === JSON.stringify(b.parameters)
  );
}
