/** The parts of a shape: what is connected by triangles. */

import type { Box } from "./api";
import type { Primitive, Shape } from "../glb/shapes";
import { primitiveOf } from "./geometry";

const known = new WeakMap<Shape, readonly Box[]>();

/** The boxes of the parts, in coordinates of the database. Cost: linear in the triangles; kept. */
export function partsOf(shape: Shape): readonly Box[] {
  const cached = known.get(shape);
  if (cached) return cached;
  const faces = primitiveOf(shape, "faces");
  const parts = faces ? boxesOf(faces, shape.translation) : [];
  known.set(shape, parts);
  return parts;
}

function boxesOf(faces: Primitive, origin: readonly [number, number, number]): Box[] {
  const { positions, indices } = faces;
  const groups = new Groups(positions.length / 3);
  joinSamePlaces(groups, positions);
  const count = indices?.length ?? positions.length / 3;
  const vertex = (i: number): number => indices?.[i] ?? i;
  for (let i = 0; i + 2 < count; i += 3) {
    groups.join(vertex(i), vertex(i + 1));
    groups.join(vertex(i), vertex(i + 2));
  }
  const boxes = new Map<number, number[]>();
  for (let i = 0; i < count; i++) grow(boxes, groups.find(vertex(i)), positions, 3 * vertex(i));
  return [...boxes.values()].map((box) => box.map((part, i) => part + origin[i >> 1]!) as unknown as Box);
}

/** Vertices at creases are double. */
function joinSamePlaces(groups: Groups, positions: Float32Array): void {
  const first = new Map<string, number>();
  for (let i = 0; i < positions.length / 3; i++) {
    const key = `${positions[3 * i]} ${positions[3 * i + 1]} ${positions[3 * i + 2]}`;
    const other = first.get(key);
    if (other === undefined) first.set(key, i);
    else groups.join(i, other);
  }
}

function grow(boxes: Map<number, number[]>, group: number, positions: Float32Array, at: number): void {
  let box = boxes.get(group);
  if (!box) boxes.set(group, (box = [Infinity, -Infinity, Infinity, -Infinity, Infinity, -Infinity]));
  for (let axis = 0; axis < 3; axis++) {
    const value = positions[at + axis]!;
    box[2 * axis] = Math.min(box[2 * axis]!, value);
    box[2 * axis + 1] = Math.max(box[2 * axis + 1]!, value);
  }
}

/** Disjoint sets of numbers, with path halving [tarjan1975]. */
class Groups {
  private readonly parents: Int32Array;

  constructor(count: number) {
    this.parents = Int32Array.from({ length: count }, (_, i) => i);
  }

  find(element: number): number {
    const { parents } = this;
    while (parents[element] !== element) {
      parents[element] = parents[parents[element]!]!;
      element = parents[element]!;
    }
    return element;
  }

  join(a: number, b: number): void {
    this.parents[this.find(a)] = this.find(b);
  }
}
