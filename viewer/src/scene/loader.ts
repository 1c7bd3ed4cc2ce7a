/**
 * Progressive loading of the shapes of columns: all rows coarse first, then finer where the budget allows, then those
 * that are selected in full. One request at a time, so that what a person asks for next does not wait long.
 */

import type { CellRef, LoadProgress, ShapeSource } from "./api";
import type { Shape } from "../glb/shapes";
import { decodeBeside } from "./decoding";
import type { Column, ShapeRecord, ShapeStore } from "./shape_store";

/** Triangles of one shape in the first picture, at most. */
export const kCoarseTriangles = 20_000;
/** Triangles of all shapes of a column in the first picture; it is what is drawn while moving on a slow machine. */
const kCoarseTotal = 60_000;
const kLeastTriangles = 32;
/** Triangles of a shape in the second one, if the value has far more. */
export const kMiddleTriangles = 200_000;
/** Values with more triangles get the middle level before the full one. */
const kMiddleFrom = 2_000_000;
/** Triangles of all objects that may be in memory: 10 million and their coarser levels are below 1 GB. */
export const kTriangleBudget = 12_000_000;
const kRowsPerRequest = 500;
/** Neighbouring rows are made finer in one request up to so many triangles. */
const kTrianglesPerRequest = 500_000;
/** Rows between them that need nothing are sent again: at most this share of a request. */
const kMostWaste = 0.2;
/** Milliseconds from one refinement of the picture to the next: each is drawn in full. */
const kRefineInterval = 1000;
const kProgressInterval = 300;

/** Milliseconds of work after which the page gets its turn. */
const kSlice = 8;

export interface LoaderEvents {
  progress(progress: LoadProgress): void;
  /** Shapes of a column came: its first ones, those of more rows, or finer or coarser ones of rows that were there. */
  changed(column: Column, came: "first" | "more" | "finer"): void;
}

/** Neighbouring rows of a column that are to be made finer. */
interface Wish {
  readonly records: readonly ShapeRecord[];
  readonly triangles: number;
}

interface Job {
  readonly abort: AbortController;
  coarseDone: boolean;
  /** The row with which the first picture goes on. */
  next: number;
  failed: boolean;
  bytes: number;
}

export class Loader {
  private readonly jobs = new Map<Column, Job>();
  readonly latest = new Map<Column, LoadProgress>();
  private selected: readonly CellRef[] = [];
  private refining = false;
  /** When the picture was refined last. */
  private refinedAt = -Infinity;

  constructor(
    private readonly store: ShapeStore,
    private readonly events: LoaderEvents,
    private readonly budget = kTriangleBudget,
    private readonly interval = kRefineInterval,
  ) {}

  start(column: Column): void {
    const job: Job = { abort: new AbortController(), coarseDone: false, next: 0, failed: false, bytes: 0 };
    this.jobs.set(column, job);
    void this.loadCoarse(column, job);
  }

  /** Ends the loading of a column; what is there stays, and `resume` goes on. */
  halt(column: Column): void {
    const job = this.jobs.get(column);
    if (!job || job.abort.signal.aborted || this.latest.get(column)?.phase === "done") return;
    this.report(column, job, "stopped", null, "");
    job.abort.abort();
  }

  resume(column: Column): void {
    const halted = this.jobs.get(column);
    if (!halted?.abort.signal.aborted) return;
    const job: Job = { ...halted, abort: new AbortController() };
    this.jobs.set(column, job);
    if (!job.coarseDone) {
      void this.loadCoarse(column, job);
      return;
    }
    this.report(column, job, "fine", null, "");
    void this.refine();
  }

  stop(column: Column): void {
    this.jobs.get(column)?.abort.abort();
    this.jobs.delete(column);
    this.latest.delete(column);
  }

  stopAll(): void {
    for (const column of [...this.jobs.keys()]) this.stop(column);
  }

  /** Selected objects are loaded in full. */
  select(cells: readonly CellRef[]): void {
    this.selected = cells;
    for (const cell of cells) {
      const record = this.store.record(cell);
      if (record) this.finished.delete(record);
    }
    void this.refine();
  }

  /** To be called when visibility changed. */
  reconsider(): void {
    void this.refine();
  }

  private async loadCoarse(column: Column, job: Job): Promise<void> {
    try {
      this.report(column, job, "coarse", null, "");
      let from: number | null = job.next;
      const triangles = coarseTriangles(column.source.count);
      while (from !== null && from < column.source.count) {
        const next: number | null = await this.loadRows(
          column,
          job,
          from,
          kRowsPerRequest,
          triangles,
          "coarse",
        );
        if (job.abort.signal.aborted) return;
        from = next;
        job.next = next ?? column.source.count;
      }
      job.coarseDone = true;
      this.report(column, job, "fine", null, "");
      await this.refine();
    } catch (error) {
      this.fail(column, job, error);
    }
  }

