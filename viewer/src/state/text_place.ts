import type { Failure } from "./runner";

/**
 * The offset, in UTF-16 units, of a place in a text: line and column count from 1, columns in characters (code
 * points), lines end at `\n`. Places beyond the end of a line or of the text are taken to its end.
 */
export function offsetOf(text: string, line: number, column: number): number {
  let begin = 0;
  for (let passed = 1; passed < line; passed++) {
    const end = text.indexOf("\n", begin);
    if (end < 0) return text.length;
    begin = end + 1;
  }
  const newline = text.indexOf("\n", begin);
  const end = newline < 0 ? text.length : newline;
  let offset = begin;
  for (let passed = 1; passed < column && offset < end; passed++)
    offset += (text.codePointAt(offset) ?? 0) > 0xffff ? 2 : 1;
  return offset;
}

/** The word at the place of a failure, as a range of the text that was sent; the whole text if it has no place. */
export function failureRange(text: string, place: Failure["place"]): { from: number; to: number } {
  if (!place) return { from: 0, to: text.trimEnd().length };
  const from = offsetOf(text, place.line, place.column);
  const word = /^(\w+|[^\w\s]+)/.exec(text.slice(from));
  if (word) return { from, to: from + word[0].length };
  return { from: Math.max(0, from - 1), to: from };
}
