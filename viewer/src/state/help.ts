/** The command `help`, which the viewer answers itself: the server describes operators under addresses of their own. */

import { ApiError } from "../api/errors";
import type { OperatorInfo } from "../api/types";
import type { Catalogue } from "./catalogue";

/** What `help` is asked for: a name, or "" for everything; null if the statement is another command. */
export function helpSubject(statement: string): string | null {
  const match = /^\s*help(?:\s+(\S.*?))?\s*;?\s*$/.exec(statement);
  return match ? (match[1] ?? "") : null;
}

/** The text of an answer to `help`. Rejects as Client does. */
export async function helpText(subject: string, catalogue: Catalogue): Promise<string> {
  if (subject === "") return overview(catalogue);
  if (/\s/.test(subject)) throw unknown(subject);
  const operator = catalogue.operators.value.find(({ name }) => name === subject);
  if (operator) return (await catalogue.help(subject)).help;
  const wanted = subject.toLowerCase();
  const isFound = ({ name, doc }: OperatorInfo) => `${name} ${doc}`.toLowerCase().includes(wanted);
  const found = catalogue.operators.value.filter(isFound);
  const isCommand = catalogue.keywords.value.includes(subject);
  if (found.length === 0 && !isCommand) throw unknown(subject);
  return [
    isCommand
      ? `${subject} is a word of the language; docs/language.md describes the commands.`
      : `There is no operator of the name ${subject}.`,
    ...(found.length > 0 ? ["", `Operators with “${subject}” in their name or description`] : []),
    ...found.map(line),
  ].join("\n");
}

function overview({ operators, keywords }: Catalogue): string {
  const families = [...new Set(operators.value.map(({ family }) => family))];
  return [
    "help NAME describes an operator, help WORD finds operators.",
    "",
    "Words of commands and expressions",
    `  ${[...keywords.value].sort().join(" ")}`,
    ...families.flatMap((family) => [
      "",
      `Operators: ${family}`,
      ...operators.value.filter((operator) => operator.family === family).map(line),
    ]),
  ].join("\n");
}

function line({ syntax, doc }: OperatorInfo): string {
  return `  ${syntax.padEnd(36)} ${doc}`;
}

function unknown(subject: string): ApiError {
  return new ApiError(404, {
    code: "unknown_name",
    message: `no operator has ${subject} in its name or description`,
    remedy: "`help` lists all operators.",
  });
}
