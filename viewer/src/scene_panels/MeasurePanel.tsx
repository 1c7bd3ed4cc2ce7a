import { useEffect, useRef, useState } from "preact/hooks";

import {
  angleOf,
  areaOf,
  arePlacesExact,
  distanceOf,
  faceAngleOf,
  faceAreaOf,
  objectDistanceOf,
  volumeOf,
} from "../scene";
import type { Database, Hit, Markers, Question, SceneView } from "../scene";
import { Check, Choice, Section, shortNumber } from "./fields";
import { messageOf, useSceneEvents } from "./hooks";
import { Statement } from "./Statement";

type Kind = "distance" | "angle" | "faceAngle" | "faceArea" | "objects" | "area" | "volume";

interface KindInfo {
  readonly id: Kind;
  readonly title: string;
  /** How many clicks it takes. */
  readonly picks: number;
  readonly hint: string;
  readonly unit: string;
  readonly ask: (hits: readonly Hit[]) => Question;
  /** Whether the points are those of the value and not rounded ones of the picture. */
  readonly isExact: (hits: readonly Hit[]) => boolean;
}

const always = (): boolean => true;

const kKinds: readonly KindInfo[] = [
  {
    id: "distance",
    title: "Distance of two points",
    picks: 2,
    hint: "Click two points.",
    unit: "",
    ask: ([a, b]) => distanceOf(a!, b!),
    isExact: arePlacesExact,
  },
  {
    id: "objects",
    title: "Distance of two objects",
    picks: 2,
    hint: "Click two objects.",
    unit: "",
    ask: ([a, b]) => objectDistanceOf(a!.cell, b!.cell),
    isExact: always,
  },
  {
    id: "angle",
    title: "Angle of three points",
    picks: 3,
    hint: "Click a point, the corner, another point.",
    unit: "°",
    ask: ([a, b, c]) => angleOf(a!, b!, c!),
    isExact: arePlacesExact,
  },
  {
    id: "faceAngle",
    title: "Angle of two faces",
    picks: 2,
    hint: "Click two faces: the angle of their normals.",
    unit: "°",
    ask: ([a, b]) => faceAngleOf(a!, b!),
    isExact: always,
  },
  {
    id: "faceArea",
    title: "Area of a triangle",
    picks: 1,
    hint: "Click a triangle.",
    unit: "",
    ask: ([a]) => faceAreaOf(a!),
    isExact: always,
  },
  {
    id: "area",
    title: "Area of an object",
    picks: 1,
    hint: "Click an object.",
    unit: "",
    ask: ([a]) => areaOf(a!.cell),
    isExact: always,
  },
  {
    id: "volume",
    title: "Volume of an object",
    picks: 1,
    hint: "Click a solid.",
    unit: "",
    ask: ([a]) => volumeOf(a!.cell),
    isExact: always,
  },
];

interface Measure {
  readonly id: number;
  readonly kind: KindInfo;
  readonly hits: readonly Hit[];
  readonly question: Question;
  readonly value: number | null;
  readonly error: string | null;
}

interface Props {
  readonly view: SceneView;
  readonly database: Database;
}

/** Measures between clicked places; each number comes from the database and is shown with its query. */
export function MeasurePanel({ view, database }: Props) {
  useSceneEvents(view, "tool");
  const [kind, setKind] = useState<Kind>("distance");
  const [measures, setMeasures] = useState<readonly Measure[]>([]);
  const [snap, setSnap] = useState({ ...view.snap });
  const picked = useMeasuring(
    view,
    database,
    kKinds.find(({ id }) => id === kind)!,
    setMeasures,
  );
  useMarkers(view, measures, picked);
  const on = view.tool === "measure";
  const info = kKinds.find(({ id }) => id === kind)!;
  const setSnaps = (change: Partial<typeof snap>): void => {
    Object.assign(view.snap, change);
    setSnap({ ...view.snap });
  };
  return (
    <Section title="Measure" open={false} testId="measure-panel" inUse={on}>
      <Check label="Measure by clicking" checked={on} onChange={() => view.act("measure")} />
      <Choice
        label="What"
        value={kind}
        options={kKinds.map(({ id, title }) => ({ id, title }))}
        onChange={(id) => {
          setKind(id);
          view.tool = "measure";
        }}
      />
      {on && (
        <p class="muted" aria-live="polite">
          {info.hint} {picked.length > 0 && `${picked.length} of ${info.picks} clicked.`}
        </p>
      )}
      <div class="row">
        <Check
          label="Snap to vertices"
          checked={snap.vertices}
          onChange={(vertices) => setSnaps({ vertices })}
        />
        <Check label="to edges" checked={snap.edges} onChange={(edges) => setSnaps({ edges })} />
      </div>
      <ul class="list" aria-label="Measures" aria-live="polite">
        {measures.map((measure) => (
          <MeasureItem
            key={measure.id}
            measure={measure}
            database={database}
            onRemove={() => setMeasures((all) => all.filter(({ id }) => id !== measure.id))}
          />
        ))}
      </ul>
      {measures.length > 1 && (
        <div class="row">
          <button type="button" class="btn small" onClick={() => setMeasures([])}>
            Delete all
          </button>
        </div>
      )}
    </Section>
  );
}

