import { type Signal } from "@preact/signals";
import { isBoolean, isNumber, isOneOf, keptSignal } from "./settings";

export type Mode = "explore" | "compare";
export type SideTab = "objects" | "operators" | "history" | "view";
export type Sheet = "query" | "results" | "scene" | "view";

/** Sizes in pixels and what is open; kept in the browser. */
export interface Layout {
  readonly sideWidth: Signal<number>;
  readonly bottomHeight: Signal<number>;
  readonly sideOpen: Signal<boolean>;
  readonly bottomOpen: Signal<boolean>;
  /** What the panel beside the scene shows: a list, or the settings of the view. */
  readonly sideTab: Signal<SideTab>;
  /** Which panel the sheet of a narrow page shows. */
  readonly sheet: Signal<Sheet>;
}

/** Of the height of the page: beside the panel at the side, the scene has half of a small page then. */
const bottomShare = 0.25;

export function makeLayout(storage: Storage): Layout {
  const size = (name: string, initial: number) => keptSignal(storage, `layout.${name}`, initial, isNumber);
  const open = (name: string, initial: boolean) => keptSignal(storage, `layout.${name}`, initial, isBoolean);
  return {
    sideWidth: size("sideWidth", 260),
    bottomHeight: size("bottomHeight", Math.round(bottomShare * innerHeight)),
    sideOpen: open("sideOpen", true),
    bottomOpen: open("bottomOpen", true),
    sideTab: keptSignal<SideTab>(
      storage,
      "layout.sideTab",
      "objects",
      isOneOf("objects", "operators", "history", "view"),
    ),
    sheet: keptSignal<Sheet>(storage, "layout.sheet", "query", isOneOf("query", "results", "scene", "view")),
  };
}
