/** The look of each object: its colour by the scheme, what was overridden, whether it is selected, where it is moved to. */

import type { AttributeValue, CellRef, Color, Legend, ObjectOverride, SceneState } from "./api";
import { arranged, nameOf } from "./arrangement";
import type { SheetLabel } from "./arrangement";
import { AttributeValues } from "./attribute_values";
import { categoryColor, mix, scaleOf } from "./colors";
import type { ColorScale } from "./colors";
import { ElementColorCache, meanColor } from "./element_colors";
import type { DrawnColors } from "./element_colors";
import { kGhostOpacity } from "./look";
import type { Look } from "./look";
import { cellKey } from "./shape_store";
import type { Column, ShapeRecord, ShapeStore } from "./shape_store";

/** Multiplied with the colours of places. */
const kWhite: Color = "#ffffff";

export class Coloring {
  private readonly values: AttributeValues;
  private readonly elementColors: ElementColorCache;
  private hasElementColors = false;
  private scale: ColorScale | null = null;
  /** Names below the cells of a contact sheet. */
  labels: readonly SheetLabel[] = [];

  constructor(
    private readonly store: ShapeStore,
    /** Values of an attribute came. */
    changed: () => void,
  ) {
    this.values = new AttributeValues(changed);
    this.elementColors = new ElementColorCache(changed);
  }

  get legend(): Legend | null {
    if (this.hasElementColors) return this.elementColors.legend(this.store.visibleRecords());
    return this.scale?.legend ?? null;
  }

  /** Gives each object its look. Cost: linear in the number of objects. */
  apply(state: SceneState, selection: readonly CellRef[]): void {
    this.makeScale(state);
    this.store.assignColorSlots();
    const overrides = new Map(state.overrides.map((override) => [cellKey(override.cell), override]));
    const selected = new Set(selection.map(cellKey));
    const arrangement = arranged(this.store, state.display, this.values);
    this.labels = arrangement.labels;
    const { cells, others } = state.focus;
    const seen = new Set(others === "ghosted" ? cells.map(cellKey) : []);
    const isGhost = (key: string): boolean => seen.size > 0 && !seen.has(key);
    this.hasElementColors = state.appearance.scheme.by === "elements";
    const byPosition = state.appearance.scheme.by === "position";
    for (const record of this.store.records()) {
      const key = cellKey(record.cell);
      const override = overrides.get(key);
      const elements =
        this.hasElementColors && !override?.color && record.visible ? this.elementColors.of(record) : null;
      const look: Look = {
        color: byPosition ? kWhite : (override?.color ?? this.colorOf(record, state, elements)),
        opacity: (override?.opacity ?? state.appearance.opacity) * (isGhost(key) ? kGhostOpacity : 1),
        pointSize: override?.pointSize ?? state.appearance.pointSize,
        selected: selected.has(key),
        offset: arrangement.offsetOf(record),
        elements,
      };
      this.store.setLook(record, look);
    }
  }

  private colorOf(record: ShapeRecord, state: SceneState, elements: DrawnColors | null): Color {
    if (elements) return meanColor(elements);
    const { scheme, color } = state.appearance;
    const { column } = record;
    if (scheme.by === "gradient") {
      const last = column.source.count - 1;
      return mix(scheme.from, scheme.to, last > 0 ? record.row / last : 0);
    }
    if (scheme.by === "attribute") {
      const known = this.values.of(column, scheme.attribute);
      if (known && this.scale) return this.scale.color(known[record.row] ?? null);
    }
    // Results that are overlaid are distinguished by their colours.
    return column.colorSlot ? categoryColor(column.colorSlot) : color;
  }

  private makeScale(state: SceneState): void {
    const { scheme } = state.appearance;
    this.scale = null;
    if (scheme.by !== "attribute") return;
    const all: AttributeValue[] = [];
    for (const column of this.store.columns)
      if (column.visible) all.push(...(this.values.of(column, scheme.attribute) ?? []));
    if (all.length > 0) this.scale = scaleOf(scheme.attribute, scheme.palette, all);
  }

  forget(column: Column): void {
    this.values.forget(column);
    this.elementColors.forget((record) => record.column === column);
  }

  forgetElementColors(): void {
    this.elementColors.forget();
  }

  /** The first text of the row of an object, else the number of the row. */
  nameOf(cell: CellRef): string {
    const record = this.store.record(cell);
    return record ? nameOf(record, this.values) : `row ${cell.row + 1}`;
  }

  /** Attributes that the objects may be coloured by, each once. */
  attributes(): { name: string; type: string }[] {
    const known = new Map<string, string>();
    for (const { source } of this.store.columns) {
      for (const { name, type } of source.attributes) if (!known.has(name)) known.set(name, type);
    }
    return [...known].map(([name, type]) => ({ name, type }));
  }
}

/** The overrides with a change for some objects; a field that is undefined goes back to the default. */
export function overridden(
  overrides: readonly ObjectOverride[],
  cells: readonly CellRef[],
  change: {
    readonly color?: Color | undefined;
    readonly pointSize?: number | undefined;
    readonly opacity?: number | undefined;
  },
): ObjectOverride[] {
  const byKey = new Map(overrides.map((override) => [cellKey(override.cell), override]));
  for (const cell of cells) {
    const merged = { ...byKey.get(cellKey(cell)), ...change, cell };
    const kept = Object.fromEntries(Object.entries(merged).filter(([, value]) => value !== undefined));
    if (Object.keys(kept).length > 1) byKey.set(cellKey(cell), kept as unknown as ObjectOverride);
    else byKey.delete(cellKey(cell));
  }
  return [...byKey.values()];
}
