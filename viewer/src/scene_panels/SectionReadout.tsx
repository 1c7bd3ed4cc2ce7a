import type { Vec3 } from "../scene";
import { shortNumber } from "./fields";
import { useAnswers, useSceneState } from "./hooks";
import type { SceneModel } from "./scene_model";
import type { SectionControl } from "./section_control";

interface Props {
  readonly model: SceneModel;
  /** Shows the settings of the section. */
  readonly onSettings: () => void;
}

/** Over the scene while a section is on: where it cuts, the exact area, and how it is moved. */
export function SectionReadout({ model, onSettings }: Props) {
  const { view, cuts } = model;
  const { section } = useSceneState(view, "section");
  useAnswers(model);
  if (!section.on || view.problem) return null;
  return (
    <div class="section-readout" data-testid="section-readout">
      <div class="row" role="status">
        <strong>{planeText(section.normal, section.point)}</strong>
        <span>{areaText(cuts)}</span>
        <button type="button" class="btn small" onClick={onSettings}>
          Settings of the section
        </button>
      </div>
      <span class="muted">
        {section.plane ? "Drag the handle of the plane" : "The handle of the plane is hidden"}
        <span class="with-keys">
          ; <kbd>Page Up</kbd> and <kbd>Page Down</kbd> move it
        </span>
      </span>
    </div>
  );
}

/** The plane as an equation. */
function planeText(normal: Vec3, point: Vec3): string {
  const axis = normal.findIndex((part) => Math.abs(part) === 1);
  if (axis >= 0) return `Section ${"xyz"[axis]} = ${shortNumber(point[axis]!)}`;
  return `Section across (${normal.map(shortNumber).join(", ")})`;
}

function areaText({ cuts, busy }: SectionControl): string {
  if (busy) return "The database computes the exact cut …";
  if (cuts.length === 0) return "The plane meets no solid.";
  const areas = cuts.flatMap(({ area }) => (area === null ? [] : [area]));
  const failed = cuts.length - areas.length;
  const unknown = failed > 0 ? `, ${failed} could not be cut` : "";
  if (areas.length === 1 && failed === 0) return `area ${shortNumber(areas[0]!)}`;
  const sum = areas.reduce((total, area) => total + area, 0);
  return `${cuts.length} solids cut, sum of areas ${shortNumber(sum)}${unknown}`;
}
