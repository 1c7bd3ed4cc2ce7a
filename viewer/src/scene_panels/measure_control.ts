/** Asks the database for the values of the measures of a view, and marks in the scene what was clicked. */

import { measureInfo, questionOf } from "../scene";
import type { Database, Hit, Markers, MeasureState, SceneView, Vec3 } from "../scene";
import { shortNumber } from "./fields";
import { messageOf } from "./hooks";

/** The value of a measure; both are null until it is there. */
export interface MeasureAnswer {
  readonly value: number | null;
  readonly error: string | null;
}

const kNoAnswer: MeasureAnswer = { value: null, error: null };
const kColor = "#e0307a";

export class MeasureControl {
  /** By question, so that a measure that is undone and redone is not asked again. */
  private readonly answers = new Map<string, MeasureAnswer>();
  private readonly ends: (() => void)[];
  private drawn = "";

  constructor(
    private readonly view: SceneView,
    private readonly database: Database,
    private readonly changed: () => void,
  ) {
    this.ends = [
      view.on("state", ({ parts }) => {
        if (parts.some((part) => part === "tools" || part === "focus" || part === "display")) this.look();
      }),
      view.on("shapes", () => this.look()),
    ];
  }

  /** The measures whose objects are all seen. */
  get shown(): readonly MeasureState[] {
    return this.view.state.tools.measures.filter(({ hits }) => hits.every((hit) => this.isSeen(hit)));
  }

  /** The place that is inspected, if its object is seen. */
  get inspected(): Hit | null {
    const { inspected } = this.view.state.tools;
    return inspected && this.isSeen(inspected) ? inspected : null;
  }

  answerOf(measure: MeasureState): MeasureAnswer {
    return this.answers.get(keyOf(measure)) ?? kNoAnswer;
  }

  remove(id: number): void {
    const { measures } = this.view.state.tools;
    this.view.update({ tools: { measures: measures.filter((measure) => measure.id !== id) } });
  }

  private isSeen({ cell }: Hit): boolean {
    return this.view.isVisible(cell);
  }

  private look(): void {
    for (const measure of this.shown) if (!this.answers.has(keyOf(measure))) void this.ask(measure);
    this.mark();
    this.changed();
  }

  private async ask(measure: MeasureState): Promise<void> {
    const key = keyOf(measure);
    this.answers.set(key, kNoAnswer);
    const { statement, parameters } = questionOf(measure);
    let answer: MeasureAnswer;
    try {
      const { value } = await this.database.query(statement, parameters);
      answer = typeof value === "number" ? { value, error: null } : failed("The answer is undefined.");
    } catch (error) {
      answer = failed(messageOf(error));
    }
    this.answers.set(key, answer);
    this.mark();
    this.changed();
  }

  private mark(): void {
    const { tool, picks } = this.view.state.tools;
    const placeOf = (hit: Hit): Hit => moved(hit, this.view.shape(hit.cell)?.offset ?? [0, 0, 0]);
    const measures = this.shown.map((measure) => ({
      measure: { ...measure, hits: measure.hits.map(placeOf) },
      text: textOf(measure, this.answerOf(measure)),
    }));
    const seen = picks.filter((hit) => this.isSeen(hit)).map(placeOf);
    const inspected = tool === "inspect" && this.inspected ? highlight(placeOf(this.inspected)) : null;
    const marked = { measures: markersOf(measures, seen), inspected };
    const key = JSON.stringify(marked);
    if (key === this.drawn) return;
    this.drawn = key;
    this.view.setMarkers("measures", marked.measures);
    this.view.setMarkers("inspected", marked.inspected);
  }

  dispose(): void {
    for (const end of this.ends) end();
  }
}

function keyOf(measure: MeasureState): string {
  return JSON.stringify(questionOf(measure));
}

const failed = (error: string): MeasureAnswer => ({ value: null, error });

/** The value with its unit; "" if it is not known. */
export function textOf({ kind, hits }: MeasureState, { value }: MeasureAnswer, short = true): string {
  if (value === null) return "";
  const { isExact, unit } = measureInfo(kind);
  return `${isExact(hits) ? "" : "≈ "}${short ? shortNumber(value) : String(value)}${unit}`;
}

function moved(hit: Hit, offset: Vec3): Hit {
  const to = (place: Vec3): Vec3 => [place[0] + offset[0], place[1] + offset[1], place[2] + offset[2]];
  const { triangle } = hit;
  if (!triangle) return { ...hit, point: to(hit.point) };
  const [a, b, c] = triangle.corners;
  return { ...hit, point: to(hit.point), triangle: { ...triangle, corners: [to(a), to(b), to(c)] } };
}

interface Shown {
  readonly measure: MeasureState;
  readonly text: string;
}

/** The measures with their values, and the places that were clicked so far. */
export function markersOf(measures: readonly Shown[], picks: readonly Hit[]): Markers | null {
  if (measures.length === 0 && picks.length === 0) return null;
  const hits = [...measures.flatMap(({ measure }) => measure.hits), ...picks];
  const lines = measures.filter(({ measure: { kind } }) => kind === "distance" || kind === "angle");
  return {
    color: kColor,
    points: hits.map(({ point }) => point),
    segments: lines.flatMap(({ measure: { hits: ends } }) =>
      ends.slice(1).map((end, i) => [ends[i]!.point, end.point] as const),
    ),
    labels: measures
      .filter(({ text }) => text !== "")
      .map(({ measure: { kind, hits: ends }, text }) => ({
        at: kind === "angle" ? ends[1]!.point : middleOf(ends),
        text,
      })),
  };
}

function middleOf(hits: readonly Hit[]): Vec3 {
  const sum = (axis: 0 | 1 | 2): number =>
    hits.reduce((total, { point }) => total + point[axis], 0) / hits.length;
  return [sum(0), sum(1), sum(2)];
}

function highlight({ triangle, point }: Hit): Markers {
  if (!triangle) return { color: kColor, points: [point] };
  const [a, b, c] = triangle.corners;
  return {
    color: kColor,
    points: [point],
    triangles: [triangle.corners],
    segments: [
      [a, b],
      [b, c],
      [c, a],
    ],
  };
}
