/** The colours that a mesh brings along, asked of the database by statements. */

import type { Client } from "../api/client";
import type { Json, Row } from "../api/types";
import type { CellRef, ElementColors } from "../scene/api";

/** `#rrggbb` by the name of a material. */
export type MaterialColors = Readonly<Record<string, string>>;

export const isColor = (value: unknown): value is string =>
  typeof value === "string" && /^#[0-9a-f]{6}$/i.test(value);

export function isMaterialColors(value: unknown): value is MaterialColors {
  return typeof value === "object" && value !== null && Object.values(value).every(isColor);
}

type Rgb = readonly [number, number, number];
/** Of elements of which the file says nothing. */
const kUnknown: Rgb = [0.6, 0.6, 0.6];

/** In this order: colours of vertices, of faces, of materials. Null of a mesh without any. */
export async function readElementColors(
  client: Client,
  cell: CellRef,
  materials: MaterialColors,
  signal: AbortSignal,
): Promise<ElementColors | null> {
  const read = (expression: string) => readRows(client, `query ${expression} consume`, cell, signal);
  const attributes = await read("meshAttributes($a)");
  const has = (elements: string, name: string, kind: string) =>
    attributes.some((row) => row["Elements"] === elements && row["Name"] === name && row["Kind"] === kind);
  for (const elements of ["vertex", "face"] as const)
    if (has(elements, "Colour", "vector")) {
      const rows = await read(`vectorAttribute($a, "${elements}", "Colour")`);
      return { elements, rgb: packed(rows.map(({ Value }) => colorIn(Value))) };
    }
  if (!has("face", "Material", "text")) return null;
  const rows = await read(`textAttribute($a, "face", "Material")`);
  const names = rows.map(({ Value }) => (typeof Value === "string" ? Value : ""));
  return { elements: "face", materials: names, colors: materials };
}

function colorIn(value: Json | undefined): Rgb {
  const [r, g, b] = Array.isArray(value) ? (value as readonly Json[]) : [];
  return typeof r === "number" && typeof g === "number" && typeof b === "number" ? [r, g, b] : kUnknown;
}

function packed(colors: readonly Rgb[]): Float32Array {
  const rgb = new Float32Array(3 * colors.length);
  colors.forEach((color, index) => rgb.set(color, 3 * index));
  return rgb;
}

/** All rows of a statement about a cell; its result is dropped on the server. */
async function readRows(
  client: Client,
  statement: string,
  cell: CellRef,
  signal: AbortSignal,
): Promise<readonly Row[]> {
  const answer = await client.query({ statement, parameters: { a: cell }, rows: kRowsAtOnce }, signal);
  const rows = [...(answer.value as readonly Row[])];
  const { result } = answer;
  if (!result) return rows;
  try {
    while (rows.length < result.count) {
      const next = await client.rows(result.id, rows.length, kRowsAtOnce, signal);
      if (next.rows.length === 0) throw new Error(`The server sent no row ${rows.length}.`);
      rows.push(...next.rows);
    }
  } finally {
    void client.drop(result.id).catch(() => undefined);
  }
  return rows;
}

const kRowsAtOnce = 10_000;
