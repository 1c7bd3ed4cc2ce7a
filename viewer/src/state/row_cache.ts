import { signal, type ReadonlySignal } from "@preact/signals";
import { ApiError, isAbort, messageOf } from "../api/errors";
import type { Row, RowsAnswer } from "../api/types";

const pageRows = 200;
/** Pages that are kept; rows that were not seen for longest are read again. */
const keptPages = 150;

export type ReadRows = (from: number, count: number, signal: AbortSignal) => Promise<RowsAnswer>;

/** Why rows cannot be read: the result was dropped by the server, or another error. */
export interface RowProblem {
  readonly gone: boolean;
  readonly message: string;
}

/**
 * The rows of a table, read in pages when they are first needed. `changed` counts up when rows have arrived, so that
 * whoever reads it is drawn again.
 */
export class RowCache {
  readonly count: number;
  readonly changed: ReadonlySignal<number>;
  readonly problem: ReadonlySignal<RowProblem | null>;
  readonly #changed = signal(0);
  readonly #problem = signal<RowProblem | null>(null);
  readonly #pages = new Map<number, Row[]>();
  readonly #loading = new Map<number, Promise<void>>();
  readonly #read: ReadRows | null;
  readonly #abort = new AbortController();

  /** `first` are the first rows, which are kept; `read` is null if these are all. */
  constructor(count: number, first: readonly Row[], read: ReadRows | null) {
    this.count = count;
    this.#read = read;
    this.changed = this.#changed;
    this.problem = this.#problem;
    for (let from = 0; from < first.length; from += pageRows) {
      const page = first.slice(from, from + pageRows);
      // A page in part would never be completed.
      if (page.length === pageRows || from + page.length >= count) this.#pages.set(from / pageRows, page);
    }
  }

  /** The row if it is here; else null, and it is on its way. */
  row(index: number): Row | null {
    const number = Math.floor(index / pageRows);
    const page = this.#pages.get(number);
    if (page) return page[index % pageRows] ?? null;
    void this.#load(number);
    return null;
  }

  /** Waits for a row; null if it cannot be read. */
  async rowLater(index: number): Promise<Row | null> {
    const number = Math.floor(index / pageRows);
    if (!this.#pages.has(number)) await this.#load(number);
    return this.#pages.get(number)?.[index % pageRows] ?? null;
  }

  /** Tries again after a problem. */
  retry(): void {
    this.#problem.value = null;
    this.#changed.value++;
  }

  dispose(): void {
    this.#abort.abort();
  }

  #load(number: number): Promise<void> {
    if (this.#read === null || this.#problem.peek() !== null) return Promise.resolve();
    let loading = this.#loading.get(number);
    if (!loading) {
      loading = this.#readPage(number, this.#read).finally(() => this.#loading.delete(number));
      this.#loading.set(number, loading);
    }
    return loading;
  }

  async #readPage(number: number, read: ReadRows): Promise<void> {
    const rows: Row[] = [];
    const wanted = Math.min(pageRows, this.count - number * pageRows);
    try {
      // The server sends fewer rows than asked for if they are large.
      while (rows.length < wanted) {
        const from = number * pageRows + rows.length;
        const answer = await read(from, wanted - rows.length, this.#abort.signal);
        if (answer.rows.length === 0) throw new Error(`The server sent no row ${from} of ${this.count}.`);
        rows.push(...answer.rows);
      }
    } catch (error) {
      if (isAbort(error)) return;
      const gone = error instanceof ApiError && (error.status === 410 || error.status === 404);
      this.#problem.value = { gone, message: messageOf(error) };
      return;
    }
    this.#pages.set(number, rows);
    if (this.#pages.size > keptPages) this.#dropOldest(number);
    this.#changed.value++;
  }

  #dropOldest(kept: number): void {
    for (const number of this.#pages.keys()) {
      if (number === 0 || number === kept) continue;
      this.#pages.delete(number);
      return;
    }
  }
}
