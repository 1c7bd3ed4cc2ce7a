import { computed, effect, signal, type ReadonlySignal, type Signal } from "@preact/signals";
import { isOneOf, keptSignal } from "./settings";

export type ThemeChoice = "system" | "dark" | "light";

export interface Theme {
  readonly choice: Signal<ThemeChoice>;
  /** The theme in force. */
  readonly current: ReadonlySignal<"dark" | "light">;
}

/** The theme of the page: that of the system unless a person chose one. Sets `data-theme` of the root element. */
export function makeTheme(storage: Storage): Theme {
  const choice = keptSignal<ThemeChoice>(storage, "theme", "system", isOneOf("system", "dark", "light"));
  const query = matchMedia("(prefers-color-scheme: light)");
  const systemIsLight = signal(query.matches);
  query.addEventListener("change", (event) => (systemIsLight.value = event.matches));
  const current = computed(() => {
    if (choice.value !== "system") return choice.value;
    return systemIsLight.value ? "light" : "dark";
  });
  effect(() => {
    document.documentElement.dataset["theme"] = current.value;
  });
  return { choice, current };
}