  /** Returns the row to go on with. */
  private async loadRows(
    column: Column,
    job: Job,
    from: number,
    count: number,
    triangles: number,
    phase: "coarse" | "fine",
  ): Promise<number | null> {
    const { source } = column;
    const stopPolling = this.pollServer(column, job, phase);
    try {
      const batch = await source.load(
        {
          from,
          count,
          triangles,
          onBytes: (received, total) => {
            stopPolling();
            this.report(column, job, phase, total ? received / total : null, "", received);
          },
        },
        job.abort.signal,
      );
      const { byteLength } = batch.bytes;
      const shapes = await decodeBeside(batch.bytes);
      if (phase === "fine") await this.pause();
      if (this.isStopped(job)) return null;
      job.bytes += byteLength;
      const before = column.records.size;
      const isWhole = await this.addShapes(column, job, shapes);
      if (this.jobs.get(column) !== job) return null;
      const more = column.records.size > before;
      // Also of what came until it was stopped.
      this.events.changed(column, !more ? "finer" : before === 0 ? "first" : "more");
      if (!isWhole) return null;
      this.report(column, job, phase, null, "");
      const last = shapes.at(-1)?.row;
      return batch.next !== null && last !== undefined && batch.next <= last ? last + 1 : batch.next;
    } finally {
      stopPolling();
    }
  }

  private isStopped({ abort }: Job): boolean {
    return abort.signal.aborted;
  }

  /** Adds shapes without holding up the page; false if nobody wants them any more. */
  private async addShapes(column: Column, job: Job, shapes: readonly Shape[]): Promise<boolean> {
    let begun = performance.now();
    for (const added of this.store.adding(column, shapes)) {
      void added;
      if (performance.now() - begun < kSlice) continue;
      await new Promise((next) => setTimeout(next));
      if (this.isStopped(job)) return false;
      begun = performance.now();
    }
    return true;
  }

  /** Asks what the server is doing as long as nothing comes. */
  private pollServer(column: Column, job: Job, phase: "coarse" | "fine"): () => void {
    const { source } = column;
    if (!source.progress) return () => undefined;
    let ended = false;
    const ask = async (): Promise<void> => {
      const text = await source.progress!(job.abort.signal).catch(() => "");
      if (ended) return;
      if (text) this.report(column, job, phase, percentage(text), text);
      timer = setTimeout(() => void ask(), kProgressInterval);
    };
    let timer = setTimeout(() => void ask(), kProgressInterval);
    return () => {
      ended = true;
      clearTimeout(timer);
    };
  }

  /** Loads finer levels as long as something is wanted. */
  private async refine(): Promise<void> {
    if (this.refining) return;
    this.refining = true;
    try {
      for (;;) {
        this.trim();
        const wish = this.nextWish();
        if (!wish) break;
        await this.loadFiner(wish);
      }
    } finally {
      this.refining = false;
    }
    for (const [column, job] of this.jobs) {
      if (job.coarseDone && !job.failed) this.report(column, job, "done", null, "");
    }
  }

  /** Until the picture may be refined again. */
  private async pause(): Promise<void> {
    const rest = this.refinedAt + this.interval - performance.now();
    if (rest > 0) await new Promise((next) => setTimeout(next, rest));
    this.refinedAt = performance.now();
  }

  private async loadFiner({ records, triangles }: Wish): Promise<void> {
    const first = records[0]!;
    const job = this.jobs.get(first.column);
    if (!job) return;
    const before = records.map(({ shown }) => shown);
    try {
      const next = await this.loadRows(first.column, job, first.row, records.length, triangles, "fine");
      if (this.isStopped(job)) return;
      // A server that has no finer level must not be asked for ever.
      if (triangles === kMiddleTriangles) this.hasMiddle.add(first);
      else
        records.forEach((record, index) => {
          const came = next === null || record.row < next;
          if (came && record.shown <= before[index]!) this.finished.add(record);
        });
    } catch (error) {
      if (this.isStopped(job)) return;
      for (const record of records) this.finished.add(record);
      this.fail(first.column, job, error);
    }
  }

  /** Those whose full level is loaded, or cannot be had. */
  private readonly finished = new WeakSet<ShapeRecord>();
  /** Those whose middle level was asked for. */
  private readonly hasMiddle = new WeakSet<ShapeRecord>();

  /** What to load next: the selected in full, a middle level of the largest, then ranges of rows. */
  private nextWish(): Wish | null {
    for (const cell of this.selected) {
      const record = this.store.record(cell);
      if (record?.visible && this.isWanted(record)) return { records: [record], triangles: 0 };
    }
    let left = this.budget - this.store.triangleCounts().fine;
    const affordable = new Set<ShapeRecord>();
    const candidates = [...this.store.visibleRecords()]
      .filter((record) => this.isWanted(record))
      .sort((a, b) => a.triangles - b.triangles);
    for (const record of candidates) {
      const needed = record.triangles - record.shown;
      if (needed > left) break; // the others are larger
      left -= needed;
      affordable.add(record);
    }
    const first = candidates.find((record) => affordable.has(record) && record.triangles <= kMiddleFrom);
    if (first) return { records: this.range(first, affordable), triangles: 0 };
    return this.largeWish(candidates, affordable, left);
  }

