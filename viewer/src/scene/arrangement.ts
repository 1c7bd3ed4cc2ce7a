/**
 * Where objects are drawn: in their places, moved apart from their common centre, or as a contact sheet, each in a cell
 * of its own with its name below. The sheet stands upright to the isometric view.
 */

import { Vector3 } from "three";
import type { Box3 } from "three";

import type { AttributeValue, DisplayState, Vec3 } from "./api";
import type { AttributeValues } from "./attribute_values";
import { basisOf } from "./camera";
import type { ShapeRecord, ShapeStore } from "./shape_store";
import { kDefaultCamera } from "./state";
import { fromVector3, toBox3 } from "./vec";

/** The name of an object below its cell. */
export interface SheetLabel {
  readonly at: Vec3;
  readonly text: string;
  /** Of the cell, in coordinate units. */
  readonly width: number;
}

export interface Arranged {
  readonly offsetOf: (record: ShapeRecord) => Vec3;
  readonly labels: readonly SheetLabel[];
}

const kNoOffset: Vec3 = [0, 0, 0];
/** Free space between cells, as a share of the middle size of the objects. */
const kGap = 0.25;
/** Of a cell, by the middle size of the objects. */
const kLeastWidth = 0.9;
/** Width of a sheet by its height, about that of a view. */
const kAspect = 2;
const { right: kRight, up: kUp } = basisOf(kDefaultCamera);

export function arranged(store: ShapeStore, display: DisplayState, values: AttributeValues): Arranged {
  switch (display.arrangement) {
    case "place":
      return { offsetOf: () => kNoOffset, labels: [] };
    case "exploded": {
      const centre = store.centre();
      return { offsetOf: (record) => exploded(record, centre, display.explode), labels: [] };
    }
    case "grid":
      return sheet(ordered([...store.visibleRecords()], display, values), values);
  }
}

function exploded({ firstShape: { box } }: ShapeRecord, centre: Vector3, factor: number): Vec3 {
  if (!box) return kNoOffset;
  return fromVector3(toBox3(box).getCenter(new Vector3()).sub(centre).multiplyScalar(factor));
}

/** By the values of an attribute, undefined ones last; equal ones in the order of their rows. */
function ordered(
  records: ShapeRecord[],
  { sortBy, descending }: DisplayState,
  values: AttributeValues,
): ShapeRecord[] {
  const sign = descending ? -1 : 1;
  const valueOf = ({ column, row }: ShapeRecord): AttributeValue =>
    sortBy === "" ? row : (values.of(column, sortBy)?.[row] ?? null);
  const keyed = records.map((record) => ({ record, value: valueOf(record) }));
  keyed.sort((a, b) => sign * compared(a.value, b.value, sign) || a.record.row - b.record.row);
  return keyed.map(({ record }) => record);
}

function compared(a: AttributeValue, b: AttributeValue, sign: number): number {
  if (a === b) return 0;
  if (a === null || b === null) return a === null ? sign : -sign;
  if (typeof a === "number" && typeof b === "number") return a - b;
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

/** An object on the sheet: its middle, and its size as the isometric view sees it. */
interface Cell {
  readonly record: ShapeRecord;
  readonly middle: Vector3;
  readonly width: number;
  readonly height: number;
}

function sheet(records: readonly ShapeRecord[], values: AttributeValues): Arranged {
  const objects = records.flatMap((record) => cellOf(record) ?? []);
  const sizes = objects.map(({ width, height }) => Math.max(width, height)).sort((a, b) => a - b);
  const middle = sizes[sizes.length >> 1] ?? 1;
  const gap = kGap * middle;
  // A name has room below a small object, too.
  const cells = objects.map((cell) => ({ ...cell, width: Math.max(cell.width, kLeastWidth * middle) }));
  const area = cells.reduce((sum, { width, height }) => sum + (width + gap) * (height + 2 * gap), 0);
  const rows = rowsOf(cells, Math.sqrt(area * kAspect), gap);
  const offsets = new Map<ShapeRecord, Vec3>();
  const labels: SheetLabel[] = [];
  let y = 0;
  for (const row of rows) {
    const height = Math.max(...row.map((cell) => cell.height));
    let x = 0;
    for (const cell of row) {
      const place = onSheet(x + cell.width / 2, y - height / 2);
      offsets.set(cell.record, fromVector3(place.sub(cell.middle)));
      const foot = onSheet(x + cell.width / 2, y - height - gap / 2);
      labels.push({ at: fromVector3(foot), text: nameOf(cell.record, values), width: cell.width + gap });
      x += cell.width + gap;
    }
    y -= height + 2 * gap;
  }
  return { offsetOf: (record) => offsets.get(record) ?? kNoOffset, labels };
}

const onSheet = (x: number, y: number): Vector3 => kRight.clone().multiplyScalar(x).addScaledVector(kUp, y);

/** Fills rows of a width one after the other; each has one cell at least. */
function rowsOf(cells: readonly Cell[], width: number, gap: number): Cell[][] {
  const rows: Cell[][] = [];
  let used = Infinity;
  for (const cell of cells) {
    if (used + cell.width > width) {
      rows.push([]);
      used = 0;
    }
    rows.at(-1)!.push(cell);
    used += cell.width + gap;
  }
  return rows;
}

function cellOf(record: ShapeRecord): Cell | null {
  const { box } = record.firstShape;
  if (!box) return null;
  const box3 = toBox3(box);
  return {
    record,
    middle: box3.getCenter(new Vector3()),
    width: extentAlong(box3, kRight),
    height: extentAlong(box3, kUp),
  };
}

function extentAlong(box: Box3, axis: Vector3): number {
  const size = box.getSize(new Vector3());
  return Math.abs(axis.x) * size.x + Math.abs(axis.y) * size.y + Math.abs(axis.z) * size.z;
}

/** The first text of its row, else the number of the row. */
export function nameOf({ column, row }: ShapeRecord, values: AttributeValues): string {
  const attribute = column.source.attributes.find(({ type }) => type === "string" || type === "text");
  const name = attribute && values.of(column, attribute.name)?.[row];
  return typeof name === "string" && name !== "" ? name : `row ${row + 1}`;
}
