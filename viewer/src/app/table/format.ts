import type { Column, Json, Row } from "../../api/types";
import { summaryOf } from "../../state/outcome";
import { isRelation } from "../../state/types";

/** What a cell shows. */
export type CellView =
  | { readonly kind: "undefined" }
  | { readonly kind: "number" | "text"; readonly text: string }
  | { readonly kind: "geometry"; readonly type: string; readonly count: string; readonly box: string }
  | { readonly kind: "relation"; readonly rows: readonly Row[] };

export function viewOf(value: Json, type: string): CellView {
  if (value === null) return { kind: "undefined" };
  if (typeof value === "number") return { kind: "number", text: String(value) };
  if (typeof value === "boolean") return { kind: "text", text: value ? "TRUE" : "FALSE" };
  if (typeof value === "string") return { kind: "text", text: value };
  const summary = summaryOf(value);
  if (summary)
    return { kind: "geometry", type: summary.type, count: summary.count, box: boxText(summary.box) };
  if (Array.isArray(value) && isRelation(type)) return { kind: "relation", rows: value as readonly Row[] };
  return { kind: "text", text: listText(value) };
}

/** A structured value as a nested list, as the language writes it. */
export function listText(value: Json): string {
  if (value === null) return "undefined";
  if (typeof value === "boolean") return value ? "TRUE" : "FALSE";
  if (typeof value === "number" || typeof value === "string") return String(value);
  if (Array.isArray(value)) return `(${(value as readonly Json[]).map(listText).join(" ")})`;
  return JSON.stringify(value);
}

/** `(0 4) (0 4) (0 12)`, as the shell prints boxes. */
export function boxText(box: readonly number[] | null): string {
  if (!box) return "";
  const pairs: string[] = [];
  for (let index = 0; index + 1 < box.length; index += 2)
    pairs.push(`(${shortNumber(box[index] ?? 0)} ${shortNumber(box[index + 1] ?? 0)})`);
  return pairs.join(" ");
}

/** Six significant digits. */
export function shortNumber(value: number): string {
  return String(Number(value.toPrecision(6)));
}

/** Whether a cell has more than its line shows. */
export function canOpen(view: CellView): boolean {
  if (view.kind === "geometry") return true;
  if (view.kind === "relation") return view.rows.length > 0;
  return view.kind === "text" && (view.text.length > 30 || view.text.includes("\n"));
}

/** Widths of columns in pixels, from their types and the first rows. */
export function columnWidths(columns: readonly Column[], rows: readonly (Row | null)[]): number[] {
  return columns.map(({ name, type, shape }) => {
    // "volume3d, 1,350,000 triangles" with its buttons.
    if (shape) return 270;
    const lengths = rows.map((row) => {
      const view = row ? viewOf(row[name] ?? null, type) : null;
      return view && "text" in view ? view.text.length : view?.kind === "geometry" ? 26 : 9;
    });
    const longest = Math.max(name.length + 4, type.length, ...lengths);
    return Math.min(420, Math.max(84, longest * 7.4 + 40));
  });
}

/** Texts become narrower until all columns are seen, or wider where there is room. */
export function fittedWidths(
  widths: readonly number[],
  columns: readonly Column[],
  available: number,
): readonly number[] {
  // Columns of an inquiry have no type; those of texts are seen by their width.
  const isText = ({ type }: Column, width: number) =>
    type === "string" || type === "text" || (type === "" && width > leastTextWidth);
  const texts = widths.filter((width, index) => columns[index] && isText(columns[index], width));
  const sum = texts.reduce((total, width) => total + width, 0);
  const others = widths.reduce((total, width) => total + width, 0) - sum;
  if (sum === 0) return widths;
  const factor = (available - others) / sum;
  return widths.map((width, index) => {
    if (!columns[index] || !isText(columns[index], width)) return width;
    const wanted = Math.floor(width * factor);
    return factor < 1 ? Math.max(Math.min(width, leastTextWidth), wanted) : Math.min(2 * width, wanted);
  });
}

const leastTextWidth = 120;

/** By name of a column, the folder in which all of its texts lie; what tells them apart comes after it. */
export function commonFolders(
  columns: readonly Column[],
  rows: readonly (Row | null)[],
): ReadonlyMap<string, string> {
  const folders = new Map<string, string>();
  for (const { name } of columns) {
    const texts = rows.flatMap((row) => (typeof row?.[name] === "string" ? [row[name]] : []));
    const folder = texts.length > 1 ? folderOf(texts) : "";
    if (folder.length >= leastFolder) folders.set(name, folder);
  }
  return folders;
}

/** Shorter ones are shown. */
const leastFolder = 8;

function folderOf(texts: readonly string[]): string {
  let common = texts[0] ?? "";
  for (const text of texts) {
    let length = 0;
    while (length < common.length && common[length] === text[length]) length++;
    common = common.slice(0, length);
  }
  return common.slice(0, Math.max(common.lastIndexOf("/"), common.lastIndexOf("\\")) + 1);
}

export function seconds(value: number): string {
  if (value < 0.001) return "< 1 ms";
  if (value < 1) return `${Math.round(value * 1000)} ms`;
  return value < 100 ? `${value.toPrecision(3)} s` : `${Math.round(value)} s`;
}

export function bytesText(bytes: number): string {
  if (bytes < 1000) return `${bytes} bytes`;
  const units = ["kB", "MB", "GB"];
  let amount = bytes / 1000;
  let unit = 0;
  while (amount >= 1000 && unit < units.length - 1) {
    amount /= 1000;
    unit++;
  }
  return `${amount.toPrecision(3)} ${units[unit] ?? ""}`;
}
