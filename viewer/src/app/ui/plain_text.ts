export interface Piece {
  readonly text: string;
  /** A sign in place of a character that cannot be seen. */
  readonly isSign: boolean;
  readonly title?: string;
}

/**
 * Controls; formats such as U+202E, which turns the direction of a line; separators of lines and paragraphs; lone
 * surrogates.
 */
const invisible = /[\p{Cc}\p{Cf}\p{Zl}\p{Zp}\p{Cs}]/u;

/** Divides a text into what is shown as it is and signs; `lines`: line ends and tabs are shown as they are. */
export function plainPieces(text: string, lines: boolean): readonly Piece[] {
  if (!invisible.test(text)) return [{ text, isSign: false }];
  const pieces: Piece[] = [];
  let plain = "";
  for (const character of text) {
    const sign = isPlain(character, lines) ? null : signOf(character);
    if (sign === null) {
      plain += character;
      continue;
    }
    if (plain) pieces.push({ text: plain, isSign: false });
    plain = "";
    pieces.push(sign);
  }
  if (plain) pieces.push({ text: plain, isSign: false });
  return pieces;
}

/** Joiners are parts of letters in many scripts, and of emoji. */
function isPlain(character: string, lines: boolean): boolean {
  if (character === "\u200d" || character === "\u200c") return true;
  return lines && (character === "\n" || character === "\t") ? true : !invisible.test(character);
}

function signOf(character: string): Piece {
  const number = `U+${(character.codePointAt(0) ?? 0).toString(16).toUpperCase().padStart(4, "0")}`;
  if (character === "\n") return { text: "↵", isSign: true, title: "End of a line" };
  if (character === "\t") return { text: "⇥", isSign: true, title: "Tab" };
  return { text: number, isSign: true, title: `The character ${number}, which cannot be seen` };
}
