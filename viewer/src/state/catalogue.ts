import { batch, signal } from "@preact/signals";
import type { Client } from "../api/client";
import type {
  CommandInfo,
  DatabaseObject,
  MeshFormat,
  OperatorHelp,
  OperatorInfo,
  TypeInfo,
} from "../api/types";

/** What the database and the program have: objects, operators, types, commands and their words, formats of files. */
export class Catalogue {
  readonly objects = signal<readonly DatabaseObject[]>([]);
  readonly operators = signal<readonly OperatorInfo[]>([]);
  readonly types = signal<readonly TypeInfo[]>([]);
  readonly commands = signal<readonly CommandInfo[]>([]);
  readonly keywords = signal<readonly string[]>([]);
  readonly formats = signal<readonly MeshFormat[]>([]);
  readonly #client: Client;
  /** How often the objects were asked for. */
  #readings = 0;
  readonly #help = new Map<string, Promise<OperatorHelp>>();

  constructor(client: Client) {
    this.#client = client;
  }

  /** Reads everything; what the language has changes only with the program. */
  async load(): Promise<void> {
    const reading = ++this.#readings;
    const [objects, operators, types, commands, keywords, formats] = await Promise.all([
      this.#client.objects(),
      this.#client.operators(),
      this.#client.types(),
      this.#client.commands(),
      this.#client.keywords(),
      this.#client.formats(),
    ]);
    batch(() => {
      if (reading === this.#readings) this.objects.value = objects;
      this.operators.value = operators;
      this.types.value = types;
      this.commands.value = commands;
      this.keywords.value = keywords;
      this.formats.value = formats;
    });
  }

  /** Reads the objects again; an answer that a later request has overtaken is left out. */
  async reloadObjects(): Promise<void> {
    const reading = ++this.#readings;
    const objects = await this.#client.objects();
    if (reading === this.#readings && JSON.stringify(objects) !== JSON.stringify(this.objects.value))
      this.objects.value = objects;
  }

  /** The whole description of an operator; asked for once. */
  help(name: string): Promise<OperatorHelp> {
    let help = this.#help.get(name);
    if (!help) {
      help = this.#client.operator(name);
      this.#help.set(name, help);
      help.catch(() => this.#help.delete(name));
    }
    return help;
  }
}

/** The operators with all words of `pattern` in name, family or description; those whose name begins with it first. */
export function searchOperators(
  operators: readonly OperatorInfo[],
  pattern: string,
): readonly OperatorInfo[] {
  const wanted = pattern.trim().toLowerCase();
  if (!wanted) return operators;
  const words = wanted.split(/\s+/);
  const rank = ({ name }: OperatorInfo) => {
    const lower = name.toLowerCase();
    if (lower === wanted) return 0;
    return lower.startsWith(wanted) ? 1 : lower.includes(wanted) ? 2 : 3;
  };
  return operators
    .filter(({ name, family, doc }) => {
      const text = `${name} ${family} ${doc}`.toLowerCase();
      return words.every((word) => text.includes(word));
    })
    .sort((a, b) => rank(a) - rank(b));
}