/** Collects clicks until the kind has enough of them, then asks; returns the clicks so far. */
function useMeasuring(
  view: SceneView,
  database: Database,
  kind: KindInfo,
  setMeasures: (change: (all: readonly Measure[]) => readonly Measure[]) => void,
): readonly Hit[] {
  const [hits, setHits] = useState<readonly Hit[]>([]);
  const latest = useRef<readonly Hit[]>([]);
  const nextId = useRef(1);
  useEffect(() => {
    latest.current = [];
    setHits([]);
    const pick = (hit: Hit): void => {
      const all = [...latest.current, hit];
      latest.current = all.length < kind.picks ? all : [];
      setHits(latest.current);
      if (all.length < kind.picks) return;
      const id = nextId.current++;
      const question = kind.ask(all);
      setMeasures((known) => [...known, { id, kind, hits: all, question, value: null, error: null }]);
      const answered = (change: Partial<Measure>): void =>
        setMeasures((known) =>
          known.map((measure) => (measure.id === id ? { ...measure, ...change } : measure)),
        );
      database.query(question.statement, question.parameters).then(
        ({ value }) =>
          answered(typeof value === "number" ? { value } : { error: "The answer is undefined." }),
        (error: unknown) => answered({ error: messageOf(error) }),
      );
    };
    return view.on("pick", ({ hit, tool }) => {
      if (tool === "measure") pick(hit);
    });
  }, [view, database, kind]);
  return hits;
}

function MeasureItem({
  measure,
  database,
  onRemove,
}: {
  measure: Measure;
  database: Database;
  onRemove: () => void;
}) {
  const { kind, value, error, hits } = measure;
  const coarse = hits.some(({ deviation }) => deviation > 0);
  return (
    <li class="measure" data-testid="measure">
      <div class="field">
        <span>{kind.title}</span>
        <strong data-testid="measure-value">
          {value !== null ? `${kind.isExact(hits) ? "" : "≈ "}${value}${kind.unit}` : error ? "" : "…"}
        </strong>
        <button type="button" class="btn quiet small" aria-label={`Delete ${kind.title}`} onClick={onRemove}>
          Delete
        </button>
      </div>
      {error && <p class="error-text">{error}</p>}
      {!kind.isExact(hits) && (
        <p class="muted">
          Between points of the picture, which are rounded
          {coarse && ` and lie on a coarser level of detail, up to ${shortNumber(maxDeviation(hits))} away`}.
        </p>
      )}
      <Statement question={measure.question} database={database} />
    </li>
  );
}

function maxDeviation(hits: readonly Hit[]): number {
  return Math.max(...hits.map(({ deviation }) => deviation));
}

/** Draws the measures, and the places that were clicked so far. */
function useMarkers(view: SceneView, measures: readonly Measure[], picked: readonly Hit[]): void {
  useEffect(() => {
    view.setMarkers("measures", markersOf(measures, picked));
  }, [view, measures, picked]);
  useEffect(() => () => view.setMarkers("measures", null), [view]);
}

export function markersOf(measures: readonly Measure[], picked: readonly Hit[]): Markers | null {
  if (measures.length === 0 && picked.length === 0) return null;
  const hits = [...measures.flatMap((measure) => measure.hits), ...picked];
  const lines = measures.filter(({ kind }) => kind.id === "distance" || kind.id === "angle");
  return {
    color: "#e0307a",
    points: hits.map(({ point }) => point),
    segments: lines.flatMap(({ hits: ends }) =>
      ends.slice(1).map((end, i) => [ends[i]!.point, end.point] as const),
    ),
    labels: measures
      .filter(({ value }) => value !== null)
      .map(({ kind, hits: ends, value }) => ({
        at: kind.id === "angle" ? ends[1]!.point : middleOf(ends),
        text: `${kind.isExact(ends) ? "" : "≈ "}${shortNumber(value!)}${kind.unit}`,
      })),
  };
}

function middleOf(hits: readonly Hit[]): readonly [number, number, number] {
  const sum = (axis: 0 | 1 | 2): number =>
    hits.reduce((total, { point }) => total + point[axis], 0) / hits.length;
  return [sum(0), sum(1), sum(2)];
}
