import { expect, test } from "vitest";
import { attributesOf, describeType, isRelation, parseList, writeList } from "../../../src/state/types";

const parts = "(rel (tuple ((Name string) (Solid volume3d))))";

test("nested lists are read and written", () => {
  const list = parseList(parts);
  expect(list).toEqual(["rel", ["tuple", [["Name", "string"], ["Solid", "volume3d"]]]]); // prettier-ignore
  expect(list && writeList(list)).toBe(parts);
});

test.each(["", "(a", "a)", "(a) b", ")("])("%j is no nested list", (text) => {
  expect(parseList(text)).toBeNull();
});

test("attributes of relations, streams and tuples", () => {
  const attributes = [
    { name: "Name", type: "string" },
    { name: "Solid", type: "volume3d" },
  ];
  expect(attributesOf(parts)).toEqual(attributes);
  expect(attributesOf("(tuple ((Name string) (Solid volume3d)))")).toEqual(attributes);
  expect(attributesOf("(vector int)")).toBeNull();
  expect(attributesOf("int")).toBeNull();
  expect(attributesOf(null)).toBeNull();
});

test("types for people", () => {
  expect(isRelation(parts)).toBe(true);
  expect(isRelation("(tuple ((Name string)))")).toBe(false);
  expect(describeType(parts)).toBe("relation of Name: string, Solid: volume3d");
  expect(describeType("(vector int)")).toBe("(vector int)");
});
