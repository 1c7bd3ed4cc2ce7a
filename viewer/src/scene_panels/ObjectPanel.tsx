import { componentsOf, overridden } from "../scene";
import type { CellRef, Database, ObjectOverride, SceneView, ShapeInfo } from "../scene";
import { ColorField, Section, shortNumber, Slider } from "./fields";
import { useSceneEvents, useSceneState } from "./hooks";

interface Props {
  readonly view: SceneView;
  readonly database: Database;
}

/** Colour, size and opacity of the selected objects, and what is known of them. */
export function ObjectPanel({ view, database }: Props) {
  const { overrides, appearance } = useSceneState(view, "overrides", "appearance");
  useSceneEvents(view, "selection", "shapes");
  const cells = view.selection;
  if (cells.length === 0) {
    return (
      <Section title="Selected object" testId="object-panel">
        <p class="muted">Click an object to see and change its properties.</p>
      </Section>
    );
  }
  const first = cells[0]!;
  const known = overrides.find(({ cell }) => JSON.stringify(cell) === JSON.stringify(first));
  const set = (change: Omit<Partial<ObjectOverride>, "cell">): void =>
    view.update({ overrides: overridden(overrides, cells, change) });
  const reset = (): void =>
    view.update({
      overrides: overridden(overrides, cells, { color: undefined, pointSize: undefined, opacity: undefined }),
    });
  const info = view.shape(first);
  const title = cells.length === 1 ? "Selected object" : `${cells.length} selected objects`;
  return (
    <Section title={title} testId="object-panel">
      {info && cells.length === 1 && <Facts info={info} />}
      {cells.length === 1 && <Questions database={database} cell={first} />}
      <ColorField
        label="Colour"
        value={known?.color ?? appearance.color}
        onChange={(color) => set({ color })}
      />
      <Slider
        label="Opacity"
        value={known?.opacity ?? appearance.opacity}
        min={0}
        max={1}
        step={0.05}
        format={(value) => `${Math.round(value * 100)} %`}
        onChange={(opacity) => set({ opacity })}
      />
      <Slider
        label="Point size"
        value={known?.pointSize ?? appearance.pointSize}
        min={1}
        max={30}
        step={1}
        format={(value) => `${value} px`}
        onChange={(pointSize) => set({ pointSize })}
      />
      <div class="row">
        <button type="button" class="btn small" onClick={() => view.fit(cells)}>
          Fit
        </button>
        <button type="button" class="btn small" onClick={() => view.act("hide")}>
          Hide
        </button>
        <button type="button" class="btn small" onClick={() => view.act("isolate")}>
          Show only
        </button>
        <button type="button" class="btn small" onClick={() => view.act("ghost")}>
          Ghost others
        </button>
        <button type="button" class="btn small" onClick={() => view.act("show.all")}>
          Show all
        </button>
        <button type="button" class="btn small" disabled={!known} onClick={reset}>
          Reset to default
        </button>
        {info && isDivisible(info) && (
          <button type="button" class="btn small" onClick={() => showComponents(view, database)}>
            Split into components
          </button>
        )}
      </div>
    </Section>
  );
}

function Questions({ database, cell }: { database: Database; cell: CellRef }) {
  const questions = database.questions(cell);
  if (questions.length === 0) return null;
  return (
    <div class="row">
      {questions.map(({ label, ask }) => (
        <button key={label} type="button" class="btn small" onClick={ask}>
          {label}
        </button>
      ))}
    </div>
  );
}

function Facts({ info }: { info: ShapeInfo }) {
  const { box } = info;
  return (
    <dl class="facts">
      <dt>Type</dt>
      <dd>{info.kind}</dd>
      <dt>Row</dt>
      <dd>{info.cell.row + 1}</dd>
      {info.triangles > 0 && (
        <>
          <dt>Triangles</dt>
          <dd>
            {info.triangles.toLocaleString("en")}
            {info.shown < info.triangles && ` (shown: ${info.shown.toLocaleString("en")})`}
          </dd>
        </>
      )}
      {info.deviation > 0 && (
        <>
          <dt>Deviation</dt>
          <dd>up to {shortNumber(info.deviation)}</dd>
        </>
      )}
      {box && (
        <>
          <dt>Box</dt>
          <dd>
            {["x", "y", "z"].map((axis, i) => (
              <div key={axis}>
                {axis} {shortNumber(box[2 * i]!)} … {shortNumber(box[2 * i + 1]!)}
              </div>
            ))}
          </dd>
          <dt>Size</dt>
          <dd>{[0, 2, 4].map((i) => shortNumber(box[i + 1]! - box[i]!)).join(" × ")}</dd>
        </>
      )}
    </dl>
  );
}

function isDivisible({ kind }: ShapeInfo): boolean {
  return kind === "volume3d" || kind === "surface3d";
}

/** Shows the components of the selected object as a result of their own, in its place. */
function showComponents(view: SceneView, database: Database): void {
  const cell = view.selection[0];
  if (!cell) return;
  const { statement, parameters } = componentsOf(cell);
  view.setVisible(cell, false);
  view.select([]);
  database.show(statement, parameters);
}
