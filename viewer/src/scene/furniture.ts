/** What helps to find one's way: axes in the corner, scale bar, grid with its numbers, boxes of objects. */

import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Vector3,
} from "three";

import type { CameraState, Vec3 } from "./api";
import { basisOf } from "./camera";
import type { Overlay } from "./overlay";
import type { Projector, Size } from "./projection";
import { formatStep, multiples, roundStep } from "./steps";
import type { SceneTheme } from "./theme";
import { fromVector3, toVector3 } from "./vec";

export const kAxisColors = ["#e5484d", "#3aa655", "#3d7dd8"] as const;
const kAxisLength = 30;
const kAxisMargin = 46;

/** Three arrows in the lower left corner; those that point away from the eye are drawn first. */
export function drawAxes(overlay: Overlay, camera: CameraState, height: number): void {
  const basis = basisOf(camera);
  const centre = [kAxisMargin, height - kAxisMargin] as const;
  const axes = [0, 1, 2].map((axis) => {
    const unit = new Vector3().setComponent(axis, 1);
    return { axis, x: unit.dot(basis.right), y: unit.dot(basis.up), depth: unit.dot(basis.back) };
  });
  axes.sort((a, b) => a.depth - b.depth);
  for (const { axis, x, y } of axes) {
    const color = kAxisColors[axis]!;
    const end = [centre[0] + x * kAxisLength, centre[1] - y * kAxisLength] as const;
    overlay.line(centre, end, color, 2.5);
    overlay.text("XYZ"[axis]!, centre[0] + x * (kAxisLength + 10), centre[1] - y * (kAxisLength + 10), {
      color,
      bold: true,
    });
  }
}

const leastScaleBar = (width: number) => Math.min(120, width / 5);

/** A bar of a round length; with perspective it holds at the distance of the target. */
export function drawScaleBar(
  overlay: Overlay,
  camera: CameraState,
  projector: Projector,
  theme: SceneTheme,
): void {
  const { width, height } = projector.size;
  const unit = camera.height / height;
  const length = roundStep(unit * leastScaleBar(width));
  const pixels = length / unit;
  const [right, y] = [width - 20, height - 22];
  const left = right - pixels;
  overlay.line([left, y], [right, y], theme.text, 1.5);
  overlay.line([left, y - 4], [left, y + 4], theme.text, 1.5);
  overlay.line([right, y - 4], [right, y + 4], theme.text, 1.5);
  overlay.text(formatStep(length, length), (left + right) / 2, y - 11, { color: theme.text });
}

const kMaxLines = 120;

/** A grid of round coordinates, horizontal at the foot of the objects, or at right angles to the sight along an axis. */
export class Grid {
  readonly group = new Group();
  private readonly fine = gridLines(0.45);
  private readonly coarse = gridLines(1);
  private key = "";
  private numbers: { from: Vec3; to: Vec3; text: string }[] = [];

  constructor() {
    this.group.add(this.fine, this.coarse);
  }

  /** Makes the lines anew if the step or the place changed. */
  update(camera: CameraState, box: Box3, theme: SceneTheme): void {
    // A coordinate is a multiple of the step, which doubles must resolve.
    const farthest = Math.max(...camera.target.map(Math.abs));
    const step = roundStep(Math.max(camera.height / 24, 2 ** -48 * farthest));
    const axis = gridAxis(camera);
    const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    const level = box.isEmpty() ? 0 : box.min.getComponent(axis);
    const around = box.isEmpty()
      ? new Box3().setFromCenterAndSize(toVector3(camera.target), new Vector3())
      : box;
    const range = (direction: number): [number, number] => {
      const margin = Math.max(camera.height * 0.4, step * 2);
      const centre = camera.target[direction]!;
      const reach = (kMaxLines / 2) * step;
      const low = Math.max(around.min.getComponent(direction) - margin, centre - reach);
      const high = Math.min(around.max.getComponent(direction) + margin, centre + reach);
      return [Math.floor(low / (5 * step)) * 5 * step, Math.ceil(high / (5 * step)) * 5 * step];
    };
    const ranges = { u: range(u), v: range(v) };
    const key = JSON.stringify([step, axis, level, ranges, theme.grid]);
    if (key === this.key) return;
    this.key = key;
    this.build({ step, axis, u, v, level, ranges }, theme);
  }

