import { useEffect, useState } from "preact/hooks";

import type { Hit, Legend, SceneView } from "../scene";
import { shortNumber } from "./fields";
import { useSceneEvents, useSceneState } from "./hooks";

/** What lies over the scene: the legend of colours, and the coordinates under the pointer. */
export function SceneOverlay({ view }: { view: SceneView }) {
  const { display } = useSceneState(view, "display", "appearance");
  useSceneEvents(view, "shapes");
  const { legend } = view;
  return (
    <>
      {display.legend && legend && <LegendBox legend={legend} />}
      <PointerReadout view={view} />
    </>
  );
}

function LegendBox({ legend }: { legend: Legend }) {
  return (
    <div class="legend" data-testid="legend">
      <strong>{legend.attribute}</strong>
      {legend.kind === "numbers" ? (
        <>
          <div
            class="legend-gradient"
            style={{ background: `linear-gradient(to right, ${legend.stops.join(", ")})` }}
            aria-hidden="true"
          />
          <div class="legend-ends">
            <span>{shortNumber(legend.min)}</span>
            <span>{shortNumber(legend.max)}</span>
          </div>
          {legend.undefinedCount > 0 && <span class="muted">{legend.undefinedCount} undefined</span>}
        </>
      ) : (
        <ul class="list">
          {legend.entries.map(({ label, color, count }) => (
            <li key={label}>
              <span class="swatch" style={{ background: color }} aria-hidden="true" />
              <span class="grow ellipsis">{label}</span>
              <span class="muted">{count}</span>
            </li>
          ))}
          {legend.others > 0 && <li class="muted">grey: {legend.others} with other values</li>}
        </ul>
      )}
    </div>
  );
}

function PointerReadout({ view }: { view: SceneView }) {
  const [hit, setHit] = useState<Hit | null>(null);
  useEffect(() => view.on("hover", ({ hit: found }) => setHit(found)), [view]);
  if (!hit) return null;
  const what =
    hit.snap === "vertex" && hit.vertex !== null
      ? `vertex ${hit.vertex}`
      : hit.snap === "point" && hit.vertex !== null
        ? `point ${hit.vertex}`
        : hit.face !== null
          ? `triangle ${hit.face}`
          : "";
  return (
    <div class="pointer-readout" data-testid="pointer-readout">
      {hit.point.map((part, axis) => (
        <span key={axis}>
          {"xyz"[axis]} {shortNumber(part)}
        </span>
      ))}
      <span class="muted">
        row {hit.cell.row + 1} {what}
      </span>
    </div>
  );
}
