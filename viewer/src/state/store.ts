import { signal } from "@preact/signals";
import type { Client } from "../api/client";
import { keepToken } from "../api/token";
import { Catalogue } from "./catalogue";
import { Connection } from "./connection";
import { largestRelation, sheetStatement } from "./first_page";
import { helpSubject, helpText } from "./help";
import { isMaterialColors } from "./element_colors";
import { History } from "./history";
import { makeLayout, type Layout, type Mode } from "./layout";
import { Notices } from "./notices";
import { makeDescription, makeOutcome, type Outcome, type Parameters } from "./outcome";
import { Results } from "./results";
import { failureOf, isFailure, Runner, type Failure } from "./runner";
import { isString, keptSignal } from "./settings";
import { failureRange } from "./text_place";
import type { Theme } from "./theme";

/** A failure and where it stands in the text of the editor, in UTF-16 units; null if it is not there. */
export interface ShownFailure extends Failure {
  readonly range: { readonly from: number; readonly to: number } | null;
}

export interface RunOptions {
  readonly parameters?: Parameters;
  /** The offset of the statement in the editor, if it stands there. */
  readonly place?: number;
  /** The new object that the statement stores: it fails, and stores nothing, if that would be undefined. */
  readonly stores?: string;
}

/** All state of the page outside the scenes, and what can be done with it. */
export class Store {
  readonly client: Client;
  readonly connection: Connection;
  readonly catalogue: Catalogue;
  readonly results: Results;
  readonly runner: Runner;
  readonly history: History;
  readonly notices = new Notices();
  readonly layout: Layout;
  readonly theme: Theme;
  readonly editorText;
  /** Colours of materials by their names, of the files of materials that were dropped in this tab. */
  readonly materials;
  readonly mode = signal<Mode>("explore");
  /** The latest failure, until the next statement or its closing. */
  readonly failure = signal<ShownFailure | null>(null);
  /** The lists of the catalogue are there. */
  readonly isLoaded = signal(false);
  /** Settled when the lists of the catalogue were read for the first time. */
  readonly loaded: Promise<void>;
  /** The server refused the token. */
  readonly tokenRefused = signal(false);
  /** How many statements have ended, for tests of the page. */
  readonly ended = signal(0);
  readonly #tabStorage: Storage;

  constructor(client: Client, theme: Theme, storage: Storage, tabStorage: Storage) {
    this.client = client;
    this.theme = theme;
    this.connection = new Connection(client);
    client.onAnswer = () => this.connection.answered();
    this.catalogue = new Catalogue(client);
    this.results = new Results(client);
    this.runner = new Runner(client);
    this.history = new History(storage);
    this.layout = makeLayout(storage);
    this.editorText = keptSignal(storage, "editor", "", isString);
    this.materials = keptSignal(tabStorage, "materials", {}, isMaterialColors);
    this.#tabStorage = tabStorage;
    this.loaded = new Promise((resolve) => {
      this.connection.onOnline = () =>
        void this.loadCatalogue().then(() => {
          this.isLoaded.value = true;
          resolve();
        });
    });
  }

  /** Reads what the database and the language have; a failure is a notice. */
  async loadCatalogue(): Promise<void> {
    try {
      await this.catalogue.load();
    } catch (error) {
      this.report(error, "The lists of objects and operators cannot be read");
    }
  }

  /** Reads the objects again, which others may have changed; if that fails, the list stays as it was. */
  async refreshObjects(): Promise<void> {
    if (this.connection.status.value === "online")
      await this.catalogue.reloadObjects().catch(() => undefined);
  }

  async useToken(token: string): Promise<void> {
    this.client.token = token;
    keepToken(token, this.#tabStorage);
    this.tokenRefused.value = false;
    await this.connection.check();
    this.tokenRefused.value = this.connection.status.value === "unauthorized";
  }

  /** Runs a statement and shows its outcome. Returns null if it failed, which is shown. */
  async run(statement: string, options: RunOptions = {}): Promise<Outcome | null> {
    const outcome = await this.#run(statement, options);
    if (!isFailure(outcome)) return outcome;
    this.fail(outcome, options.place ?? null);
    return null;
  }

  /**
   * Runs a statement that stores a new object. Answers with why it failed, for the place where the name was given; ""
   * if it is stored.
   */
  async save(statement: string, options: RunOptions): Promise<string> {
    const outcome = await this.#run(statement, options);
    if (!isFailure(outcome)) return "";
    if (hasNoAnswer(outcome)) void this.connection.check();
    return [sentence(outcome.message), outcome.remedy].filter(Boolean).join(" ");
  }

  async #run(statement: string, options: RunOptions): Promise<Outcome | Failure> {
    try {
      return await this.#runAndShow(statement, options);
    } finally {
      this.ended.value++;
    }
  }

