/** A name with the blanks that it needs between two characters of a text, each "" at an end of the text. */
export function wordBetween(before: string, name: string, after: string): string {
  const begin = /[\w)\]"']/.test(before) ? " " : "";
  const end = /[\w$"']/.test(after) ? " " : "";
  return `${begin}${name}${end}`;
}
