/** The page as one plain value: what was run, what is shown of it and how; and the way back from that value to the page. */

import { batch, effect, type ReadonlySignal } from "@preact/signals";
import type { SceneView } from "../scene/api";
import { takeUp } from "../state/kept_result";
import type { Outcome } from "../state/outcome";
import { makeView, parametersOf, sceneOf, type LinkStatement, type LinkView } from "../state/permalink";
import { foreignSteps, linkOf, restoreSides, type LinkCompare } from "../state/workbench_link";
import { cellOf, type Step } from "../state/workbench";
import { isDrawn } from "./compare/CompareSide";
import type { App } from "./context";

/** The present view. With `keep` it is for this browser: with its results and open panels. */
export function viewOf(app: App, keep: boolean): { view: LinkView; left: readonly Outcome[] } {
  const { store, workspace } = app;
  const { results, layout } = store;
  const { view, left, placeOf } = makeView({
    outcomes: results.list.value,
    activeKey: results.activeKey.value,
    selected: results.selected.value,
    editor: keep ? "" : (workspace.editor.value?.text ?? ""),
    scene: workspace.scene.value?.view.toJSON() ?? null,
    keep,
  });
  const open = {
    layout: {
      side: layout.sideOpen.value,
      bottom: layout.bottomOpen.value,
    },
  };
  const compare = store.mode.value === "compare" ? compareOf(workspace, placeOf, keep) : null;
  return { view: { ...view, ...(keep ? open : {}), ...(compare ? { compare } : {}) }, left };
}

function compareOf(
  { workbench, sideScenes, sameCamera }: App["workspace"],
  placeOf: (result: string) => number | null,
  keep: boolean,
): LinkCompare | null {
  const [left, right] = [sideScenes.left, sideScenes.right].map((scene) =>
    ownState(scene.value?.view.toJSON()),
  );
  return linkOf(workbench, placeOf, { left, right, sameCamera: sameCamera.value, keep });
}

/** Without the colours of objects, which the split screen gives by itself. */
function ownState(scene: unknown): unknown {
  return { ...(scene as object | undefined), overrides: [] };
}

/** The results of the statements of a view that are on this page or still on the server; null for the others. */
export async function knownOutcomes({ store }: App, view: LinkView): Promise<(Outcome | null)[]> {
  const { results, client } = store;
  const outcomes: (Outcome | null)[] = [];
  for (const statement of view.statements) {
    const { text, kept } = statement;
    const parameters = parametersOf(statement, idsOf(outcomes));
    const outcome = kept
      ? (results.ofResult(kept.id) ?? (await takeUp(client, text, parameters, kept).catch(() => null)))
      : null;
    outcomes.push(outcome);
  }
  return outcomes;
}

const idsOf = (outcomes: readonly (Outcome | null)[]): (string | null)[] =>
  outcomes.map((outcome) => outcome?.resultId ?? null);

/** The statements that have to be run for a view, given the results that are known. */
export function statementsToRun(
  { statements, compare }: LinkView,
  known: readonly (Outcome | null)[],
): readonly LinkStatement[] {
  const steps = compare ? foreignSteps(compare) : [];
  return [
    ...statements.filter((_, index) => !known[index]),
    ...steps.filter(({ kept }) => !kept).map(({ statement }) => ({ text: statement, shown: [] })),
  ];
}

/** Brings the page to a view. Statements whose results are not known are run again. */
export async function restoreView(
  app: App,
  view: LinkView,
  known: readonly (Outcome | null)[],
): Promise<void> {
  const { store, workspace } = app;
  if (view.editor) workspace.editor.value?.setText(view.editor);
  const outcomes: (Outcome | null)[] = [];
  for (const [index, statement] of view.statements.entries()) {
    const parameters = parametersOf(statement, idsOf(outcomes));
    outcomes.push(known[index] ?? (await store.run(statement.text, { parameters })));
  }
  batch(() => showOutcomes(store, view, outcomes));
  const { layout } = view;
  if (layout) {
    store.layout.sideOpen.value = layout.side;
    store.layout.bottomOpen.value = layout.bottom;
  }
  const ids = idsOf(outcomes);
  const scene = view.scene === null ? null : sceneOf(view.scene, ids);
  const ignored = scene === null ? [] : (workspace.scene.value?.view.restore(scene) ?? []);
  if (ignored.length)
    store.notices.add("info", "Parts of the view are unknown here.", { detail: ignored.join(", ") });
  store.mode.value = view.compare ? "compare" : "explore";
  if (view.compare) await restoreCompare(app, view.compare, ids);
}

/** Shows what the view shows of its outcomes, and nothing of others. */
function showOutcomes(
  { results }: App["store"],
  view: LinkView,
  outcomes: readonly (Outcome | null)[],
): void {
  for (const outcome of outcomes) if (outcome && !results.list.value.includes(outcome)) results.add(outcome);
  results.hideAll();
  outcomes.forEach((outcome, index) => {
    if (outcome) outcome.shown.value = new Set(view.statements[index]?.shown ?? []);
  });
  results.activeKey.value = outcomes[view.active]?.key ?? results.activeKey.value;
  const [place, row, column] = view.selected ?? [];
  const result = place === undefined ? null : outcomes[place]?.resultId;
  results.selected.value = result && row !== undefined ? { result, row, column: column ?? null } : null;
}

async function restoreCompare(
  { workspace }: App,
  link: LinkCompare,
  results: readonly (string | null)[],
): Promise<void> {
  const { workbench, sideScenes, sameCamera } = workspace;
  sameCamera.value = link.sameCamera;
  if (!(await restoreSides(workbench, link, results))) return;
  for (const name of ["right", "left"] as const) {
    const { view } = await valueOf(sideScenes[name]);
    const step = workbench.side(name).step.value;
    if (step) await drawn(view, step);
  }
  // The views have chosen cameras of their own for what came; those of the link replace them.
  for (const name of ["right", "left"] as const) {
    const scene = sideScenes[name].value?.view;
    const overrides = scene?.state.overrides ?? [];
    scene?.restore(link[name].scene);
    scene?.update({ overrides });
  }
}

/** The value of a signal as soon as it has one. */
function valueOf<T>(source: ReadonlySignal<T | null>): Promise<T> {
  return new Promise((resolve) => {
    const end = effect(() => {
      const { value } = source;
      if (value !== null)
        queueMicrotask(() => {
          end();
          resolve(value);
        });
    });
  });
}

/** Waits until a scene shows the mesh of a step, or cannot; what it showed before does not count. */
function drawn(scene: SceneView, step: Step): Promise<void> {
  const { result } = cellOf(step);
  const hasFailed = () =>
    scene.problem !== null ||
    scene.progress.some((progress) => progress.result === result && /failed|stopped/.test(progress.phase));
  return new Promise((resolve) => {
    const ends = [scene.on("shapes", look), scene.on("problem", look), scene.on("progress", look)];
    function look(): void {
      if (!isDrawn(scene, step) && !hasFailed()) return;
      ends.forEach((end) => end());
      setTimeout(resolve);
    }
    look();
  });
}
