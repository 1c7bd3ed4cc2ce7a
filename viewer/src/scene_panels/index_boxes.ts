/** The nodes of an R-tree, asked of the database. */

import type { Box, Database } from "../scene";

/** More boxes cannot be distinguished in a picture. */
export const kMostBoxes = 20_000;
const kRowsPerRequest = 10_000;

/** The boxes of the nodes of one level. */
export interface NodeBoxes {
  readonly boxes: readonly Box[];
  /** Number of nodes, also where fewer boxes were read. */
  readonly count: number;
  /** Number of children of all of them, or of entries; null if not all nodes were read. */
  readonly members: number | null;
}

/** The number of levels; 0 of an empty tree. */
export async function levelsOf(database: Database, index: string, signal: AbortSignal): Promise<number> {
  const { value } = await database.query(`query ${index} nodes max[Level]`, {}, signal);
  return typeof value === "number" ? value + 1 : 0;
}

export async function nodeBoxes(
  database: Database,
  index: string,
  level: number,
  signal: AbortSignal,
): Promise<NodeBoxes> {
  const statement = `query ${index} nodes filter[.Level = $level] project[Members, Box] consume`;
  const answer = await database.query(statement, { level: { type: "int", value: level } }, signal);
  const { result } = answer;
  if (!result) return { boxes: [], count: 0, members: 0 };
  try {
    const rows: Row[] = [];
    while (rows.length < Math.min(result.count, kMostBoxes)) {
      const part = await database.rows(result.id, rows.length, kRowsPerRequest, signal);
      if (part.length === 0) break;
      rows.push(...(part as unknown as Row[]));
    }
    const members = rows.reduce((sum, row) => sum + row.Members, 0);
    const boxes = rows.slice(0, kMostBoxes).map(({ Box }) => Box);
    return { boxes, count: result.count, members: boxes.length < result.count ? null : members };
  } finally {
    database.drop(result.id);
  }
}

interface Row {
  readonly Members: number;
  readonly Box: Box;
}
