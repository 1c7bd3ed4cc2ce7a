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

/** What was found by `partsOf` elsewhere. */
export function rememberParts(shape: Shape, parts: readonly Box[]): void {
  known.set(shape, parts);
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

/** Vertices at creases are double. The places are found by a table with open addressing, of their bits. */
function joinSamePlaces(groups: Groups, positions: Float32Array): void {
  const bits = new Uint32Array(positions.map((part) => part + 0).buffer); // -0 is 0
  const count = positions.length / 3;
  const size = 2 ** Math.ceil(Math.log2(Math.max(16, 2 * count)));
  const table = new Int32Array(size).fill(-1);
  const isSame = (a: number, b: number): boolean =>
    bits[3 * a] === bits[3 * b] && bits[3 * a + 1] === bits[3 * b + 1] && bits[3 * a + 2] === bits[3 * b + 2];
  for (let i = 0; i < count; i++) {
    let at = hashOf(bits[3 * i]!, bits[3 * i + 1]!, bits[3 * i + 2]!) & (size - 1);
    while (table[at] !== -1 && !isSame(table[at]!, i)) at = (at + 1) & (size - 1);
    if (table[at] === -1) table[at] = i;
    else groups.join(i, table[at]!);
  }
}

function hashOf(x: number, y: number, z: number): number {
  const mixed = Math.imul(x, 0x9e3779b1) ^ Math.imul(y, 0x85ebca6b) ^ Math.imul(z, 0xc2b2ae35);
  return (mixed ^ (mixed >>> 15) ^ (mixed >>> 7)) >>> 0;
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
