import { expect, test } from "vitest";
import { failureRange, offsetOf } from "../../../src/state/text_place";

test.each([
  ["query Part", 1, 7, 6],
  ["query\nPart", 2, 1, 6],
  ["query\nPart", 2, 99, 10],
  ["query\nPart", 9, 1, 10],
  ['"𝄞" + x', 1, 7, 7],
])("%j line %i column %i is offset %i", (text, line, column, offset) => {
  expect(offsetOf(text, line, column)).toBe(offset);
});

test("the word at the place is marked", () => {
  expect(failureRange("query Part feed", { line: 1, column: 7 })).toEqual({ from: 6, to: 10 });
  expect(failureRange("query 1 +* 2", { line: 1, column: 9 })).toEqual({ from: 8, to: 10 });
});

test("a place at the end marks the last character, and no place all of it", () => {
  expect(failureRange("query (1", { line: 1, column: 9 })).toEqual({ from: 7, to: 8 });
  expect(failureRange("query x \n", null)).toEqual({ from: 0, to: 7 });
});
