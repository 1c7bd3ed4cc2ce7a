import { signal, type ReadonlySignal, type Signal } from "@preact/signals";
import { isAbort, messageOf } from "../api/errors";
import type { Row } from "../api/types";
import { uploadFile } from "../api/upload";
import { decodeShapes, type Shape } from "../glb/shapes";
import { readMaterialFile } from "./material_file";
import { importerOf, listedFormats, unreadFormat } from "./mesh_formats";
import { meshDifference, type MeshDifference } from "./mesh_difference";
import type { Outcome } from "./outcome";
import { isFailure } from "./runner";
import type { Store } from "./store";

/** What is known about a dropped file. Each part arrives on its own; null until then. */
export interface Review {
  readonly key: number;
  /** The same for files that came together. */
  readonly batch: number;
  readonly isOfMany: boolean;
  readonly fileName: string;
  readonly bytes: number;
  /** Share of the file that was sent, 0 to 1. */
  readonly sent: Signal<number>;
  readonly phase: Signal<"sending" | "reading" | "repairing" | "ready" | "failed">;
  readonly problem: Signal<string>;
  /** The name for statements. */
  readonly path: Signal<string>;
  readonly asIs: Signal<Outcome | null>;
  readonly report: Signal<Outcome | null>;
  readonly repaired: Signal<Outcome | null>;
  /** What the repair took away and added; null for files that need none or are too large to compare. */
  readonly changes: Signal<MeshDifference | null>;
  readonly stop: () => void;
}

/** Triangles of a file up to which its repair is compared with it, in the browser. */
const mostCompared = 300_000;

/** A text as a literal of the query language. */
export function quoted(text: string): string {
  return `'${text.replaceAll("\\", "\\\\").replaceAll("'", "\\'")}'`;
}

/** A name for an object: the file's name without its ending, made of letters, digits and `_`, and not taken. */
export function objectName(fileName: string, taken: readonly string[]): string {
  const base = fileName
    .replace(/\.\w+$/, "")
    .replace(/[^A-Za-z0-9_]+/g, "_")
    .replace(/^[^A-Za-z]+/, "");
  const name = base === "" ? "Part" : base.charAt(0).toUpperCase() + base.slice(1);
  if (!taken.includes(name)) return name;
  for (let number = 2; ; number++) if (!taken.includes(`${name}_${number}`)) return `${name}_${number}`;
}

/** Uploads files and looks at them: as they are, their defects, and repaired. */
export class Uploads {
  /** The newest one first. */
  readonly reviews: ReadonlySignal<readonly Review[]>;
  readonly #reviews = signal<readonly Review[]>([]);
  readonly #store: Store;
  #count = 0;
  #batches = 0;

  constructor(store: Store) {
    this.#store = store;
    this.reviews = this.#reviews;
  }

  /** Takes dropped or chosen files, one after the other; those that came together are shown together. */
  async take(files: readonly File[]): Promise<void> {
    // The formats are known then.
    if (this.#store.connection.status.value === "online") await this.#store.loaded;
    const batch = { batch: ++this.#batches, isOfMany: files.length > 1 };
    for (const file of files) {
      const problem = this.#problemOf(file);
      if (/\.mtl$/i.test(file.name)) await this.#takeMaterials(file);
      else if (problem) this.#refuse(file, batch, problem);
      else if (this.#importerOf(file.name)) await this.#review(file, batch);
      else await this.#uploadOnly(file);
    }
  }

  /** Why a file is not taken; "" if it is. */
  #problemOf({ name, size }: File): string {
    const limit = this.#store.connection.info.value?.uploadLimit ?? Infinity;
    if (size > limit) return `The file has ${size} bytes; the server takes at most ${limit}.`;
    if (size === 0) return "The file is empty.";
    const format = unreadFormat(name);
    if (!format) return "";
    return `${format} is not read. What is: ${listedFormats(this.#store.catalogue.formats.value, "and")}.`;
  }

  #refuse(file: File, batch: Batch, problem: string): void {
    const review = makeReview({ ...batch, key: ++this.#count, file, stop: () => undefined });
    review.phase.value = "failed";
    review.problem.value = problem;
    this.#reviews.value = [review, ...this.#reviews.value];
  }

  /** Stores the repaired solids of files that came together as a relation; why that failed, or "". */
  async storeAll(reviews: readonly Review[], name: string): Promise<string> {
    const refusal = await this.#store.save(`let ${name} = ${this.relationOf(reviews)}`, {});
    if (refusal === "") for (const review of reviews) this.close(review);
    return refusal;
  }

  /** An expression for the relation of the repaired solids with the names of their files. */
  relationOf(reviews: readonly Review[]): string {
    const tuples = reviews.map(({ fileName, path }) => {
      const solid = `${this.#importerOf(fileName) ?? ""}(${quoted(path.value)})`;
      const label = quoted(fileName.replace(/\.\w+$/, ""));
      return `intstream(1, 1) transformstream projectextend[; Name: ${label}, Solid: ${solid}]`;
    });
    return `${tuples.map((tuple, index) => (index === 0 ? tuple : `${tuple} concat`)).join(" ")} consume`;
  }

  close(review: Review): void {
    review.stop();
    this.#reviews.value = this.#reviews.value.filter((other) => other !== review);
  }

  /** Stores the repaired solid as an object; why that failed, as for a file that is gone, or "": then the review ends. */
  async store(review: Review, name: string): Promise<string> {
    const importer = this.#importerOf(review.fileName) ?? "";
    const statement = `let ${name} = ${importer}(${quoted(review.path.value)})`;
    const refusal = await this.#store.save(statement, { stores: name });
    if (refusal === "") this.close(review);
    return refusal;
  }

  #importerOf(fileName: string): string | null {
    return importerOf(this.#store.catalogue.formats.value, fileName);
  }

  /** The colours of materials are kept for the tab; the file is not sent. */
  async #takeMaterials(file: File): Promise<void> {
    const { colors, textures } = readMaterialFile(await file.text());
    const { materials, notices } = this.#store;
    const count = Object.keys(colors).length;
    if (count > 0) materials.value = { ...materials.value, ...colors };
    const text = count === 1 ? "the colour of 1 material" : `the colours of ${count} materials`;
    const detail = textures > 0 ? `Pictures on materials are not shown: ${textures}.` : "";
    notices.add(count > 0 ? "success" : "error", `${file.name} has ${text}.`, { detail });
  }

  async #uploadOnly(file: File): Promise<void> {
    try {
      const { name } = await uploadFile(this.#store.client, file, () => undefined);
      this.#store.notices.add("success", `${file.name} is uploaded.`, {
        detail: `Statements read it as '${name}'.`,
      });
    } catch (error) {
      this.#store.report(error, `${file.name} cannot be uploaded`);
    }
  }

