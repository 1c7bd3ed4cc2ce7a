import { facingEye, isRegionExact, regionAxes } from "../scene";
import type { Database, SectionState, ShapeInfo, Vec3 } from "../scene";
import { Check, ColorField, NumberField, Section, shortNumber, Slider, VectorField } from "./fields";
import { useAnswers, useSceneEvents, useSceneState } from "./hooks";
import type { SceneModel } from "./scene_model";
import { Statement } from "./Statement";
import type { SectionControl } from "./section_control";

const kAxes = [
  { id: "X", normal: [1, 0, 0] },
  { id: "Y", normal: [0, 1, 0] },
  { id: "Z", normal: [0, 0, 1] },
] as const;

/** The section plane: its place, the exact cut, its area and its region. */
export function SectionPanel({ model }: { model: SceneModel }) {
  const { view, database, cuts } = model;
  const { section } = useSceneState(view, "section");
  useSceneEvents(view, "shapes");
  useAnswers(model);
  const range = rangeOf(view.shapes(), section.normal);
  const offset = dot(section.point, section.normal);
  const set = (change: Partial<SectionState>): void =>
    view.update({ section: { ...change, cap: "preview" } });
  const moveTo = (value: number): void => set({ point: alongNormal(section, value - offset) });
  return (
    <Section title="Section" open={false} testId="section-panel" inUse={section.on}>
      <Check label="Section plane" checked={section.on} onChange={() => view.act("section")} />
      {section.on && (
        <>
          <div class="field">
            <span>Normal</span>
            <div class="btn-group" role="group" aria-label="Direction of the plane">
              {kAxes.map(({ id, normal }) => (
                <button
                  key={id}
                  type="button"
                  class="btn small"
                  aria-pressed={isAlong(section.normal, normal)}
                  onClick={() => set({ normal: facingEye(normal, view.state.camera.direction) })}
                >
                  {id}
                </button>
              ))}
              <button
                type="button"
                class="btn small"
                onClick={() => set({ normal: flipped(section.normal) })}
              >
                Flip
              </button>
            </div>
          </div>
          <Slider
            label="Position"
            value={offset}
            min={range.min}
            max={range.max}
            step={(range.max - range.min) / 500 || 1}
            onChange={moveTo}
          />
          <NumberField label="Position" value={offset} onChange={moveTo} />
          <VectorField
            label="Normal"
            value={section.normal}
            onChange={(normal) => {
              if (normal.some((part) => part !== 0)) set({ normal });
            }}
          />
          <ColorField
            label="Cut"
            value={section.capColor}
            onChange={(capColor) => view.update({ section: { capColor } })}
          />
          <Check
            label="Show the plane"
            checked={section.plane}
            onChange={(plane) => view.update({ section: { plane } })}
          />
          <p class="muted">Drag the handle of the plane; with Shift it tilts.</p>
          <Cuts control={cuts} database={database} normal={section.normal} />
        </>
      )}
    </Section>
  );
}

function Cuts({ control, database, normal }: { control: SectionControl; database: Database; normal: Vec3 }) {
  const { cuts, busy, skipped } = control;
  const areas = cuts.map(({ area }) => area).filter((area) => area !== null);
  return (
    <div class="cuts" aria-live="polite" data-testid="cuts">
      {busy && <p class="muted">The database computes the exact cut …</p>}
      {!busy && cuts.length === 0 && <p class="muted">The plane meets no solid.</p>}
      {cuts.length > 1 && !busy && (
        <p>
          {cuts.length} solids cut, sum of areas {shortNumber(areas.reduce((sum, area) => sum + area, 0))}
        </p>
      )}
      {skipped > 0 && <p class="muted">{skipped} smaller solids are cut by the graphics card only.</p>}
      <ul class="list">
        {cuts.map((cut) => (
          <li key={JSON.stringify(cut.cell)} class="cut">
            <div class="field">
              <span>Area, row {cut.cell.row + 1}</span>
              {cut.area !== null && <strong data-testid="cut-area">{cut.area}</strong>}
              <button
                type="button"
                class="btn small"
                title={`${cut.regionQuestion.statement}\n${axesText(normal)}`}
                onClick={() => database.show(cut.regionQuestion.statement, cut.regionQuestion.parameters)}
              >
                As region
              </button>
            </div>
            {cut.error && <p class="error-text">{cut.error}</p>}
            <Statement question={cut.areaQuestion} database={database} />
          </li>
        ))}
      </ul>
      {cuts.length > 0 && (
        <p class="muted" data-testid="region-axes">
          {axesText(normal)}
        </p>
      )}
      {cuts.length > 0 && !isRegionExact(normal) && (
        <p class="muted">
          A region lies in the plane of x and y; for a plane that is not at right angles to an axis, the solid
          is turned by an angle within 2⁻⁵⁰ rad first. The area is that of the exact cut.
        </p>
      )}
    </div>
  );
}

/** Which directions of space the axes of a region are. */
function axesText(normal: Vec3): string {
  const [u, v] = regionAxes(normal);
  const text = (axis: Vec3): string => `(${axis.map((part) => shortNumber(part)).join(", ")})`;
  return `As a region: x is the direction ${text(u)}, y is ${text(v)}.`;
}

function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** The point moved along the normal so that its product with the normal grows by `change`. */
function alongNormal({ point, normal }: SectionState, change: number): Vec3 {
  const factor = change / dot(normal, normal);
  return [point[0] + normal[0] * factor, point[1] + normal[1] * factor, point[2] + normal[2] * factor];
}

/** In one of both directions. */
function isAlong(a: Vec3, b: Vec3): boolean {
  return Math.abs(dot(a, b)) === 1;
}

function flipped(normal: Vec3): Vec3 {
  return [0 - normal[0], 0 - normal[1], 0 - normal[2]];
}

/** From where to where the plane meets the boxes of visible objects. */
function rangeOf(shapes: readonly ShapeInfo[], normal: Vec3): { min: number; max: number } {
  let [min, max] = [Infinity, -Infinity];
  for (const { box, visible, offset } of shapes) {
    if (!box || !visible) continue;
    for (let corner = 0; corner < 8; corner++) {
      const at = [0, 1, 2].map((axis) => box[2 * axis + ((corner >> axis) & 1)]! + offset[axis]!);
      const value = dot(at as unknown as Vec3, normal);
      min = Math.min(min, value);
      max = Math.max(max, value);
    }
  }
  return min <= max ? { min, max } : { min: -1, max: 1 };
}