  /** Of values that are far larger than others: one after the other, each by way of a middle level. */
  private largeWish(
    candidates: readonly ShapeRecord[],
    affordable: ReadonlySet<ShapeRecord>,
    left: number,
  ): Wish | null {
    for (const record of candidates) {
      const isLarge = record.triangles > kMiddleFrom && !this.hasMiddle.has(record);
      if (isLarge && kMiddleTriangles - record.shown <= left)
        return { records: [record], triangles: kMiddleTriangles };
      if (affordable.has(record)) return { records: [record], triangles: 0 };
    }
    return null;
  }

  /**
   * The rows that are loaded with a record by one request: those around it that are to be loaded, too, and few others
   * between them.
   */
  private range(record: ShapeRecord, affordable: ReadonlySet<ShapeRecord>): ShapeRecord[] {
    const { records } = record.column;
    const isLoaded = (other: ShapeRecord): boolean => affordable.has(other) && other.triangles <= kMiddleFrom;
    let [from, to] = [record.row, record.row];
    let [triangles, waste] = [record.triangles, 0];
    for (const step of [-1, 1] as const) {
      let [seen, between] = [0, 0];
      for (let row = record.row + step; ; row += step) {
        const next = records.get(row);
        if (!next) break;
        seen += next.triangles;
        if (!isLoaded(next)) between += next.triangles;
        if (triangles + seen > kTrianglesPerRequest) break;
        if (waste + between > kMostWaste * kTrianglesPerRequest) break;
        if (!isLoaded(next)) continue;
        if (step < 0) from = row;
        else to = row;
        triangles += seen;
        waste += between;
        [seen, between] = [0, 0];
      }
    }
    return Array.from({ length: to - from + 1 }, (_, i) => records.get(from + i)!);
  }

  private isWanted(record: ShapeRecord): boolean {
    const job = this.jobs.get(record.column);
    return (
      !!job?.coarseDone &&
      !this.isStopped(job) &&
      record.shown < record.triangles &&
      !this.finished.has(record)
    );
  }

  /** Frees the finest levels of large objects that are not selected while there are too many triangles. */
  private trim(): void {
    let { fine } = this.store.triangleCounts();
    if (fine <= this.budget) return;
    const large = [...this.store.records()]
      .filter((record) => record.levels.length > 1 && !this.isSelected(record))
      .sort((a, b) => b.shown - a.shown);
    for (const record of large) {
      if (fine <= this.budget) return;
      fine -= record.shown;
      this.store.dropFinest(record);
      fine += record.shown;
      this.finished.add(record);
      this.events.changed(record.column, "finer");
    }
  }

  private isSelected(record: ShapeRecord): boolean {
    return this.selected.some((cell) => this.store.record(cell) === record);
  }

  private fail(column: Column, job: Job, error: unknown): void {
    if (job.abort.signal.aborted) return;
    job.failed = true;
    this.report(column, job, "failed", null, error instanceof Error ? error.message : String(error));
  }

  private report(
    column: Column,
    job: Job,
    phase: LoadProgress["phase"],
    fraction: number | null,
    text: string,
    received = 0,
  ): void {
    if (job.abort.signal.aborted) return;
    const progress: LoadProgress = {
      result: column.source.result,
      column: column.source.column,
      phase,
      rowsLoaded: column.records.size,
      rows: column.source.count,
      bytes: job.bytes + received,
      fraction,
      text: text || describe(column.source, column.records.size, phase, job.bytes + received),
    };
    this.latest.set(column, progress);
    this.events.progress(progress);
  }
}

/** The largest number of triangles of a shape in the first picture of a column with so many rows. */
export function coarseTriangles(rows: number): number {
  const share = Math.floor(kCoarseTotal / Math.max(1, rows));
  return Math.min(kCoarseTriangles, Math.max(kLeastTriangles, share));
}

function describe(source: ShapeSource, rows: number, phase: LoadProgress["phase"], bytes: number): string {
  const objects = source.count === 1 ? "1 object" : `${rows} of ${source.count} objects`;
  const size = bytes < 1e6 ? `${Math.ceil(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
  const doing = { coarse: "", fine: ", loading details", done: "", failed: "", stopped: ", stopped" };
  return `${objects}, ${size}${doing[phase]}`;
}

/** 0.42 of "levels of detail, 42 %". */
export function percentage(text: string): number | null {
  const match = /(\d+(?:\.\d+)?)\s*%/.exec(text);
  return match ? Math.min(1, Number(match[1]) / 100) : null;
}
