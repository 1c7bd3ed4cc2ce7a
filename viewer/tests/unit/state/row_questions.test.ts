import { expect, test } from "vitest";

import { Client } from "../../../src/api/client";
import { makeOutcome } from "../../../src/state/outcome";
import { measuresOf, questionsAbout } from "../../../src/state/row_questions";

function outcome(statement: string, names: readonly string[] = ["Name", "Solid"]) {
  const columns = names.map((name) => {
    const isSolid = name === "Solid";
    return { name, type: isSolid ? "volume3d" : "string", shape: isSolid };
  });
  const type = `(rel (tuple (${columns.map(({ name, type: of }) => `(${name} ${of})`).join(" ")})))`;
  const result = { id: "r1", count: 1, columns };
  const value = [{ Name: "a" }];
  return makeOutcome(new Client(), statement, {}, { type, value, diagnostics: [], seconds: 0, result });
}

const cell = { result: "r1", row: 0, column: "Solid" };
const touching = (statement: string) => questionsAbout(outcome(statement), cell)[0]?.statement;

test("questions take the rows of the statement as they are", () => {
  expect(touching("query Parts;")).toBe("query Parts feed filter[.Solid touches $object] consume");
  expect(touching("query Parts feed head[3] consume")).toBe(
    "query (Parts feed head[3] consume) feed filter[.Solid touches $object] consume",
  );
});

test("statements that are no queries, or have comments, are not asked again", () => {
  expect(touching("let A = Parts")).toBeUndefined();
  expect(touching("query Parts # all of them")).toBeUndefined();
});

test("a measure is a further column, by another name if its own is taken", () => {
  expect(measuresOf(outcome("query Parts"), "Solid").at(-1)).toMatchObject({
    statement: "query Parts feed extend[Thickness: thickness(.Solid)] sortby[Thickness] consume",
    column: "Thickness",
  });
  const measured = outcome("query Parts", ["Thickness", "Solid"]);
  expect(measuresOf(measured, "Solid").at(-1)?.column).toBe("Thickness2");
  expect(measuresOf(measured, "Thickness")).toEqual([]);
});
