import { expect, test } from "vitest";

import type { DatabaseObject, OperatorInfo } from "../../../src/api/types";
import { isHarmless } from "../../../src/state/link_consent";

const object = (name: string, type: string, kind: DatabaseObject["kind"]): DatabaseObject => ({
  name,
  type,
  kind,
  shape: false,
  hasValue: true,
});
const operator = (name: string, changes: boolean): OperatorInfo => ({
  name,
  changes,
  family: "",
  syntax: "",
  doc: "",
  signatures: [],
});

const run = [
  "query R feed count",
  "query R feed filter[.A > $x] count",
  "query R feed R deletedirect count",
  "query S exportSTL[\"s\", 'new.stl', TRUE]",
  "query f(3)",
  "delete R",
];
const known = {
  objects: [
    object("R", "(rel (tuple ((A int))))", "relation"),
    object("S", "volume3d", "value"),
    object("f", "(map int int)", "function"),
  ],
  operators: [operator("deletedirect", true), operator("exportSTL", true), operator("count", false)],
  knows: (text: string) => run.includes(text),
};
const consent = (text: string, parameters = {}) => isHarmless({ text, shown: [], parameters }, known);

test("an object, and a query that was run here, are shown at once", () => {
  expect(consent("query S")).toBe(true);
  expect(consent("query R feed count")).toBe(true);
  expect(consent("query R feed filter[.A > $x] count", { x: [0, 1, "A"] })).toBe(true);
});

test("what was never run here waits for consent", () => {
  expect(consent("query R feed tail[1] count")).toBe(false);
  expect(consent("query T")).toBe(false);
});

test.each(run.slice(2))("%s changes something, or may, and waits, though it was run here", (text) => {
  expect(consent(text)).toBe(false);
});

test("values that come with a link wait for consent", () => {
  expect(consent("query R feed filter[.A > $x] count", { x: { type: "int", value: 3 } })).toBe(false);
});
