import { signal, type ReadonlySignal } from "@preact/signals";
import type { Client } from "../api/client";
import { ApiError, messageOf } from "../api/errors";
import type { ServerInfo } from "../api/types";

export type ConnectionStatus = "connecting" | "online" | "gone" | "unauthorized";

const pollSeconds = 10;
const longestWait = 15;

/** Whether the server answers; asks it now and then, and with growing pauses after it has gone. */
export class Connection {
  readonly status: ReadonlySignal<ConnectionStatus>;
  readonly info: ReadonlySignal<ServerInfo | null>;
  /** Why the server does not answer. */
  readonly reason: ReadonlySignal<string>;
  /** When it is asked again, in milliseconds since the epoch; null if it is online or being asked. */
  readonly nextTry: ReadonlySignal<number | null>;
  /** Called when the server answers for the first time, and again after it had gone. */
  onOnline: () => void = () => undefined;
  readonly #status = signal<ConnectionStatus>("connecting");
  readonly #info = signal<ServerInfo | null>(null);
  readonly #reason = signal("");
  readonly #nextTry = signal<number | null>(null);
  readonly #client: Client;
  #failures = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(client: Client) {
    this.#client = client;
    this.status = this.#status;
    this.info = this.#info;
    this.reason = this.#reason;
    this.nextTry = this.#nextTry;
  }

  /** Asks the server now. */
  async check(): Promise<void> {
    clearTimeout(this.#timer);
    this.#nextTry.value = null;
    const before = this.#status.value;
    try {
      this.#info.value = await this.#client.server(AbortSignal.timeout(10_000));
      this.#failures = 0;
      this.#status.value = "online";
    } catch (error) {
      this.#reason.value = messageOf(error);
      // An error of the server is an answer, too; only a token is something that a person can add.
      if (error instanceof ApiError && error.status === 401) this.#status.value = "unauthorized";
      else this.#status.value = "gone";
    }
    this.#schedule();
    if (this.#status.value === "online" && before !== "online") this.onOnline();
  }

  stop(): void {
    clearTimeout(this.#timer);
  }

  #schedule(): void {
    clearTimeout(this.#timer);
    if (this.#status.value === "unauthorized") return;
    const gone = this.#status.value === "gone";
    const wait = gone ? Math.min(2 ** this.#failures++, longestWait) : pollSeconds;
    if (gone) this.#nextTry.value = Date.now() + wait * 1000;
    this.#timer = setTimeout(() => void this.check(), wait * 1000);
  }
}
