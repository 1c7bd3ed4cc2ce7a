import { expect, test } from "vitest";

import type { DatabaseObject } from "../../../src/api/types";
import { examplesOf, largestRelation, sheetStatement } from "../../../src/state/first_page";

const relation = (name: string, count: number, shape = true): DatabaseObject => ({
  name,
  type: "(rel (tuple ((Name string) (Solid volume3d))))",
  kind: "relation",
  count,
  shape,
  hasValue: true,
});

test("the largest relation with geometry is shown, and of a large one its beginning", () => {
  const objects = [
    relation("Few", 3),
    relation("Texts", 9000, false),
    relation("Parts", 279),
    relation("None", 0),
  ];
  expect(largestRelation(objects)?.name).toBe("Parts");
  expect(sheetStatement(relation("Parts", 279))).toBe("query Parts");
  expect(sheetStatement(relation("Many", 5000))).toBe("query Many feed head[1000] consume");
  expect(largestRelation([relation("Texts", 9000, false)])).toBeNull();
});

test("there are three examples, of what is in the database, or for an empty one", () => {
  expect(
    examplesOf([relation("Parts", 279)], false).every(({ statement }) => statement.includes("Parts")),
  ).toBe(true);
  expect(examplesOf([], false)[0]?.statement).toMatch(/^let Sample/);
  expect(examplesOf([], true).every(({ statement }) => statement.startsWith("query"))).toBe(true);
  for (const objects of [[relation("Parts", 2)], []]) expect(examplesOf(objects, false)).toHaveLength(3);
});
