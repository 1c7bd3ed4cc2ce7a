import { useEffect, useState } from "preact/hooks";

import type { CellRef, SceneView } from "../scene";
import { useSceneEvents, useSceneState } from "./hooks";

/** Objects that are read out; more would be no help. */
const kMostRead = 100;

/** What a scene tells to those who do not see it: the objects that are shown, and what was selected. */
export function SceneReader({ view }: { view: SceneView }) {
  useSceneEvents(view, "shapes", "selection");
  useSceneState(view, "appearance"); // names come with values of attributes
  const shown = view.shapes().filter(({ visible }) => visible);
  const isSelected = (cell: CellRef): boolean =>
    view.selection.some((other) => JSON.stringify(other) === JSON.stringify(cell));
  return (
    <div class="only-read">
      <ul aria-label={`${shown.length === 1 ? "1 object" : `${shown.length} objects`} in the scene`}>
        {shown.slice(0, kMostRead).map(({ cell, kind, triangles }) => (
          <li key={JSON.stringify(cell)}>
            {view.nameOf(cell)}, {kind}
            {triangles > 0 && `, ${triangles} triangles`}
            {isSelected(cell) && ", selected"}
          </li>
        ))}
        {shown.length > kMostRead && <li>and {shown.length - kMostRead} more</li>}
      </ul>
      <Announcement view={view} />
    </div>
  );
}

/** Says what was selected. */
function Announcement({ view }: { view: SceneView }) {
  const [text, setText] = useState("");
  useEffect(
    () =>
      view.on("selection", ({ cells }) => {
        const [first] = cells;
        if (!first) setText("Nothing is selected.");
        else if (cells.length === 1) setText(`${view.nameOf(first)}, row ${first.row + 1}, is selected.`);
        else setText(`${cells.length} objects are selected.`);
      }),
    [view],
  );
  return (
    <p role="status" data-testid="announcement">
      {text}
    </p>
  );
}
