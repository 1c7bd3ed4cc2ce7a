import { effect, untracked } from "@preact/signals";
import type { CellRef, SceneView } from "../scene/api";
import { shapeSource } from "../state/shape_source";
import type { Results } from "../state/results";
import type { Outcome } from "../state/outcome";
import type { App } from "./context";

/** Keeps a scene in step with the results: what is shown, what is selected, the theme. Returns what ends this. */
export function bindScene(view: SceneView, app: App): () => void {
  const { store, workspace } = app;
  const { results, theme } = store;
  const ends = [
    effect(() => showResults(view, results.list.value, store)),
    effect(() => {
      const cells = selectedCells(app);
      untracked(() => {
        if (!sameCells(cells, view.selection)) view.select(cells, { reveal: true });
      });
    }),
    effect(() => {
      void theme.current.value;
      untracked(() => view.themeChanged());
    }),
    view.on("selection", ({ cells }) => {
      if (
        !sameCells(
          cells,
          untracked(() => selectedCells(app)),
        )
      )
        results.select(cells[0] ?? null);
    }),
    view.on("shapes", () => takeVisibility(view, results)),
    view.on("open", ({ hit }) => workspace.openProperties(hit.cell)),
  ];
  return () => ends.forEach((end) => end());
}

/** Adds, removes, shows and hides columns. A column is added when it is shown for the first time. */
function showResults(view: SceneView, outcomes: readonly Outcome[], store: App["store"]): void {
  const wanted = new Map<string, { outcome: Outcome; shown: ReadonlySet<string> }>();
  for (const outcome of outcomes)
    if (outcome.resultId !== null) wanted.set(outcome.resultId, { outcome, shown: outcome.shown.value });
  untracked(() => {
    for (const result of new Set(view.results.map((source) => source.result)))
      if (!wanted.has(result)) view.removeResult(result);
    // What goes is hidden before the others come: they are alone, and have the colour of what is alone.
    for (const { result, column } of view.results)
      if (!wanted.get(result)?.shown.has(column)) view.setVisible({ result, column }, false);
    for (const [result, { outcome, shown }] of wanted)
      for (const column of shown) {
        const isThere = view.results.some((source) => source.result === result && source.column === column);
        if (isThere) view.setVisible({ result, column }, true);
        else view.addResult(shapeSource(store, outcome, column));
      }
  });
}

/** Takes over what was shown or hidden within the view, as by its shortcuts. */
function takeVisibility(view: SceneView, results: Results): void {
  for (const { result, column } of view.results) {
    const outcome = results.ofResult(result);
    if (!outcome) continue;
    const visible = view.isVisible({ result, column });
    if (outcome.shown.peek().has(column) !== visible) results.show(outcome, visible, column);
  }
}

/** The shapes of the selected row: those of its column, or all that are shown. */
function selectedCells({ store: { results } }: App): readonly CellRef[] {
  const selected = results.selected.value;
  const outcome = selected ? results.ofResult(selected.result) : null;
  if (!selected || !outcome) return [];
  const { result, row, column } = selected;
  if (column !== null) return [{ result, row, column }];
  return [...outcome.shown.value].map((shape) => ({ result, row, column: shape }));
}

function sameCells(a: readonly CellRef[], b: readonly CellRef[]): boolean {
  const key = ({ result, row, column }: CellRef) => `${result}/${row}/${column}`;
  const keys = new Set(a.map(key));
  return a.length === b.length && b.every((cell) => keys.has(key(cell)));
}
