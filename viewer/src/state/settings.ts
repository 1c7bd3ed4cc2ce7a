import { effect, signal, type Signal } from "@preact/signals";

/** A signal whose value is kept in the browser; `check` refuses what an older version may have left there. */
export function keptSignal<T>(
  storage: Pick<Storage, "getItem" | "setItem">,
  name: string,
  initial: T,
  check: (value: unknown) => value is T,
): Signal<T> {
  const key = `algebra3d.${name}`;
  const kept = signal(readKept(storage.getItem(key), initial, check));
  let first = true;
  effect(() => {
    const text = JSON.stringify(kept.value);
    if (first) {
      first = false;
      return;
    }
    try {
      storage.setItem(key, text);
    } catch {
      // Without storage the value lives as long as the page.
    }
  });
  return kept;
}

function readKept<T>(text: string | null, initial: T, check: (value: unknown) => value is T): T {
  if (text === null) return initial;
  try {
    const value: unknown = JSON.parse(text);
    return check(value) ? value : initial;
  } catch {
    return initial;
  }
}

export const isNumber = (value: unknown): value is number =>
  typeof value === "number" && Number.isFinite(value);
export const isString = (value: unknown): value is string => typeof value === "string";
export const isBoolean = (value: unknown): value is boolean => typeof value === "boolean";

export function isOneOf<T extends string>(...values: readonly T[]): (value: unknown) => value is T {
  return (value): value is T => (values as readonly unknown[]).includes(value);
}
