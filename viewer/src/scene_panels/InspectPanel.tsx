import type { Database, Hit, Question, Vec3 } from "../scene";
import { Check, Section, shortNumber } from "./fields";
import { useAnswers, useSceneState } from "./hooks";
import type { SceneModel } from "./scene_model";
import { Statement } from "./Statement";

const vector = (v: Vec3): string => v.map(shortNumber).join("  ");

/** The triangle and vertex that was clicked: numbers, coordinates, normal and area. */
export function InspectPanel({ model }: { model: SceneModel }) {
  const { view, database } = model;
  const { tools } = useSceneState(view, "tools");
  useAnswers(model);
  const on = tools.tool === "inspect";
  const hit = model.measures.inspected;
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