  async #runAndShow(statement: string, options: RunOptions): Promise<Outcome | Failure> {
    this.failure.value = null;
    const outcome = await this.#outcomeOf(statement, options);
    this.history.add(statement, !isFailure(outcome));
    if (isFailure(outcome)) return outcome;
    if (outcome.table || outcome.text !== null) this.#show(outcome);
    else this.notices.add("success", doneText(statement), { detail: outcome.answer.diagnostics.join("\n") });
    await this.refreshObjects();
    return outcome;
  }

  /** Shows the relation with the most geometry, until a person runs something. A failure is not told: nobody has asked. */
  async preview(): Promise<void> {
    const relation = largestRelation(this.catalogue.objects.value);
    if (!relation) return;
    const statement = sheetStatement(relation);
    const answer = await this.runner.answer(statement).catch(() => null);
    if (answer && this.results.list.value.length === 0)
      this.results.add(makeOutcome(this.client, statement, {}, answer, true));
  }

  async #describe(statement: string, subject: string): Promise<Outcome | Failure> {
    try {
      return makeDescription(statement, await helpText(subject, this.catalogue));
    } catch (error) {
      return failureOf(statement, error);
    }
  }

  async #outcomeOf(statement: string, { parameters, stores }: RunOptions): Promise<Outcome | Failure> {
    const subject = helpSubject(statement);
    if (subject !== null) return this.#describe(statement, subject);
    const outcome = await this.runner.run(statement, parameters);
    if (stores === undefined || isFailure(outcome)) return outcome;
    const defined = await this.runner.run(`query isdefined(${stores})`);
    if (isFailure(defined)) return defined;
    if (defined.answer.value === true) return outcome;
    const deleted = await this.runner.run(`delete ${stores}`);
    if (isFailure(deleted)) return deleted;
    const message = outcome.answer.diagnostics.join(" ") || `${stores} would be undefined.`;
    return { statement, message, remedy: "Nothing was stored.", code: "undefined", place: null };
  }

  #show(outcome: Outcome): void {
    this.results.add(outcome);
    // On narrow pages the sheet with the results comes up.
    if (this.layout.sheet.value === "query") this.layout.sheet.value = "results";
  }

  /** Runs the statements of a text one after the other; ends at the first that fails. */
  async runText(text: string, place = 0): Promise<void> {
    let statements;
    try {
      statements = await this.client.split(text);
    } catch (error) {
      this.fail(failureOf(text, error), place);
      return;
    }
    for (const { text: statement, begin } of statements)
      if ((await this.run(statement, { place: place + begin })) === null) return;
  }

  /** Runs the statement of a text in which an offset lies, or the last one before it. */
  async runAt(text: string, offset: number): Promise<void> {
    let statements;
    try {
      statements = await this.client.split(text);
    } catch (error) {
      this.fail(failureOf(text, error), null);
      return;
    }
    const statement = statements.findLast(({ begin }) => begin <= offset) ?? statements[0];
    if (statement) await this.run(statement.text, { place: statement.begin });
  }

  fail(failure: Failure, place: number | null): void {
    if (hasNoAnswer(failure)) void this.connection.check();
    const range = place === null ? null : failureRange(failure.statement, failure.place);
    const shown = range && place !== null ? { from: range.from + place, to: range.to + place } : null;
    this.failure.value = { ...failure, range: shown };
  }

  /** Shows an error as a notice. */
  report(error: unknown, what: string): void {
    const failure = failureOf("", error);
    if (failure.code === "interrupted") return;
    if (failure.code === "no_answer") void this.connection.check();
    const detail = [failure.message, failure.remedy].filter(Boolean).join("\n");
    this.notices.add("error", what, { detail });
  }
}

const sentence = (text: string) => (/[.!?]$/.test(text) ? text : `${text}.`);

/** Whether the server is gone or wants a token. */
function hasNoAnswer({ code }: Failure): boolean {
  return code === "no_answer" || code === "unauthorized";
}

function doneText(statement: string): string {
  const words = statement.trim().split(/\s+/);
  const [command = "", name = ""] = words;
  if (/^(let|let_|derive|create|update)$/.test(command)) return `${name} is stored.`;
  if (/^(delete|kill)$/.test(command)) return `${words.at(-1) ?? ""} is deleted.`;
  return "Done.";
}