  private build(
    grid: {
      step: number;
      axis: number;
      u: number;
      v: number;
      level: number;
      ranges: { u: [number, number]; v: [number, number] };
    },
    theme: SceneTheme,
  ): void {
    const { step, axis, u, v, level, ranges } = grid;
    const origin = new Vector3()
      .setComponent(axis, level)
      .setComponent(u, ranges.u[0])
      .setComponent(v, ranges.v[0]);
    this.group.position.copy(origin);
    const lines: { fine: number[]; coarse: number[] } = { fine: [], coarse: [] };
    this.numbers = [];
    const add = (
      along: number,
      across: number,
      from: [number, number],
      values: number[],
      base: number,
    ): void => {
      for (const value of values) {
        const major = Math.round(value / step) % 5 === 0;
        const start = new Vector3().setComponent(across, value - base);
        const end = start.clone().setComponent(along, from[1] - from[0]);
        (major ? lines.coarse : lines.fine).push(...start.toArray(), ...end.toArray());
        if (!major) continue;
        const first = start
          .clone()
          .add(origin)
          .setComponent(along, from[0] - step * 0.8);
        const last = end.clone().add(origin);
        this.numbers.push({
          from: fromVector3(first),
          to: fromVector3(last),
          text: `${"xyz"[across]} ${formatStep(value, step)}`,
        });
      }
    };
    add(v, u, ranges.v, multiples(ranges.u[0], ranges.u[1], step, 2 * kMaxLines), ranges.u[0]);
    add(u, v, ranges.u, multiples(ranges.v[0], ranges.v[1], step, 2 * kMaxLines), ranges.v[0]);
    setLines(this.fine, lines.fine, theme.grid);
    setLines(this.coarse, lines.coarse, theme.grid);
  }

  drawNumbers(overlay: Overlay, projector: Projector, theme: SceneTheme): void {
    const taken: { x: number; y: number }[] = [];
    for (const { from, to, text } of this.numbers) {
      const [a, b] = [projector.project(from), projector.project(to)];
      const place = a.visible && b.visible ? entryPoint(a, b, projector.size, 20) : null;
      if (!place || isInCorner(place, projector.size)) continue;
      if (taken.some((other) => Math.hypot(other.x - place.x, (other.y - place.y) * 2) < 36)) continue;
      taken.push(place);
      // On a plate, so that it can be read over objects.
      overlay.text(text, place.x, place.y, { color: theme.muted, plate: theme.plate });
    }
  }

  dispose(): void {
    for (const lines of [this.fine, this.coarse]) {
      lines.geometry.dispose();
      lines.material.dispose();
    }
  }
}

interface Place {
  readonly x: number;
  readonly y: number;
}

/** Whether a text at this place would lie over the axes or the scale bar. */
export function isInCorner({ x, y }: Place, { width, height }: Size): boolean {
  const isAtAxes = x < 2 * kAxisMargin + 20 && y > height - 2 * kAxisMargin - 10;
  // Round lengths grow by 2.5 at most.
  const isAtScaleBar = x > width - 2.5 * leastScaleBar(width) - 40 && y > height - 50;
  return isAtAxes || isAtScaleBar;
}

/** Where the segment from a to b comes into the view without its border, or null if it does not. */
export function entryPoint(a: Place, b: Place, size: Size, border: number): Place | null {
  let [first, last] = [0, 1];
  for (const [start, change, limit] of [
    [a.x, b.x - a.x, size.width],
    [a.y, b.y - a.y, size.height],
  ] as const) {
    if (change === 0) {
      if (start < border || start > limit - border) return null;
      continue;
    }
    const ends = [(border - start) / change, (limit - border - start) / change];
    first = Math.max(first, Math.min(...ends));
    last = Math.min(last, Math.max(...ends));
  }
  return first <= last ? { x: a.x + first * (b.x - a.x), y: a.y + first * (b.y - a.y) } : null;
}

/** The axis at right angles to the grid: z, unless the sight is nearly along x or y. */
function gridAxis(camera: CameraState): 0 | 1 | 2 {
  const { back } = basisOf(camera);
  if (Math.abs(back.x) > 0.99) return 0;
  if (Math.abs(back.y) > 0.99) return 1;
  return 2;
}

function gridLines(opacity: number): LineSegments<BufferGeometry, LineBasicMaterial> {
  const material = new LineBasicMaterial({ transparent: true, opacity, depthWrite: false });
  const lines = new LineSegments(new BufferGeometry(), material);
  lines.frustumCulled = false;
  lines.renderOrder = -3;
  return lines;
}

export function setLines(
  lines: LineSegments<BufferGeometry, LineBasicMaterial>,
  coordinates: readonly number[] | Float32Array,
  color: string,
): void {
  lines.geometry.dispose();
  lines.geometry = new BufferGeometry();
  lines.geometry.setAttribute("position", new BufferAttribute(Float32Array.from(coordinates), 3));
  lines.material.color.set(color);
}

const kBoxEdges = [0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7];

/** The edges of boxes, as coordinates relative to `origin`. */
export function boxLines(boxes: Iterable<Box3>, origin: Vector3): number[] {
  const coordinates: number[] = [];
  for (const box of boxes) {
    if (box.isEmpty()) continue;
    const { min, max } = box;
    for (const corner of kBoxEdges) {
      coordinates.push(
        (corner & 1 ? max.x : min.x) - origin.x,
        (corner & 2 ? max.y : min.y) - origin.y,
        (corner & 4 ? max.z : min.z) - origin.z,
      );
    }
  }
  return coordinates;
}
