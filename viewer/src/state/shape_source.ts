import type { ReadonlySignal } from "@preact/signals";
import type { Client } from "../api/client";
import type { AttributeValue, ShapeBatch, ShapeRequest, ShapeSource } from "../scene/api";
import type { Json } from "../api/types";
import { readElementColors, type MaterialColors } from "./element_colors";
import type { Outcome } from "./outcome";
import { titleOf } from "./outcome";

export interface ShapeServer {
  readonly client: Client;
  /** Colours of materials, as files of materials told them. */
  readonly materials: ReadonlySignal<MaterialColors>;
}

/** The geometry of a column of an outcome, for a scene. */
export function shapeSource(
  { client, materials }: ShapeServer,
  outcome: Outcome,
  column: string,
  title?: string,
): ShapeSource {
  const result = outcome.resultId;
  if (result === null || !outcome.table) throw new Error("This outcome has no result on the server.");
  return {
    result,
    column,
    title: title ?? titleOf(outcome.statement),
    isPreview: outcome.isPreview,
    count: outcome.table.rows.count,
    attributes: outcome.table.columns
      .filter(({ type }) => isColourable(type))
      .map(({ name, type }) => ({ name, type })),
    load: (request, signal) => loadShapes(client, result, column, request, signal),
    values: (attribute, from, count, signal) => readValues(client, result, attribute, from, count, signal),
    elementColors: (row, signal) =>
      readElementColors(client, { result, row, column }, materials.peek(), signal),
    progress: (signal) => client.resultProgress(result, signal),
  };
}

/** Types whose values are numbers, truth values or texts. */
export function isColourable(type: string): boolean {
  return ["int", "longint", "real", "bool", "string", "text"].includes(type);
}

async function loadShapes(
  client: Client,
  result: string,
  column: string,
  { from, count, triangles, onBytes }: ShapeRequest,
  signal: AbortSignal,
): Promise<ShapeBatch> {
  const response = await client.shapes(result, { column, from, count, triangles }, signal);
  const next = response.headers.get("X-Algebra3d-Next");
  return { bytes: await readBytes(response, onBytes), next: next === null ? null : Number(next) };
}

/** The body of an answer, with progress; written into one buffer if its length was announced. */
export async function readBytes(response: Response, onBytes?: ShapeRequest["onBytes"]): Promise<ArrayBuffer> {
  const header = response.headers.get("Content-Length");
  // The length of a compressed body is not that of its content.
  const total = header !== null && !response.headers.has("Content-Encoding") ? Number(header) : null;
  if (!response.body || !onBytes) return response.arrayBuffer();
  const pieces: Uint8Array[] = [];
  const whole = total === null ? null : new Uint8Array(total);
  let received = 0;
  const reader = response.body.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    if (whole) whole.set(value, received);
    else pieces.push(value);
    received += value.length;
    onBytes(received, total);
  }
  if (whole) {
    if (received !== whole.length)
      throw new Error(`The answer ended after ${received} of ${whole.length} bytes.`);
    return whole.buffer;
  }
  return new Blob(pieces as Uint8Array<ArrayBuffer>[]).arrayBuffer();
}

async function readValues(
  client: Client,
  result: string,
  attribute: string,
  from: number,
  count: number,
  signal: AbortSignal,
): Promise<AttributeValue[]> {
  const values: AttributeValue[] = [];
  while (values.length < count) {
    const { rows } = await client.rows(
      result,
      from + values.length,
      Math.min(10_000, count - values.length),
      signal,
    );
    if (rows.length === 0) throw new Error(`The server sent no row ${from + values.length}.`);
    for (const row of rows) values.push(attributeValue(row[attribute] ?? null));
  }
  return values;
}

function attributeValue(value: Json): AttributeValue {
  return typeof value === "object" && value !== null ? JSON.stringify(value) : value;
}
