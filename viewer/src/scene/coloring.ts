/** The look of each object: its colour by the scheme, what was overridden, whether it is selected, where it is moved to. */

import type { AttributeValue, CellRef, Color, Legend, ObjectOverride, SceneState } from "./api";
import { categoryColor, mix, scaleOf } from "./colors";
import type { ColorScale } from "./colors";
import type { Look } from "./look";
import { cellKey } from "./shape_store";
import type { Column, ShapeRecord, ShapeStore } from "./shape_store";

const kValuesPerRequest = 10_000;
/** Multiplied with the colours of places. */
const kWhite: Color = "#ffffff";

interface Values {
  readonly attribute: string;
  readonly values: AttributeValue[];
  readonly abort: AbortController;
}

export class Coloring {
  private readonly values = new Map<Column, Values>();
  private scale: ColorScale | null = null;

  constructor(
    private readonly store: ShapeStore,
    /** Values of an attribute came. */
    private readonly changed: () => void,
  ) {}

  get legend(): Legend | null {
    return this.scale?.legend ?? null;
  }

  /** Gives each object its look. Cost: linear in the number of objects. */
  apply(state: SceneState, selection: readonly CellRef[]): void {
    this.makeScale(state);
    this.store.assignColorSlots();
    const overrides = new Map(state.overrides.map((override) => [cellKey(override.cell), override]));
    const selected = new Set(selection.map(cellKey));
    const centre = this.store.centre();
    const byPosition = state.appearance.scheme.by === "position";
    for (const record of this.store.records()) {
      const key = cellKey(record.cell);
      const override = overrides.get(key);
      const look: Look = {
        color: byPosition ? kWhite : (override?.color ?? this.colorOf(record, state)),
        opacity: override?.opacity ?? state.appearance.opacity,
        pointSize: override?.pointSize ?? state.appearance.pointSize,
        selected: selected.has(key),
        offset: this.store.explodedOffset(record, centre, state.display.explode),
      };
      this.store.setLook(record, look);
    }
  }

  private colorOf(record: ShapeRecord, state: SceneState): Color {
    const { scheme, color } = state.appearance;
    const { column } = record;
    if (scheme.by === "gradient") {
      const last = column.source.count - 1;
      return mix(scheme.from, scheme.to, last > 0 ? record.row / last : 0);
    }
    if (scheme.by === "attribute") {
      const known = this.values.get(column);
      if (known && this.scale) return this.scale.color(known.values[record.row] ?? null);
    }
    // Results that are overlaid are distinguished by their colours.
    return column.colorSlot ? categoryColor(column.colorSlot) : color;
  }

  private makeScale(state: SceneState): void {
    const { scheme } = state.appearance;
    this.scale = null;
    if (scheme.by !== "attribute") return;
    const all: AttributeValue[] = [];
    for (const column of this.store.columns) {
      if (!column.source.attributes.some(({ name }) => name === scheme.attribute)) {
        this.forget(column);
        continue;
      }
      const known = this.values.get(column);
      if (known?.attribute !== scheme.attribute) this.request(column, scheme.attribute);
      else if (column.visible) all.push(...known.values);
    }
    if (all.length > 0) this.scale = scaleOf(scheme.attribute, scheme.palette, all);
  }

  private request(column: Column, attribute: string): void {
    this.forget(column);
    const values: Values = { attribute, values: [], abort: new AbortController() };
    this.values.set(column, values);
    void this.load(column, values);
  }

  private async load(column: Column, { attribute, values, abort }: Values): Promise<void> {
    const { source } = column;
    while (values.length < source.count) {
      const part = await source
        .values(
          attribute,
          values.length,
          Math.min(kValuesPerRequest, source.count - values.length),
          abort.signal,
        )
        .catch(() => []);
      if (abort.signal.aborted || part.length === 0) break;
      values.push(...part);
    }
    if (!abort.signal.aborted) this.changed();
  }

  forget(column: Column): void {
    this.values.get(column)?.abort.abort();
    this.values.delete(column);
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
