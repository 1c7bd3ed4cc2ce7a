import { kMeasures, measureInfo, questionOf } from "../scene";
import type { Hit, MeasureState, ToolsState } from "../scene";
import { Check, Choice, Section, shortNumber } from "./fields";
import { useAnswers, useSceneState } from "./hooks";
import { textOf } from "./measure_control";
import type { SceneModel } from "./scene_model";
import { Statement } from "./Statement";

/** Measures between clicked places; each number comes from the database and is shown with its query. */
export function MeasurePanel({ model }: { model: SceneModel }) {
  const { view } = model;
  const { tools } = useSceneState(view, "tools");
  useAnswers(model);
  const on = tools.tool === "measure";
  const set = (change: Partial<ToolsState>): void => view.update({ tools: change });
  const { shown } = model.measures;
  return (
    <Section title="Measure" open={false} testId="measure-panel" inUse={on}>
      <Check label="Measure by clicking" checked={on} onChange={() => view.act("measure")} />
      <MeasureChoice model={model} />
      {on && <p class="muted">{measureHint(tools)}</p>}
      <div class="row">
        <Check
          label="Snap to vertices"
          checked={tools.snapVertices}
          onChange={(snapVertices) => set({ snapVertices })}
        />
        <Check label="to edges" checked={tools.snapEdges} onChange={(snapEdges) => set({ snapEdges })} />
      </div>
      <ul class="list" aria-label="Measures">
        {shown.map((measure) => (
          <MeasureItem key={measure.id} model={model} measure={measure} />
        ))}
      </ul>
      {shown.length > 1 && (
        <div class="row">
          <button type="button" class="btn small" onClick={() => set({ measures: [] })}>
            Delete all
          </button>
        </div>
      )}
    </Section>
  );
}

/** What the next clicks measure. */
export function MeasureChoice({ model: { view } }: { model: SceneModel }) {
  const { tools } = useSceneState(view, "tools");
  return (
    <Choice
      label="What"
      value={tools.kind}
      options={kMeasures.map(({ id, title }) => ({ id, title }))}
      onChange={(kind) => view.update({ tools: { kind, tool: "measure", picks: [] } })}
    />
  );
}

/** What to click next. */
export function measureHint({ kind, picks }: ToolsState): string {
  const { hint, picks: needed } = measureInfo(kind);
  return picks.length > 0 ? `${hint} ${picks.length} of ${needed} clicked.` : hint;
}

function MeasureItem({ model, measure }: { model: SceneModel; measure: MeasureState }) {
  const { kind, hits } = measure;
  const { title, isExact } = measureInfo(kind);
  const answer = model.measures.answerOf(measure);
  const coarse = hits.some(({ deviation }) => deviation > 0);
  return (
    <li class="measure" data-testid="measure">
      <div class="field">
        <span>{title}</span>
        <strong data-testid="measure-value">
          {textOf(measure, answer, false) || (answer.error ? "" : "…")}
        </strong>
        <button
          type="button"
          class="btn quiet small"
          aria-label={`Delete ${title}`}
          onClick={() => model.measures.remove(measure.id)}
        >
          Delete
        </button>
      </div>
      {answer.error && <p class="error-text">{answer.error}</p>}
      {!isExact(hits) && (
        <p class="muted">
          Between points of the picture, which are rounded
          {coarse && ` and lie on a coarser level of detail, up to ${shortNumber(maxDeviation(hits))} away`}.
        </p>
      )}
      <Statement question={questionOf(measure)} database={model.database} />
    </li>
  );
}

function maxDeviation(hits: readonly Hit[]): number {
  return Math.max(...hits.map(({ deviation }) => deviation));
}
