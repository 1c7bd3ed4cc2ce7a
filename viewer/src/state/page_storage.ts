class MemoryStorage implements Storage {
  readonly #kept = new Map<string, string>();

  get length(): number {
    return this.#kept.size;
  }
  key(index: number): string | null {
    return [...this.#kept.keys()][index] ?? null;
  }
  getItem(key: string): string | null {
    return this.#kept.get(key) ?? null;
  }
  setItem(key: string, value: string): void {
    this.#kept.set(key, value);
  }
  removeItem(key: string): void {
    this.#kept.delete(key);
  }
  clear(): void {
    this.#kept.clear();
  }
}

/** A storage, or one in memory where it may not be used. */
export function usable(storage: () => Storage): Storage {
  try {
    const found = storage();
    // Some browsers give it and refuse its use.
    found.getItem("");
    return found;
  } catch {
    return new MemoryStorage();
  }
}

/**
 * The storage of this tab and of all pages of this server. Where a browser refuses it, as in a frame of another server,
 * what is kept lasts until the page is left.
 */
export const tabStorage: Storage = usable(() => sessionStorage);
export const siteStorage: Storage = usable(() => localStorage);
