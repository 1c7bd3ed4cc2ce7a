/** Asks the database for the exact cut of each visible solid when the section plane rests, and shows it as the cap. */

import { regionOf, sectionAreaOf, sectionOf } from "../scene";
import type { CellRef, CutPlane, Database, Question, SceneView, ShapeInfo } from "../scene";
import { messageOf } from "./hooks";

/** The exact cut of one solid. */
export interface Cut {
  readonly cell: CellRef;
  readonly area: number | null;
  readonly areaQuestion: Question;
  readonly regionQuestion: Question;
  readonly error: string | null;
}

/** More solids than this are not cut by the database at once; the largest come first. */
export const kMaxCuts = 40;
const kPause = 120;

export class SectionControl {
  cuts: readonly Cut[] = [];
  busy = false;
  /** Solids that the plane meets and that were left out. */
  skipped = 0;
  private abort: AbortController | null = null;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private readonly ends: (() => void)[];

  constructor(
    private readonly view: SceneView,
    private readonly database: Database,
    private readonly changed: () => void,
  ) {
    this.ends = [
      view.on("section", () => this.schedule()),
      view.on("shapes", () => this.reconsider()),
      view.on("state", ({ parts }) => {
        if (parts.includes("section") || parts.includes("display")) this.reconsider();
      }),
    ];
  }

  private key = "";

  /** What is cut, and where; a new question is asked only if it changed. */
  private currentKey(): string {
    const { on, point, normal } = this.view.state.section;
    const cells = this.solids().map(({ cell, offset }) => [cell, offset]);
    return on ? JSON.stringify([point, normal, cells]) : "";
  }

  private reconsider(): void {
    const { section } = this.view.state;
    if (!section.on) {
      this.stop();
      return;
    }
    const key = this.currentKey();
    if (key === this.key) return;
    this.stop();
    if (section.cap === "exact") this.view.update({ section: { cap: "preview" } });
    this.schedule();
  }

  private stop(): void {
    clearTimeout(this.timer);
    this.abort?.abort();
    this.abort = null;
    this.key = "";
    if (this.cuts.length === 0 && !this.busy && this.skipped === 0) return;
    this.cuts = [];
    this.skipped = 0;
    this.busy = false;
    this.changed();
  }

  private schedule(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.ask(), kPause);
  }

  private solids(): ShapeInfo[] {
    return this.view.shapes().filter(({ visible, kind }) => visible && kind === "volume3d");
  }

  /** The plane in the coordinates of an object that is drawn beside its place. */
  private planeFor({ offset }: ShapeInfo): CutPlane {
    const { point, normal } = this.view.state.section;
    return { point: [point[0] - offset[0], point[1] - offset[1], point[2] - offset[2]], normal };
  }

  private async ask(): Promise<void> {
    if (!this.view.state.section.on) return;
    this.abort?.abort();
    const abort = new AbortController();
    this.abort = abort;
    this.key = this.currentKey();
    const met = this.solids()
      .filter((solid) => meets(solid, this.planeFor(solid)))
      .sort((a, b) => sizeOf(b) - sizeOf(a));
    this.skipped = Math.max(0, met.length - kMaxCuts);
    this.busy = true;
    this.cuts = [];
    this.changed();
    const caps: { cell: CellRef; bytes: ArrayBuffer }[] = [];
    for (const solid of met.slice(0, kMaxCuts)) {
      const { cut, bytes } = await this.cut(solid, abort.signal);
      if (abort.signal.aborted) return;
      this.cuts = [...this.cuts, cut];
      if (bytes) caps.push({ cell: solid.cell, bytes });
      this.changed();
    }
    this.busy = false;
    this.view.setCaps(caps);
    // With gaps in the exact cut, the preview is the better picture.
    const complete = this.skipped === 0 && this.cuts.every(({ error }) => error === null);
    if (complete) this.view.update({ section: { cap: "exact" } });
    this.changed();
  }

  private async cut(solid: ShapeInfo, signal: AbortSignal): Promise<{ cut: Cut; bytes: ArrayBuffer | null }> {
    const { cell } = solid;
    const plane = this.planeFor(solid);
    const cut = { cell, areaQuestion: sectionAreaOf(cell, plane), regionQuestion: regionOf(cell, plane) };
    const { statement, parameters } = sectionOf(cell, plane);
    try {
      const answer = await this.database.query(statement, parameters, signal);
      if (!answer.result)
        return { cut: { ...cut, area: null, error: "The database sent no surface." }, bytes: null };
      const surface: CellRef = {
        result: answer.result.id,
        row: 0,
        column: answer.result.columns[0]?.name ?? "value",
      };
      try {
        const bytes = await this.database.shapes(surface, 0, signal);
        const area = await this.database.query("query area($s)", { s: surface }, signal);
        return {
          cut: { ...cut, area: typeof area.value === "number" ? area.value : null, error: null },
          bytes,
        };
      } finally {
        this.database.drop(answer.result.id);
      }
    } catch (error) {
      return { cut: { ...cut, area: null, error: messageOf(error) }, bytes: null };
    }
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.abort?.abort();
    for (const end of this.ends) end();
  }
}

function sizeOf({ box }: ShapeInfo): number {
  return box ? Math.hypot(box[1] - box[0], box[3] - box[2], box[5] - box[4]) : 0;
}

/** Whether the plane meets the box of a solid; touching counts. */
export function meets({ box }: Pick<ShapeInfo, "box">, { point, normal }: CutPlane): boolean {
  if (!box) return false;
  let [low, high] = [0, 0];
  for (let axis = 0; axis < 3; axis++) {
    const ends = [0, 1].map((end) => (box[2 * axis + end]! - point[axis]!) * normal[axis]!);
    low += Math.min(...ends);
    high += Math.max(...ends);
  }
  return low <= 0 && high >= 0;
}
