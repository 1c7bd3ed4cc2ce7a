/** What a camera should look at by itself, if a few objects lie far from all others. */

import { Box3, Vector3 } from "three";

/** Objects farther away than so many times the size of the others would make these a dot. */
const kFar = 100;
/** Of the objects so many are taken for the main part, whatever the others are. */
const kMainShare = 0.75;

export interface MainBox {
  /** Of the objects that lie together. */
  readonly box: Box3;
  /** Number of those far away from them. */
  readonly far: number;
}

/** The box of the objects without those that are far from most of them. Empty boxes do not count. */
export function mainBox(boxes: readonly Box3[]): MainBox {
  const some = boxes.filter((box) => !box.isEmpty());
  const middle = medianCentre(some);
  const reaches = some.map((box) => reachFrom(middle, box));
  const limit = kFar * (sorted(reaches)[Math.ceil(kMainShare * some.length) - 1] ?? 0);
  const main = limit > 0 ? some.filter((_, i) => reaches[i]! <= limit) : some;
  const box = new Box3();
  for (const part of main) box.union(part);
  return { box, far: some.length - main.length };
}

/** Whether a picture of both boxes would show the first as a dot. */
export function isDotBeside(box: Box3, other: Box3): boolean {
  if (box.isEmpty() || other.isEmpty()) return false;
  const size = box.getSize(new Vector3()).length();
  return size > 0 && reachFrom(box.getCenter(new Vector3()), other) > kFar * size;
}

/** The distance of the farthest corner of a box. */
function reachFrom(place: Vector3, { min, max }: Box3): number {
  const along = (axis: "x" | "y" | "z") =>
    Math.max(Math.abs(place[axis] - min[axis]), Math.abs(place[axis] - max[axis]));
  return Math.hypot(along("x"), along("y"), along("z"));
}

/** The median of the centres, by each coordinate. */
function medianCentre(boxes: readonly Box3[]): Vector3 {
  const median = (axis: "x" | "y" | "z") =>
    sorted(boxes.map(({ min, max }) => min[axis] / 2 + max[axis] / 2))[Math.floor(boxes.length / 2)] ?? 0;
  return new Vector3(median("x"), median("y"), median("z"));
}

function sorted(numbers: readonly number[]): number[] {
  return [...numbers].sort((a, b) => a - b);
}
