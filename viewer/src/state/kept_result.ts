/** Results that a page of before has left on the server: enough of their answers that they can be shown again. */

import type { Client } from "../api/client";
import { isGone } from "../api/errors";
import type { Column, Json } from "../api/types";
import { makeOutcome, type Outcome, type Parameters } from "./outcome";

/** Rows that come with an answer. */
export const firstRows = 200;

export interface KeptResult {
  readonly id: string;
  readonly type: string;
  readonly count: number;
  readonly columns: readonly Column[];
  readonly diagnostics: readonly string[];
  readonly seconds: number;
  readonly isPreview?: boolean;
}

/** null of an outcome that has nothing on the server. */
export function keptOf({ answer, isPreview }: Outcome): KeptResult | null {
  const { type, result, diagnostics, seconds } = answer;
  if (!result || type === null) return null;
  const { id, count, columns } = result;
  return { id, type, count, columns, diagnostics, seconds, ...(isPreview ? { isPreview } : {}) };
}

/** The outcome of a statement that was run before; null if the server no longer has its result. Rejects as Client does. */
export async function takeUp(
  client: Client,
  statement: string,
  parameters: Parameters,
  { id, count, columns, isPreview, ...answer }: KeptResult,
): Promise<Outcome | null> {
  let rows;
  try {
    ({ rows } = await client.rows(id, 0, firstRows));
  } catch (error) {
    if (isGone(error)) return null;
    throw error;
  }
  const isSingle = columns.length === 1 && columns[0]?.name === "value";
  const value: Json = isSingle ? (rows[0]?.["value"] ?? null) : rows;
  const whole = { ...answer, value, result: { id, count, columns } };
  return makeOutcome(client, statement, parameters, whole, isPreview);
}

export function isKept(value: unknown): value is KeptResult {
  if (typeof value !== "object" || value === null) return false;
  const { id, type, count, columns, diagnostics } = value as Partial<KeptResult>;
  return (
    typeof id === "string" &&
    /^r\d+$/.test(id) &&
    typeof type === "string" &&
    Number.isSafeInteger(count) &&
    Array.isArray(diagnostics) &&
    Array.isArray(columns) &&
    columns.every(
      (column: Partial<Column> | null) =>
        typeof column?.name === "string" &&
        typeof column.type === "string" &&
        typeof column.shape === "boolean",
    )
  );
}
