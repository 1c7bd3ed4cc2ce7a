import { expect, test } from "vitest";
import { wordBetween } from "../../../src/app/editor/word_between";
import { plainPieces } from "../../../src/app/ui/plain_text";

const shown = (text: string, lines = false) =>
  plainPieces(text, lines).map(({ text: piece, isSign }) => (isSign ? `[${piece}]` : piece));

test("ordinary text stays whole, in any script", () => {
  for (const text of ["", "two  blanks ", "größe", "سلام", "👩‍🚀", "नमस्ते"]) expect(shown(text)).toEqual([text]);
});

test("characters that turn or hide what is beside them are shown by their numbers", () => {
  expect(shown("a\u202Eb")).toEqual(["a", "[U+202E]", "b"]);
  expect(shown("\u2066\u200B\u0000x")).toEqual(["[U+2066]", "[U+200B]", "[U+0000]", "x"]);
  expect(shown("\uD800")).toEqual(["[U+D800]"]);
});

test("line ends and tabs are signs where there is one line", () => {
  expect(shown("a\n\tb")).toEqual(["a", "[↵]", "[⇥]", "b"]);
  expect(shown("a\n\tb", true)).toEqual(["a\n\tb"]);
});

test("a name that is put into a text stands apart from words beside it", () => {
  expect(wordBetween("", "Cube", "")).toBe("Cube");
  expect(wordBetween("y", "Cube", "")).toBe(" Cube");
  expect(wordBetween(")", "Cube", "u")).toBe(" Cube ");
  expect(wordBetween("(", "Cube", ")")).toBe("Cube");
  expect(wordBetween(" ", "Cube", ";")).toBe("Cube");
});
