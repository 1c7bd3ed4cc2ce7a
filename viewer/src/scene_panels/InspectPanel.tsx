import { useEffect, useState } from "preact/hooks";

import type { Database, Hit, Question, SceneView, Vec3 } from "../scene";
import { Check, Section, shortNumber } from "./fields";
import { useSceneEvents } from "./hooks";
import { Statement } from "./Statement";

interface Props {
  readonly view: SceneView;
  readonly database: Database;
}

const vector = (v: Vec3): string => v.map(shortNumber).join("  ");

/** The triangle and vertex that was clicked: numbers, coordinates, normal and area. */
export function InspectPanel({ view, database }: Props) {
  useSceneEvents(view, "tool");
  const [hit, setHit] = useState<Hit | null>(null);
  useEffect(
    () =>
      view.on("pick", ({ hit: picked, tool }) => {
        if (tool === "inspect") setHit(picked);
      }),
    [view],
  );
  const on = view.tool === "inspect";
  useEffect(() => {
    view.setMarkers("inspected", on && hit ? highlight(hit) : null);
  }, [view, hit, on]);
  useEffect(() => () => view.setMarkers("inspected", null), [view]);
  return (
    <Section title="Inspect" open={false} testId="inspect-panel" inUse={on}>
      <Check label="Inspect by clicking" checked={on} onChange={() => view.act("inspect")} />
      {hit ? (
        <HitFacts hit={hit} database={database} />
      ) : (
        <p class="muted">Click a triangle, vertex or point.</p>
      )}
    </Section>
  );
}

function highlight({ triangle, point }: Hit): Parameters<SceneView["setMarkers"]>[1] {
  if (!triangle) return { color: "#e0307a", points: [point] };
  const [a, b, c] = triangle.corners;
  return {
    color: "#e0307a",
    points: [point],
    triangles: [triangle.corners],
    segments: [
      [a, b],
      [b, c],
      [c, a],
    ],
  };
}

function HitFacts({ hit, database }: { hit: Hit; database: Database }) {
  const { triangle } = hit;
  return (
    <>
      <dl class="facts" data-testid="inspected">
        <dt>Row</dt>
        <dd>{hit.cell.row + 1}</dd>
        {hit.vertex !== null && (
          <>
            <dt>{hit.snap === "point" ? "Point" : "Vertex"}</dt>
            <dd>{hit.vertex}</dd>
          </>
        )}
        <dt>Place</dt>
        <dd>{vector(hit.point)}</dd>
        {triangle && (
          <>
            <dt>Triangle</dt>
            <dd>{hit.face ?? "of a coarser level"}</dd>
            {triangle.corners.map((corner, i) => (
              <>
                <dt>Vertex {triangle.ids[i] ?? ""}</dt>
                <dd>{vector(corner)}</dd>
              </>
            ))}
            <dt>Normal</dt>
            <dd>{vector(triangle.normal)}</dd>
            <dt>Area</dt>
            <dd>{shortNumber(triangle.area)}</dd>
          </>
        )}
      </dl>
      {hit.deviation > 0 && (
        <p class="muted">A coarser level of detail, up to {shortNumber(hit.deviation)} from the value.</p>
      )}
      {exactQuestions(hit).map((question) => (
        <Statement key={question.statement} question={question} database={database} />
      ))}
    </>
  );
}

/** The queries for what is shown here rounded to floats. */
function exactQuestions(hit: Hit): Question[] {
  const parameters = { v: hit.cell };
  const questions: Question[] = [];
  if (hit.triangle && hit.face !== null) {
    questions.push({ statement: `query faces($v) filter[.Id = ${hit.face}] consume`, parameters });
    questions.push({ statement: `query faceVertices($v, ${hit.face}) consume`, parameters });
  }
  if (hit.snap === "vertex" && hit.vertex !== null) {
    questions.push({ statement: `query vertices($v) filter[.Id = ${hit.vertex}] consume`, parameters });
  }
  return questions;
}
