import { signal, type ReadonlySignal } from "@preact/signals";
import type { Client } from "../api/client";
import { ApiError, isAbort, messageOf } from "../api/errors";
import type { QueryAnswer } from "../api/types";
import { firstRows } from "./kept_result";
import { makeOutcome, type Outcome, type Parameters } from "./outcome";

/** A statement that is being run. */
export interface Running {
  readonly id: string;
  readonly statement: string;
  /** Milliseconds since the epoch. */
  readonly started: number;
  readonly progress: ReadonlySignal<string>;
  readonly stop: () => void;
}

/** A statement that failed. */
export interface Failure {
  readonly statement: string;
  readonly message: string;
  readonly remedy: string;
  readonly code: string;
  /** Place in the statement, counted from 1 in characters. */
  readonly place: { readonly line: number; readonly column: number } | null;
}

/** Runs statements and knows which are running. */
export class Runner {
  readonly running: ReadonlySignal<readonly Running[]>;
  readonly #running = signal<readonly Running[]>([]);
  readonly #client: Client;
  #count = 0;
  readonly #prefix = `v${Math.random().toString(36).slice(2, 10)}`;

  constructor(client: Client) {
    this.#client = client;
    this.running = this.#running;
  }

  /** Runs a statement whose outcome is to be shown; a failure or a stop is returned, not thrown. */
  async run(
    statement: string,
    parameters: Parameters = {},
    signal?: AbortSignal,
  ): Promise<Outcome | Failure> {
    try {
      return makeOutcome(
        this.#client,
        statement,
        parameters,
        await this.answer(statement, parameters, signal),
      );
    } catch (error) {
      return failureOf(statement, error);
    }
  }

  /** Runs a statement for its answer. Rejects as Client does. */
  async answer(statement: string, parameters: Parameters = {}, signal?: AbortSignal): Promise<QueryAnswer> {
    const id = `${this.#prefix}-${++this.#count}`;
    const abort = new AbortController();
    const progress = makeProgress();
    const running: Running = {
      id,
      statement,
      started: Date.now(),
      progress,
      stop: () => {
        // Closing the connection cancels it as well; the request says so even if a proxy keeps that open.
        void this.#client.cancel(id).catch(() => undefined);
        abort.abort();
      },
    };
    signal?.addEventListener("abort", running.stop, { once: true });
    this.#running.value = [...this.#running.value, running];
    try {
      signal?.throwIfAborted();
      const request = {
        statement,
        id,
        rows: firstRows,
        ...(Object.keys(parameters).length ? { parameters } : {}),
      };
      return await this.#client.run(request, ({ text }) => (progress.value = text), abort.signal);
    } finally {
      signal?.removeEventListener("abort", running.stop);
      this.#running.value = this.#running.value.filter((other) => other !== running);
    }
  }

  stopAll(): void {
    for (const running of this.#running.value) running.stop();
  }
}

const makeProgress = () => signal("");

export function isFailure(outcome: Outcome | Failure): outcome is Failure {
  return "code" in outcome;
}

export function failureOf(statement: string, error: unknown): Failure {
  if (error instanceof ApiError) {
    const { message, remedy, code, place } = error;
    return { statement, message, remedy, code, place };
  }
  if (isAbort(error)) return { statement, message: "Stopped.", remedy: "", code: "interrupted", place: null };
  return { statement, message: messageOf(error), remedy: "", code: "no_answer", place: null };
}
