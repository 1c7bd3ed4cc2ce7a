import { computed, signal, type ReadonlySignal } from "@preact/signals";
import type { LinkView } from "./permalink";

/** Changes that can be undone. */
const most = 200;

/** The views of a page one after the other, and the present one among them. */
export class ViewHistory {
  readonly canUndo: ReadonlySignal<boolean>;
  readonly canRedo: ReadonlySignal<boolean>;
  readonly #views = signal<readonly LinkView[]>([]);
  readonly #at = signal(-1);

  constructor() {
    this.canUndo = computed(() => this.#at.value > 0);
    this.canRedo = computed(() => this.#at.value < this.#views.value.length - 1);
  }

  get present(): LinkView | null {
    return this.#views.value[this.#at.value] ?? null;
  }

  /** Takes a view as the next one; those that were undone are forgotten. False if it is the present one. */
  record(view: LinkView): boolean {
    if (this.present && JSON.stringify(view) === JSON.stringify(this.present)) return false;
    this.#views.value = [...this.#views.value.slice(0, this.#at.value + 1), view].slice(-most);
    this.#at.value = this.#views.value.length - 1;
    return true;
  }

  /** Puts a view in the place of the present one. */
  amend(view: LinkView): void {
    this.#views.value = this.#views.value.map((other, index) => (index === this.#at.value ? view : other));
  }

  undo(): LinkView | null {
    return this.#go(-1);
  }

  redo(): LinkView | null {
    return this.#go(1);
  }

  #go(by: number): LinkView | null {
    const view = this.#views.value[this.#at.value + by];
    if (!view) return null;
    this.#at.value += by;
    return view;
  }
}
