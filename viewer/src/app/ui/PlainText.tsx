import { plainPieces } from "./plain_text";

interface Props {
  readonly text: string;
  /** Lines are kept apart; else their ends are shown as signs, so that all stands in one line. */
  readonly lines?: boolean;
}

/**
 * A text of the database as it is: every blank counts, and characters that would move, hide or turn what stands beside
 * them are shown by their numbers.
 */
export function PlainText({ text, lines = false }: Props) {
  return (
    <bdi class="plain-text">
      {plainPieces(text, lines).map(({ text: piece, isSign, title }, index) =>
        isSign ? (
          <span key={index} class="sign" title={title}>
            {piece}
          </span>
        ) : (
          piece
        ),
      )}
    </bdi>
  );
}
