import { signal, type ReadonlySignal } from "@preact/signals";

const key = "algebra3d.history";
const kept = 500;

export interface HistoryEntry {
  readonly text: string;
  /** Milliseconds since the epoch. */
  readonly time: number;
  readonly ok: boolean;
}

/** The statements that were run in this browser, the latest first, each once. */
export class History {
  readonly entries: ReadonlySignal<readonly HistoryEntry[]>;
  readonly #entries = signal<readonly HistoryEntry[]>([]);
  readonly #storage: Pick<Storage, "getItem" | "setItem">;

  constructor(storage: Pick<Storage, "getItem" | "setItem">) {
    this.#storage = storage;
    this.#entries.value = read(storage.getItem(key));
    this.entries = this.#entries;
  }

  add(text: string, ok: boolean, time = Date.now()): void {
    const trimmed = text.trim();
    if (!trimmed) return;
    const others = this.#entries.value.filter((entry) => entry.text !== trimmed);
    this.#save([{ text: trimmed, ok, time }, ...others].slice(0, kept));
  }

  clear(): void {
    this.#save([]);
  }

  /** Whether a statement was run here before, successfully. */
  knows(text: string): boolean {
    return this.#entries.value.some((entry) => entry.ok && entry.text === text.trim());
  }

  /** The entries with all words of `pattern`, in any case. */
  search(pattern: string): readonly HistoryEntry[] {
    const words = pattern.toLowerCase().split(/\s+/).filter(Boolean);
    return this.#entries.value.filter(({ text }) => words.every((word) => text.toLowerCase().includes(word)));
  }

  #save(entries: readonly HistoryEntry[]): void {
    this.#entries.value = entries;
    try {
      this.#storage.setItem(key, JSON.stringify(entries));
    } catch {
      // The storage is full or switched off: the history lives as long as the page.
    }
  }
}

function read(text: string | null): readonly HistoryEntry[] {
  try {
    const entries: unknown = JSON.parse(text ?? "[]");
    return Array.isArray(entries) ? entries.filter(isEntry) : [];
  } catch {
    return [];
  }
}

function isEntry(value: unknown): value is HistoryEntry {
  return typeof value === "object" && value !== null && "text" in value && typeof value.text === "string";
}
