import { signal, type ReadonlySignal } from "@preact/signals";

export type NoticeKind = "info" | "success" | "error";

export interface NoticeAction {
  readonly label: string;
  run(): void;
}

export interface Notice {
  readonly key: number;
  readonly kind: NoticeKind;
  readonly text: string;
  readonly detail: string;
  readonly action: NoticeAction | null;
}

const shownSeconds = 6;

/** Short messages at the edge of the page. Errors stay until they are closed. */
export class Notices {
  readonly list: ReadonlySignal<readonly Notice[]>;
  readonly #list = signal<readonly Notice[]>([]);
  #count = 0;

  constructor() {
    this.list = this.#list;
  }

  add(kind: NoticeKind, text: string, more: { detail?: string; action?: NoticeAction } = {}): void {
    const notice = { key: ++this.#count, kind, text, detail: more.detail ?? "", action: more.action ?? null };
    const others = this.#list.value.filter((other) => other.text !== text || other.detail !== notice.detail);
    this.#list.value = [...others, notice].slice(-5);
    if (kind !== "error" && !notice.action) setTimeout(() => this.close(notice.key), shownSeconds * 1000);
  }

  close(key: number): void {
    this.#list.value = this.#list.value.filter((notice) => notice.key !== key);
  }
}
