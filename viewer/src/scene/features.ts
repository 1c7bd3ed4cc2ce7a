/**
 * The edges that make the shape of an object visible: creases. The server sends all edges between faces that are not
 * coplanar; on a finely divided curved surface these are nearly all, and would cover it.
 */

import type { IndexArray, Shape } from "../glb/shapes";
import { primitiveOf } from "./geometry";

/** Beyond so many lines creases are not looked for: it would take longer than a frame by far. */
const kMaxLines = 150_000;
/** With more lines than this per triangle, a large shape is curved rather than made of flat faces. */
const kMaxShare = 0.25;

const known = new WeakMap<Shape, IndexArray | null>();

/** The lines to be drawn as edges of a shape; null if there are none. Of mesh3d these are all edges of its polygons. */
export function featureLines(shape: Shape): IndexArray | null {
  const cached = known.get(shape);
  if (cached !== undefined) return cached;
  const lines = findLines(shape);
  known.set(shape, lines);
  return lines;
}

/** What was found by `featureLines` elsewhere. */
export function rememberFeatures(shape: Shape, lines: IndexArray | null): void {
  known.set(shape, lines);
}

function findLines(shape: Shape): IndexArray | null {
  const edges = primitiveOf(shape, "edges")?.indices;
  const faces = primitiveOf(shape, "faces");
  if (!edges || edges.length === 0) return null;
  if (!faces?.indices || shape.kind === "mesh3d") return edges;
  if (edges.length / 2 > kMaxLines)
    return edges.length / 2 > kMaxShare * (faces.indices.length / 3) ? null : edges;
  const creases = creaseLines(edges, faces.indices, faces.positions.length / 3);
  return creases.length > 0 ? creases : null;
}

/**
 * The lines that are not used by triangles in both directions with the same vertices: the vertices of creases are
 * double, since the normals of the two sides differ. Cost: linear.
 */
export function creaseLines(
  lines: IndexArray,
  triangles: IndexArray,
  vertices: number,
): Uint32Array<ArrayBuffer> {
  const upwards = new PairSet(triangles.length, vertices);
  const downwards = new PairSet(triangles.length, vertices);
  for (let i = 0; i < triangles.length; i += 3) {
    for (let k = 0; k < 3; k++) {
      const [from, to] = [triangles[i + k]!, triangles[i + ((k + 1) % 3)]!];
      if (from < to) upwards.add(from, to);
      else downwards.add(to, from);
    }
  }
  const creases = new Uint32Array(lines.length);
  let count = 0;
  for (let i = 0; i < lines.length; i += 2) {
    const [low, high] = [Math.min(lines[i]!, lines[i + 1]!), Math.max(lines[i]!, lines[i + 1]!)];
    if (upwards.has(low, high) && downwards.has(low, high)) continue;
    creases[count++] = lines[i]!;
    creases[count++] = lines[i + 1]!;
  }
  return creases.slice(0, count);
}

/** Pairs of numbers, in a table with open addressing. */
class PairSet {
  private readonly table: Float64Array;
  private readonly mask: number;

  constructor(
    capacity: number,
    private readonly factor: number,
  ) {
    const size = 2 ** Math.ceil(Math.log2(Math.max(16, capacity * 2)));
    this.table = new Float64Array(size).fill(-1);
    this.mask = size - 1;
  }

  private place(key: number, a: number, b: number): number {
    let at = (Math.imul(a, 0x9e3779b1) ^ Math.imul(b, 0x85ebca6b)) >>> 0;
    at = (at ^ (at >>> 15)) & this.mask;
    while (this.table[at] !== -1 && this.table[at] !== key) at = (at + 1) & this.mask;
    return at;
  }

  add(a: number, b: number): void {
    const key = a * this.factor + b;
    this.table[this.place(key, a, b)] = key;
  }

  has(a: number, b: number): boolean {
    const key = a * this.factor + b;
    return this.table[this.place(key, a, b)] === key;
  }
}
