import { measureInfo, questionOf } from "../scene";
import type { Hit } from "../scene";
import { shortNumber } from "./fields";
import { useAnswers, useSceneState } from "./hooks";
import { MeasureChoice, measureHint } from "./MeasurePanel";
import { textOf } from "./measure_control";
import type { SceneModel } from "./scene_model";
import { Statement } from "./Statement";

interface Props {
  readonly model: SceneModel;
  /** Shows the panel of the tool. */
  readonly onSettings: (part: "measure" | "inspect") => void;
}

/** Over the scene while a tool waits for clicks: what to click, what came of it, and how it ends. */
export function ToolReadout({ model, onSettings }: Props) {
  const { view } = model;
  const { tool } = useSceneState(view, "tools").tools;
  useAnswers(model);
  if (view.problem || (tool !== "measure" && tool !== "inspect")) return null;
  return (
    <div class="tool-readout" data-testid="tool-readout">
      {tool === "measure" ? <Measuring model={model} /> : <Inspecting hit={model.measures.inspected} />}
      <div class="row">
        <span class="muted">
          <kbd>Esc</kbd> ends
        </span>
        <button type="button" class="btn small" onClick={() => onSettings(tool)}>
          {tool === "measure" ? "All measures" : "All about it"}
        </button>
      </div>
    </div>
  );
}

function Measuring({ model }: { model: SceneModel }) {
  const { tools } = model.view.state;
  const last = model.measures.shown.at(-1);
  const answer = last && model.measures.answerOf(last);
  return (
    <>
      <MeasureChoice model={model} />
      <span role="status">{measureHint(tools)}</span>
      {last && answer && (
        <>
          <strong role="status">
            {measureInfo(last.kind).title}: {textOf(last, answer) || (answer.error ?? "…")}
          </strong>
          <Statement question={questionOf(last)} database={model.database} />
        </>
      )}
    </>
  );
}

function Inspecting({ hit }: { hit: Hit | null }) {
  if (!hit) return <span role="status">Click a triangle, vertex or point.</span>;
  const what = hit.snap === "vertex" ? `Vertex ${hit.vertex ?? ""}` : `Triangle ${hit.face ?? ""}`;
  return (
    <strong role="status">
      {what} of row {hit.cell.row + 1}, at {hit.point.map(shortNumber).join(", ")}
    </strong>
  );
}
