import { expect, test } from "vitest";

import type { Answer, Database } from "../../../src/scene";
import { kMostBoxes, levelsOf, nodeBoxes } from "../../../src/scene_panels/index_boxes";

/** A database whose tree has `count` nodes on each level; notes what was asked. */
function database(count: number): { database: Database; asked: string[]; dropped: string[] } {
  const asked: string[] = [];
  const dropped: string[] = [];
  const made: Pick<Database, "query" | "rows" | "drop"> = {
    query(statement): Promise<Answer> {
      asked.push(statement);
      if (statement.endsWith("max[Level]"))
        return Promise.resolve({ type: "int", value: 3, diagnostics: [], result: null });
      const columns = [{ name: "Box", type: "rect3", shape: true }];
      return Promise.resolve({
        type: "rel",
        value: [],
        diagnostics: [],
        result: { id: "r1", count, columns },
      });
    },
    rows(_result, from, most) {
      const rows = Array.from({ length: Math.min(most, count - from) }, (_, i) => ({
        Members: 2,
        Box: [from + i, from + i + 1, 0, 1, 0, 1],
      }));
      return Promise.resolve(rows);
    },
    drop: (result) => dropped.push(result),
  };
  return { database: made as unknown as Database, asked, dropped };
}

const { signal } = new AbortController();

test("the levels are counted from the root", async () => {
  const { database: tree, asked } = database(1);
  expect(await levelsOf(tree, "Parts_Solid", signal)).toBe(4);
  expect(asked).toEqual(["query Parts_Solid nodes max[Level]"]);
});

test("all boxes of a level are read, and the result is dropped", async () => {
  const { database: tree, dropped } = database(12_345);
  const { boxes, count, members } = await nodeBoxes(tree, "Parts_Solid", 2, signal);
  expect(boxes.length).toBe(12_345);
  expect(boxes[12_344]).toEqual([12_344, 12_345, 0, 1, 0, 1]);
  expect([count, members]).toEqual([12_345, 24_690]);
  expect(dropped).toEqual(["r1"]);
});

test("more boxes than can be seen are not read", async () => {
  const { boxes, count, members } = await nodeBoxes(database(50_000).database, "Parts_Solid", 3, signal);
  expect(boxes.length).toBe(kMostBoxes);
  expect([count, members]).toEqual([50_000, null]);
});
