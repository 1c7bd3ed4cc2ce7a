import { signal, type ReadonlySignal } from "@preact/signals";
import type { Client } from "../api/client";
import { ApiError, messageOf } from "../api/errors";
import type { ServerInfo } from "../api/types";

export type ConnectionStatus = "connecting" | "online" | "gone" | "unauthorized";

const pollSeconds = 10;
/** Asking a server that is gone costs nothing that anybody would notice. */
const pollSecondsGone = 1;

/** Whether the server answers; asks it now and then, and each second after it has gone. */
export class Connection {
  readonly status: ReadonlySignal<ConnectionStatus>;
  readonly info: ReadonlySignal<ServerInfo | null>;
  /** Why the server does not answer. */
  readonly reason: ReadonlySignal<string>;
  /** Called when the server answers for the first time, and again after it had gone. */
  onOnline: () => void = () => undefined;
  readonly #status = signal<ConnectionStatus>("connecting");
  readonly #info = signal<ServerInfo | null>(null);
  readonly #reason = signal("");
  readonly #client: Client;
  #asking = false;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(client: Client) {
    this.#client = client;
    this.status = this.#status;
    this.info = this.#info;
    this.reason = this.#reason;
  }

  /** Asks the server now. */
  async check(): Promise<void> {
    clearTimeout(this.#timer);
    this.#asking = true;
    const before = this.#status.value;
    try {
      this.#info.value = await this.#client.server(AbortSignal.timeout(10_000));
      this.#status.value = "online";
    } catch (error) {
      this.#reason.value = messageOf(error);
      // An error of the server is an answer, too; only a token is something that a person can add.
      if (error instanceof ApiError && error.status === 401) this.#status.value = "unauthorized";
      else this.#status.value = "gone";
    }
    this.#asking = false;
    this.#schedule();
    if (this.#status.value === "online" && before !== "online") this.onOnline();
  }

  /** The server has answered something else. */
  answered(): void {
    if (this.#status.value === "gone" && !this.#asking) void this.check();
  }

  stop(): void {
    clearTimeout(this.#timer);
  }

  #schedule(): void {
    clearTimeout(this.#timer);
    if (this.#status.value === "unauthorized") return;
    const gone = this.#status.value === "gone";
    const wait = gone ? pollSecondsGone : pollSeconds;
    this.#timer = setTimeout(() => void this.check(), wait * 1000);
  }
}
