import { effect, untracked } from "@preact/signals";
import { useState } from "preact/hooks";
import type { SceneView, Transformation } from "../../scene/api";
import { readBytes, shapeSource } from "../../state/shape_source";
import type { Store } from "../../state/store";
import { cellOf, chosenOf, type Side, type SideName, type Step } from "../../state/workbench";
import { transformation, vertexMove } from "../../state/workbench_operations";
import { useApp } from "../context";
import { SceneFrame } from "../SceneFrame";
import { FactsTable } from "./FactsTable";
import { Operations } from "./Operations";
import { SideHead } from "./SideHead";

/** One mesh with its scene, operations and statistics. */
export function CompareSide({ name }: { name: SideName }) {
  const { store, workspace } = useApp();
  const side = workspace.workbench.side(name);
  const [coming, setComing] = useState(false);
  const model = workspace.sideScenes[name].value;
  const busy = side.busy.value;
  return (
    <section
      class="compare-side"
      aria-label={name === "left" ? "Left mesh" : "Right mesh"}
      data-testid={`side-${name}`}
    >
      <SideHead side={side} />
      <SceneFrame
        label={`3D view of the ${name} mesh`}
        busy={coming}
        hint={!side.step.value && !busy ? "Choose a mesh for this side." : null}
        bind={(view) => bindSide(view, side, store, setComing)}
        onModel={(made) => (workspace.sideScenes[name].value = made)}
        told={(result) => side.step.value?.outcome.resultId === result}
        onFocus={() => (workspace.keySide.value = name)}
      />
      {busy && (
        <div class="running-line" role="status">
          <span class="spinner" aria-hidden="true" />
          <span class="grow ellipsis">{busy}</span>
          <button type="button" class="btn small danger" onClick={() => side.stop()}>
            Stop
          </button>
        </div>
      )}
      {side.error.value && (
        <p class="callout error" role="alert">
          {side.error.value}
        </p>
      )}
      {model && <Operations side={side} view={model.view} />}
      <FactsTable side={side} other={workspace.workbench.other(name)} />
    </section>
  );
}

const colors = { left: "#7fa3d4", right: "#d6a15b" } as const;

/**
 * Keeps a scene in step with a side: its mesh, the control mesh, the theme, what is dragged. Tells `onComing` whether
 * the mesh is still on its way.
 */
function bindSide(
  view: SceneView,
  side: Side,
  store: Store,
  onComing: (coming: boolean) => void,
): () => void {
  let seen = chosenOf(side.steps.peek());
  /** The camera moves for another mesh that was chosen, not for what is made from it. */
  const dropOld = () => {
    const step = side.step.peek();
    if (!step || !isDrawn(view, step)) return;
    const chosen = chosenOf(side.steps.peek());
    if (dropOldSteps(view, step) && chosen !== seen) view.fit();
    seen = chosen;
    onComing(false);
  };
  const ends = [
    effect(() => {
      const step = side.step.value;
      untracked(() => {
        showStep(view, step, side, store);
        onComing(step !== null && !isDrawn(view, step));
      });
    }),
    // After the view has decided about its camera.
    view.on("shapes", () => queueMicrotask(dropOld)),
    effect(() => void showControl(view, side, store)),
    effect(() => {
      void store.theme.current.value;
      untracked(() => view.themeChanged());
    }),
    view.on("vertex", ({ vertex, to, finished }) => {
      if (finished) void side.apply((type) => vertexMove(type, vertex, to));
    }),
    view.on("transform", ({ transformation: map }) => void transform(view, side, map)),
  ];
  return () => ends.forEach((end) => end());
}

async function transform(view: SceneView, side: Side, map: Transformation): Promise<void> {
  await side.apply(() => transformation(map));
  // What failed is taken back; what came out replaces what is seen.
  if (side.error.peek()) view.resetDrag();
}

/** Adds the mesh of a step; the one before it stays until this one is there. */
function showStep(view: SceneView, step: Step | null, side: Side, store: Store): void {
  if (!step) {
    for (const { result } of view.results) view.removeResult(result);
    return;
  }
  const cell = cellOf(step);
  if (!view.results.some(({ result }) => result === cell.result))
    view.addResult(shapeSource(store, step.outcome, cell.column, step.label));
  view.update({ overrides: [{ cell, color: colors[side.name] }] });
  const { drag } = view.state.tools;
  if (drag) view.update({ tools: { drag: { ...drag, cell } } });
}

/** Whether a scene has the mesh of a step. */
export function isDrawn(view: SceneView, step: Step): boolean {
  const { result, column } = cellOf(step);
  return view.shapes({ result, column }).length > 0;
}

/** Removes the meshes of other steps; whether there were any. */
function dropOldSteps(view: SceneView, step: Step): boolean {
  const old = view.results.filter(({ result }) => result !== cellOf(step).result);
  for (const { result } of old) view.removeResult(result);
  return old.length > 0;
}

async function showControl(view: SceneView, side: Side, store: Store): Promise<void> {
  const cell = side.control.value;
  view.setOverlay("control", null);
  if (!cell) return;
  try {
    const query = { column: cell.column, from: cell.row, count: 1 };
    const bytes = await readBytes(await store.client.shapes(cell.result, query));
    if (side.control.value !== cell) return;
    view.setOverlay("control", {
      bytes,
      style: { color: "#e8b95c", edgeColor: "#e8b95c", opacity: 0, edges: true },
    });
  } catch (error) {
    store.report(error, "The control mesh cannot be shown");
  }
}
