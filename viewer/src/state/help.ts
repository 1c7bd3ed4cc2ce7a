/** The command `help`, which the viewer answers itself: the server describes operators under addresses of their own. */

import { ApiError } from "../api/errors";
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
  const commands = catalogue.commands.value
    .filter(({ syntax }) => syntax.split(" ")[0] === subject)
    .map(line);
  if (catalogue.operators.value.some(({ name }) => name === subject))
    return [...commands, ...(commands.length > 0 ? [""] : []), (await catalogue.help(subject)).help].join(
      "\n",
    );
  return commands.length > 0 ? commands.join("\n") : found(subject, catalogue);
}

/** The operators and commands with a word in their names or descriptions. */
function found(subject: string, { operators, commands }: Catalogue): string {
  const wanted = subject.toLowerCase();
  const having = (texts: readonly Described[]) =>
    texts.filter((text) => `${text.name ?? ""} ${text.syntax} ${text.doc}`.toLowerCase().includes(wanted));
  const groups = [
    {
      title: `Operators with “${subject}” in their name or description`,
      lines: having(operators.value).map(line),
    },
    { title: `Commands with “${subject}”`, lines: having(commands.value).map(line) },
  ].filter(({ lines }) => lines.length > 0);
  if (groups.length === 0) throw unknown(subject);
  return groups.map(({ title, lines }) => [title, ...lines].join("\n")).join("\n\n");
}

function overview({ operators, commands }: Catalogue): string {
  const families = [...new Set(operators.value.map(({ family }) => family))];
  return [
    "help NAME describes an operator or a command, help WORD finds them.",
    "",
    "Commands",
    ...commands.value.map(line),
    ...families.flatMap((family) => [
      "",
      `Operators: ${family}`,
      ...operators.value.filter((operator) => operator.family === family).map(line),
    ]),
  ].join("\n");
}

interface Described {
  readonly name?: string;
  readonly syntax: string;
  readonly doc: string;
}

function line({ syntax, doc }: Described): string {
  return `  ${syntax.padEnd(36)} ${doc}`;
}

function unknown(subject: string): ApiError {
  return new ApiError(404, {
    code: "unknown_name",
    message: `no operator or command has ${subject} in its name or description`,
    remedy: "`help` lists all of them.",
  });
}
