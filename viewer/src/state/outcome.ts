import { signal, type Signal } from "@preact/signals";
import type { Client } from "../api/client";
import type { Column, Json, Parameter, QueryAnswer, Row } from "../api/types";
import { RowCache } from "./row_cache";
import { attributesOf, isRelation } from "./types";

export type Parameters = Readonly<Record<string, Parameter>>;

/** The table of an outcome: a relation, or a single value as one row with the column `value`. */
export interface Table {
  readonly columns: readonly Column[];
  readonly rows: RowCache;
  /** False if it is a single value. */
  readonly isRelation: boolean;
}

/** What a statement brought. */
export interface Outcome {
  /** Counts up; the place among all outcomes of this page. */
  readonly key: number;
  readonly statement: string;
  readonly parameters: Parameters;
  readonly answer: QueryAnswer;
  /** Of the result on the server; null if there is nothing more to ask for. */
  readonly resultId: string | null;
  /** null for commands without a value. */
  readonly table: Table | null;
  /** A description in place of a table. */
  readonly text: string | null;
  /** The columns that can be drawn. */
  readonly shapeColumns: readonly string[];
  /** Those of them that are shown in 3D. */
  readonly shown: Signal<ReadonlySet<string>>;
  /** It was shown by the page itself, and gives way to the first result of a person. */
  readonly isPreview: boolean;
}

let lastKey = 0;

export function makeOutcome(
  client: Client,
  statement: string,
  parameters: Parameters,
  answer: QueryAnswer,
  isPreview = false,
): Outcome {
  const table = tableOf(client, answer);
  const shapeColumns = answer.result
    ? answer.result.columns.filter((column) => column.shape).map((column) => column.name)
    : [];
  return {
    key: ++lastKey,
    statement,
    parameters,
    answer,
    resultId: answer.result?.id ?? null,
    table,
    text: null,
    shapeColumns,
    shown: signal<ReadonlySet<string>>(new Set(shapeColumns)),
    isPreview,
  };
}

/** What `help` brought. */
export function makeDescription(statement: string, text: string): Outcome {
  return {
    key: ++lastKey,
    statement,
    parameters: {},
    answer: { type: null, value: null, diagnostics: [], seconds: 0 },
    resultId: null,
    table: null,
    text,
    shapeColumns: [],
    shown: signal<ReadonlySet<string>>(new Set()),
    isPreview: false,
  };
}

function tableOf(client: Client, answer: QueryAnswer): Table | null {
  if (answer.type === null) return null;
  // Inquiries such as `list objects` are tables without a type of their own.
  const inquiry = answer.type === "inquiry";
  // A nested relation is a single value, too: a cell that opens in place.
  const nested = answer.type.startsWith("(arel ");
  const relation = (inquiry || (isRelation(answer.type) && !nested)) && Array.isArray(answer.value);
  const first = relation ? (answer.value as readonly Row[]) : [{ value: answer.value }];
  const { result } = answer;
  if (!result) {
    const columns = relation
      ? (attributesOf(answer.type) ?? namesIn(first)).map((attribute) => ({ ...attribute, shape: false }))
      : [{ name: "value", type: answer.type, shape: false }];
    return { columns, rows: new RowCache(first.length, first, null), isRelation: relation };
  }
  const read = (from: number, count: number, abort: AbortSignal) =>
    client.rows(result.id, from, count, abort);
  return { columns: result.columns, rows: new RowCache(result.count, first, read), isRelation: relation };
}

/** The columns of rows whose type is not known. */
function namesIn(rows: readonly Row[]): readonly { name: string; type: string }[] {
  return [...new Set(rows.flatMap((row) => Object.keys(row)))].map((name) => ({ name, type: "" }));
}

/** A short name for tabs: the name of the object of a plain `query Name`, else the beginning of the statement. */
export function titleOf(statement: string): string {
  const line = statement
    .replace(/^\s*#.*$/gm, "")
    .replace(/\s+/g, " ")
    .trim();
  const object = /^query `?([A-Za-z]\w*)`?$/.exec(line);
  if (object?.[1]) return object[1];
  const text = line.replace(/^query /, "");
  return text.length > 40 ? `${text.slice(0, 39)}…` : text;
}

/** Whether a statement only asks: queries that store nothing by their form. Operators such as `insert` are not seen. */
export function isQuery(statement: string): boolean {
  return /^\s*(#.*\n\s*)*\(?\s*query\b/.test(statement);
}

/** The value of a cell that is geometry, as the table shows it; null for every other value. */
export function summaryOf(
  value: Json,
): { type: string; count: string; box: readonly number[] | null } | null {
  if (value === null || typeof value !== "object" || Array.isArray(value)) return null;
  const fields = value as Readonly<Record<string, Json>>;
  if (typeof fields["type"] !== "string") return null;
  const counts = Object.entries(fields).filter(([, amount]) => typeof amount === "number") as [
    string,
    number,
  ][];
  const count = counts
    .map(([name, amount]) => `${amount.toLocaleString("en")} ${singular(name, amount)}`)
    .join(", ");
  const box = fields["box"];
  return { type: fields["type"], count, box: Array.isArray(box) ? (box as readonly number[]) : null };
}

function singular(name: string, amount: number): string {
  if (amount !== 1) return name;
  if (name === "vertices") return "vertex";
  return name.replace(/s$/, "");
}
