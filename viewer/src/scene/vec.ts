/** Vectors of the API (arrays) and those of three.js. */

import { Box3, Vector3 } from "three";

import type { Box, Vec3 } from "./api";

export function toVector3(v: Vec3): Vector3 {
  return new Vector3(v[0], v[1], v[2]);
}

export function fromVector3(v: Vector3): Vec3 {
  return [v.x, v.y, v.z];
}

export function toBox3(box: Box): Box3 {
  return new Box3(new Vector3(box[0], box[2], box[4]), new Vector3(box[1], box[3], box[5]));
}

export function distance(a: Vec3, b: Vec3): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/** At so many heights of the view from their origin, floats resolve less than a twentieth of a pixel. */
const kFarOrigin = 2 ** 10;

/** Whether coordinates relative to `origin`, in floats, are too coarse for a view of this height at `target`. */
export function isFarOrigin(origin: Vector3, target: Vector3, height: number): boolean {
  return origin.distanceTo(target) > kFarOrigin * height;
}

/** Unit vector; [0, 0, 1] for the zero vector. */
export function normalized(v: Vec3): Vec3 {
  const length = Math.hypot(...v);
  return length > 0 ? [v[0] / length, v[1] / length, v[2] / length] : [0, 0, 1];
}
