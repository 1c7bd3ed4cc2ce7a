/** Which statements of a link may run before a person has agreed to them. */

import type { DatabaseObject, OperatorInfo } from "../api/types";
import { isQuery } from "./outcome";
import type { LinkStatement } from "./permalink";

/** What is known of the database and of what was run in this browser. */
export interface Known {
  readonly objects: readonly DatabaseObject[];
  readonly operators: readonly OperatorInfo[];
  /** Whether a statement was run here before. */
  readonly knows: (text: string) => boolean;
}

/**
 * Whether a statement only shows an object, or is a query that was run here before and changes nothing: it names no operator that does,
 * and no function of the database, which may. Values for its parameters that come with the link were never seen here.
 */
export function isHarmless({ text, parameters }: LinkStatement, known: Known): boolean {
  const name = /^\s*query\s+`?(\w+)`?\s*$/.exec(text)?.[1];
  if (name && known.objects.some((object) => object.name === name)) return true;
  if (Object.values(parameters ?? {}).some((value) => !Array.isArray(value))) return false;
  return isQuery(text) && known.knows(text) && !changesSomething(text, known);
}

function changesSomething(text: string, { objects, operators }: Known): boolean {
  const words = new Set(text.match(/\w+/g));
  return (
    operators.some(({ name, changes }) => changes && words.has(name)) ||
    objects.some(({ name, kind }) => kind === "function" && words.has(name))
  );
}
