/**
 * Dots in place of what is too small to be seen: of objects, and of parts of objects that are not joined to the others,
 * smaller than a pixel the graphics card draws nothing, and nobody would know that they are there.
 */

import { BufferAttribute, BufferGeometry, Color, Points, Vector3 } from "three";
import type { PointsMaterial } from "three";

import type { CameraState } from "./api";
import { basisOf, eyeDistance } from "./camera";
import { kMostPartTriangles } from "./decoding";
import type { Style } from "./look";
import { clip, pointMaterial } from "./materials";
import { partsOf } from "./parts";
import type { ShapeRecord } from "./shape_store";
import { thinColor } from "./single_body";
import { toBox3 } from "./vec";

/** What is smaller on the view, in CSS pixels, is a dot. */
const kLeastSize = 1.5;
/** Diameter of a dot in CSS pixels. */
export const kDotSize = 4;

/** Something that becomes a dot if it is seen small enough. */
interface Candidate {
  readonly record: ShapeRecord;
  readonly centre: Vector3;
  readonly size: number;
}

export interface Dot {
  readonly record: ShapeRecord;
  readonly at: Vector3;
}

export class Dots {
  readonly points: Points<BufferGeometry, PointsMaterial>;
  private candidates: readonly Candidate[] = [];
  private smallest = Infinity;

  constructor() {
    this.points = new Points(new BufferGeometry(), pointMaterial(false));
    this.points.material.vertexColors = true;
    this.points.material.size = kDotSize;
    this.points.frustumCulled = false;
  }

  /** Other objects are visible, or elsewhere. */
  setRecords(records: Iterable<ShapeRecord>): void {
    const drawn = [...records].filter((record) => !hasPoints(record) && record.look?.opacity !== 0);
    const triangles = drawn.reduce((sum, { shown }) => sum + shown, 0);
    this.candidates = drawn.flatMap((record) => candidatesOf(record, triangles <= kMostPartTriangles));
    this.smallest = this.candidates.reduce((least, { size }) => Math.min(least, size), Infinity);
  }

  /** What is a dot for a camera in a view of a height in CSS pixels. Cost: linear in the objects. */
  dots(camera: CameraState, height: number): Dot[] {
    const pixel = camera.height / height;
    if (camera.projection === "orthographic" && this.smallest >= kLeastSize * pixel) return [];
    const { back } = basisOf(camera);
    const eye = eyeDistance(camera.height);
    const perDistance = camera.projection === "perspective" ? 1 / eye : 0;
    const [x, y, z] = [0, 1, 2].map((axis) => camera.target[axis]!) as [number, number, number];
    const ahead = new Vector3(...camera.rest).dot(back);
    const found: Dot[] = [];
    for (const { record, centre, size } of this.candidates) {
      const nearer = (centre.x - x) * back.x + (centre.y - y) * back.y + (centre.z - z) * back.z - ahead;
      if (size < kLeastSize * pixel * (1 - nearer * perDistance)) found.push({ record, at: centre });
    }
    return found;
  }

  update(camera: CameraState, height: number): void {
    const dots = this.dots(camera, height);
    this.points.visible = dots.length > 0;
    if (dots.length === 0) return;
    const positions = new Float32Array(3 * dots.length);
    const colors = new Float32Array(3 * dots.length);
    const place = new Vector3();
    const target = new Vector3(...camera.target);
    dots.forEach(({ record, at }, i) => {
      place
        .copy(at)
        .sub(target)
        .toArray(positions, 3 * i);
      const color = record.look ? thinColor(record.look) : new Color();
      color.toArray(colors, 3 * i);
    });
    const { geometry } = this.points;
    geometry.dispose();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setAttribute("color", new BufferAttribute(colors, 3));
    geometry.setDrawRange(0, dots.length);
    this.points.position.copy(target);
  }

  setStyle({ clipping }: Style): void {
    clip(this.points.material, clipping);
  }

  dispose(): void {
    this.points.geometry.dispose();
    this.points.material.dispose();
  }
}

function hasPoints({ finest }: ShapeRecord): boolean {
  return finest?.shape.primitives.some(({ role }) => role === "points") ?? true;
}

function candidatesOf(record: ShapeRecord, withParts: boolean): Candidate[] {
  const parts = withParts ? partsOf(record.finest!.shape) : [];
  const offset = new Vector3(...(record.look?.offset ?? [0, 0, 0]));
  const boxes = parts.length > 1 ? parts.map((part) => toBox3(part).translate(offset)) : [record.box()];
  return boxes
    .filter((box) => !box.isEmpty())
    .map((box) => ({
      record,
      centre: box.getCenter(new Vector3()),
      size: box.getSize(new Vector3()).length(),
    }));
}