  async #review(file: File, batch: Batch): Promise<void> {
    const abort = new AbortController();
    const review = makeReview({ ...batch, key: ++this.#count, file, stop: () => abort.abort() });
    this.#reviews.value = [review, ...this.#reviews.value];
    try {
      const upload = await uploadFile(
        this.#store.client,
        file,
        (share) => (review.sent.value = share),
        abort.signal,
      );
      review.path.value = upload.name;
      await this.#look(review, abort.signal);
    } catch (error) {
      review.phase.value = "failed";
      review.problem.value = isAbort(error) ? "Stopped." : messageOf(error);
    }
  }

  async #look(review: Review, signal: AbortSignal): Promise<void> {
    const path = quoted(review.path.value);
    const { results } = this.#store;
    review.phase.value = "reading";
    review.asIs.value = await this.#run(`query importMesh(${path})`, signal);
    this.#show(review.asIs.value, this.#isFirstOfBatch(review));
    if (review.asIs.value.answer.value === null)
      throw new Error(review.asIs.value.answer.diagnostics.join("\n") || "The file cannot be read.");
    review.report.value = await this.#run(`query repairReport(${path}) consume`, signal);
    review.phase.value = "repairing";
    const repaired = await this.#run(`query ${this.#importerOf(review.fileName) ?? ""}(${path})`, signal);
    review.repaired.value = repaired;
    // The file as it is stays in the picture; the repaired solid can be laid over it.
    const active = results.activeKey.value;
    this.#show(repaired, false);
    results.show(repaired, false);
    results.activeKey.value = active;
    review.phase.value = "ready";
    await this.#compare(review, signal);
  }

  #isFirstOfBatch({ batch, key }: Review): boolean {
    return !this.#reviews.value.some((other) => other.batch === batch && other.key < key && other.asIs.value);
  }

  /** Shows an outcome, alone or together with what is shown already. */
  #show(outcome: Outcome, isAlone: boolean): void {
    const { results } = this.#store;
    const wasOverlaid = results.overlay.value;
    results.overlay.value ||= !isAlone;
    results.add(outcome);
    results.overlay.value = wasOverlaid;
  }

  /** Finds the triangles that the repair changed. */
  async #compare({ asIs, repaired, report, changes }: Review, signal: AbortSignal): Promise<void> {
    const outcomes = [asIs.value, repaired.value];
    if (!(report.value?.answer.value as readonly Row[]).some(({ Phase }) => Phase === "changed")) return;
    const [before, after] = await Promise.all(outcomes.map((outcome) => this.#shapes(outcome, signal)));
    if (before && after) changes.value = meshDifference(before, after);
  }

  /** The whole shape of a single value; null if it is too large or undefined. */
  async #shapes(outcome: Outcome | null, signal: AbortSignal): Promise<readonly Shape[] | null> {
    const value = outcome?.answer.value as Readonly<Record<string, unknown>> | null | undefined;
    const size = Math.max(0, ...Object.values(value ?? {}).filter((count) => typeof count === "number"));
    if (!outcome?.resultId || size > mostCompared) return null;
    const query = { column: "value", from: 0, count: 1 };
    const response = await this.#store.client.shapes(outcome.resultId, query, signal);
    return decodeShapes(await response.arrayBuffer());
  }

  async #run(statement: string, signal: AbortSignal): Promise<Outcome> {
    const outcome = await this.#store.runner.run(statement, {}, signal);
    if (isFailure(outcome)) throw new Error([outcome.message, outcome.remedy].filter(Boolean).join(" "));
    return outcome;
  }
}

interface Batch {
  readonly batch: number;
  readonly isOfMany: boolean;
}

interface ReviewOf extends Batch {
  readonly key: number;
  readonly file: File;
  readonly stop: () => void;
}

function makeReview({ file, ...others }: ReviewOf): Review {
  return {
    ...others,
    fileName: file.name,
    bytes: file.size,
    sent: signal(0),
    phase: signal<Review["phase"]["value"]>("sending"),
    problem: signal(""),
    path: signal(""),
    asIs: signal<Outcome | null>(null),
    report: signal<Outcome | null>(null),
    repaired: signal<Outcome | null>(null),
    changes: signal<MeshDifference | null>(null),
  };
}
