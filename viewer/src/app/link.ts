import { effect, signal, type ReadonlySignal } from "@preact/signals";
import { messageOf } from "../api/errors";
import { titleOf, type Outcome } from "../state/outcome";
import type { SceneView } from "../scene/api";
import { isHarmless } from "../state/link_consent";
import { decodeView, encodeView, makeView, parametersOf, sceneOf, type LinkView } from "../state/permalink";
import { foreignStatements, linkOf, restoreSides, type LinkCompare } from "../state/workbench_link";
import { cellOf, type Step } from "../state/workbench";
import { isDrawn } from "./compare/CompareSide";
import type { App } from "./context";

const prefix = "#view=";

/** A view that waits for a person's consent, because its statements were never run in this browser. */
export const pendingLink = signal<LinkView | null>(null);

/** Puts a link to the present view into the address and the clipboard. */
export async function copyLink({ store, workspace }: App): Promise<void> {
  const { results, notices } = store;
  const { view, left, placeOf } = makeView(
    results.list.value,
    results.activeKey.value,
    results.selected.value,
    workspace.editor.value?.text ?? "",
    workspace.scene.value?.toJSON() ?? null,
  );
  const compare = store.mode.value === "compare" ? compareLink(workspace, placeOf) : null;
  const hash = prefix + (await encodeView(compare ? { ...view, compare } : view));
  history.replaceState(null, "", hash);
  const detail = left.length ? `Without ${left.map(({ statement }) => titleOf(statement)).join(", ")}.` : "";
  try {
    await navigator.clipboard.writeText(location.href);
    notices.add("success", "The link to this view is copied.", { detail });
  } catch {
    notices.add("info", "The address of this page is now the link to this view.", { detail });
  }
}

function compareLink(
  { workbench, sideScenes, sameCamera }: App["workspace"],
  placeOf: (result: string) => number | null,
): LinkCompare | null {
  const [left, right] = [sideScenes.left, sideScenes.right].map((scene) => ownState(scene.value?.toJSON()));
  return linkOf(workbench, placeOf, { left, right, sameCamera: sameCamera.value });
}

/** Without the colours of objects, which the split screen gives by itself. */
function ownState(scene: unknown): unknown {
  return { ...(scene as object | undefined), overrides: [] };
}

/** Restores the view of a link. Statements that were never run here wait for consent, since a link may come from anyone. */
export async function openLink(app: App, hash: string): Promise<void> {
  if (!hash.startsWith(prefix)) return;
  let view: LinkView;
  try {
    view = await decodeView(hash.slice(prefix.length));
  } catch (error) {
    app.store.notices.add("error", messageOf(error));
    return;
  }
  if (needsNoConsent(app, view)) await restoreView(app, view);
  else pendingLink.value = view;
}

/** The statements of a link that may do anything. */
export function statementsOf({ statements, compare }: LinkView): readonly string[] {
  return [...statements.map(({ text }) => text), ...(compare ? foreignStatements(compare) : [])];
}

function needsNoConsent({ store }: App, { statements, compare }: LinkView): boolean {
  const { catalogue, history } = store;
  const known = {
    objects: catalogue.objects.value,
    operators: catalogue.operators.value,
    knows: (text: string) => history.knows(text),
  };
  const foreign = (compare ? foreignStatements(compare) : []).map((text) => ({ text, shown: [] }));
  return [...statements, ...foreign].every((statement) => isHarmless(statement, known));
}

/** Runs the statements of a view and brings back what was shown. */
export async function restoreView(app: App, view: LinkView): Promise<void> {
  const { store, workspace } = app;
  const { results } = store;
  pendingLink.value = null;
  results.closeAll();
  if (view.editor) workspace.editor.value?.setText(view.editor);
  const outcomes: (Outcome | null)[] = [];
  for (const statement of view.statements) {
    const ids = outcomes.map((outcome) => outcome?.resultId ?? null);
    outcomes.push(await store.run(statement.text, { parameters: parametersOf(statement, ids) }));
  }
  outcomes.forEach((outcome, index) => {
    if (outcome) outcome.shown.value = new Set(view.statements[index]?.shown ?? []);
  });
  const active = outcomes[view.active];
  if (active) results.activeKey.value = active.key;
  const [place, row, column] = view.selected ?? [];
  const result = place === undefined ? null : outcomes[place]?.resultId;
  if (result && row !== undefined) results.selected.value = { result, row, column: column ?? null };
  const ids = outcomes.map((outcome) => outcome?.resultId ?? null);
  const scene = view.scene === null ? null : sceneOf(view.scene, ids);
  const ignored = scene === null ? [] : (workspace.scene.value?.restore(scene) ?? []);
  if (ignored.length)
    store.notices.add("info", "Parts of the view are unknown here.", { detail: ignored.join(", ") });
  if (view.compare) await restoreCompare(app, view.compare, ids);
}

async function restoreCompare(
  { store, workspace }: App,
  link: LinkCompare,
  results: readonly (string | null)[],
): Promise<void> {
  const { workbench, sideScenes, sameCamera } = workspace;
  store.mode.value = "compare";
  sameCamera.value = link.sameCamera;
  if (!(await restoreSides(workbench, link, results))) return;
  for (const name of ["right", "left"] as const) {
    const scene = await valueOf(sideScenes[name]);
    const step = workbench.side(name).step.value;
    if (step) await drawn(scene, step);
  }
  // The views have chosen cameras of their own for what came; those of the link replace them.
  for (const name of ["right", "left"] as const) {
    const scene = sideScenes[name].value;
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
    scene.progress.some((progress) => progress.result === result && progress.phase === "failed");
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
