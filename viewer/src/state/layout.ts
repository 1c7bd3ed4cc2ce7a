import { type Signal } from "@preact/signals";
import { isBoolean, isNumber, isOneOf, keptSignal } from "./settings";

export type Mode = "explore" | "compare";
export type LeftTab = "objects" | "operators" | "history";
export type Sheet = "query" | "results" | "scene" | "view";

/** Sizes in pixels and what is open; kept in the browser. */
export interface Layout {
  readonly leftWidth: Signal<number>;
  readonly rightWidth: Signal<number>;
  readonly bottomHeight: Signal<number>;
  readonly editorHeight: Signal<number>;
  readonly leftOpen: Signal<boolean>;
  readonly rightOpen: Signal<boolean>;
  readonly bottomOpen: Signal<boolean>;
  readonly leftTab: Signal<LeftTab>;
  /** Which panel the sheet of a narrow page shows. */
  readonly sheet: Signal<Sheet>;
}

export function makeLayout(storage: Storage): Layout {
  const size = (name: string, initial: number) => keptSignal(storage, `layout.${name}`, initial, isNumber);
  const open = (name: string, initial: boolean) => keptSignal(storage, `layout.${name}`, initial, isBoolean);
  return {
    leftWidth: size("leftWidth", 380),
    rightWidth: size("rightWidth", 290),
    bottomHeight: size("bottomHeight", 280),
    editorHeight: size("editorHeight", 240),
    leftOpen: open("leftOpen", true),
    rightOpen: open("rightOpen", false),
    bottomOpen: open("bottomOpen", true),
    leftTab: keptSignal<LeftTab>(
      storage,
      "layout.leftTab",
      "objects",
      isOneOf("objects", "operators", "history"),
    ),
    sheet: keptSignal<Sheet>(storage, "layout.sheet", "query", isOneOf("query", "results", "scene", "view")),
  };
}
