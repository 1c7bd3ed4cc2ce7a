import { CompletionContext } from "@codemirror/autocomplete";
import { EditorState } from "@codemirror/state";
import { expect, test } from "vitest";
import type { DatabaseObject } from "../../../src/api/types";
import { attributesIn, complete, type Known, readableSyntax } from "../../../src/app/editor/completion";

const parts: DatabaseObject = {
  name: "Parts",
  type: "(rel (tuple ((Name string) (Solid volume3d))))",
  kind: "relation",
  shape: true,
  hasValue: true,
};
const known: Known = {
  keywords: ["query", "let"],
  operators: [
    {
      name: "volume",
      family: "measures",
      syntax: "volume(_)",
      doc: "Volume.",
      signatures: [],
      changes: false,
    },
  ],
  types: [{ name: "volume3d", doc: "A solid." }],
  objects: [parts],
  columns: [{ name: "Price", type: "real", shape: false }],
};

function labels(text: string, explicit = false): string[] | null {
  const state = EditorState.create({ doc: text });
  return (
    complete(new CompletionContext(state, text.length, explicit), known)?.options.map(({ label }) => label) ??
    null
  );
}

test("after a dot only attributes: those of relations in the statement first, then columns of the result", () => {
  expect(labels("query Parts feed filter[.")).toEqual(["Name", "Solid", "Price"]);
  expect(labels("query Prices feed filter[.")).toEqual(["Price"]);
});

test("the endings of {a} and new attributes are known", () => {
  const attributes = attributesIn("Parts feed {a} Parts feed {b} extend[Sum: .X]", known).map(
    ({ name }) => name,
  );
  expect(attributes).toEqual(["Name_a", "Name_b", "Solid_a", "Solid_b", "Sum", "Price"]);
});

test("words are objects, operators, commands and types", () => {
  expect(labels("query vol")).toEqual(["Parts", "volume", "query", "let", "volume3d"]);
});

test("nothing is completed within literals and numbers, or without a reason", () => {
  expect(labels("query 'importSTL vol")).toBeNull();
  expect(labels('query "a" + "b vol')).toBeNull();
  expect(labels('query "a\\" vol')).toBeNull();
  expect(labels("query 1.")).toBeNull();
  expect(labels("query ")).toBeNull();
  expect(labels("query ", true)).not.toBeNull();
});

test("an open literal in an earlier statement does not matter", () => {
  expect(labels("query 'x;\n\nquery vol")).not.toBeNull();
});

test("arguments that are expressions are called so", () => {
  expect(readableSyntax("_ filter[fun(STREAMELEM)]")).toBe("_ filter[expression of .Attributes]");
});
