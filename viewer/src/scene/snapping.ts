/** Moves a hit on a face to a corner or edge of its triangle that is near on the view. */

import { Line3, Vector3 } from "three";

import type { Hit, Vec3 } from "./api";
import { featureLines } from "./features";
import type { Primitive, Shape } from "../glb/shapes";
import type { Projector } from "./projection";
import { fromVector3, toVector3 } from "./vec";

export interface SnapOptions {
  readonly vertices: boolean;
  readonly edges: boolean;
  /** The edges between faces that are not coplanar; others are not snapped to. null: all edges. */
  readonly features: FeatureEdges | null;
}

const kVertexReach = 12;
const kEdgeReach = 8;

export function snapped(
  hit: Hit,
  faces: Primitive,
  origin: Vector3,
  projector: Projector,
  pointer: readonly [number, number],
  options: SnapOptions,
): Hit {
  if (!hit.triangle) return hit;
  const { corners, ids } = hit.triangle;
  const gap = (point: Vec3): number => {
    const screen = projector.project(point);
    return Math.hypot(screen.x - pointer[0], screen.y - pointer[1]);
  };
  if (options.vertices) {
    const nearest = [0, 1, 2].sort((a, b) => gap(corners[a]!) - gap(corners[b]!))[0]!;
    if (gap(corners[nearest]!) <= kVertexReach) {
      return { ...hit, point: corners[nearest]!, snap: "vertex", vertex: ids[nearest]! };
    }
  }
  if (!options.edges) return hit;
  let best: Hit = hit;
  let reach = kEdgeReach;
  for (const [from, to] of [
    [0, 1],
    [1, 2],
    [2, 0],
  ] as const) {
    const edge = [corners[from], corners[to]] as const;
    if (options.features && !options.features.has(faces, edge, origin)) continue;
    const line = new Line3(toVector3(edge[0]), toVector3(edge[1]));
    const point = fromVector3(line.closestPointToPoint(toVector3(hit.point), true, new Vector3()));
    if (gap(point) > reach) continue;
    reach = gap(point);
    best = { ...hit, point, snap: "edge", edge };
  }
  return best;
}

/** More feature edges than this are not looked up: then all edges of triangles count. */
const kMaxLookup = 400_000;

/** Which edges of triangles are drawn as edges; by the coordinates of their ends, since vertices at creases are double. */
export class FeatureEdges {
  private readonly hashes = new Set<number>();
  private readonly all: boolean;

  constructor(shape: Shape) {
    const lines = shape.primitives.flatMap((primitive) => {
      if (primitive.role === "edges") return [{ ...primitive, indices: featureLines(shape) }];
      return primitive.role === "boundary" || primitive.role === "nonmanifold" ? [primitive] : [];
    });
    this.all = lines.reduce((sum, { indices }) => sum + (indices?.length ?? 0) / 2, 0) > kMaxLookup;
    if (this.all) return;
    for (const { indices, positions } of lines) {
      for (let i = 0; indices && i < indices.length; i += 2) {
        this.hashes.add(edgeHash(positions, 3 * indices[i]!, positions, 3 * indices[i + 1]!));
      }
    }
  }

  /** Whether the edge between two corners, given in the coordinates of the scene, is one of them. */
  has(_faces: Primitive, edge: readonly [Vec3, Vec3], origin: Vector3): boolean {
    if (this.all) return true;
    const [a, b] = edge.map((end) => new Float32Array(toVector3(end).sub(origin).toArray()));
    return this.hashes.has(edgeHash(a!, 0, b!, 0));
  }
}

const kFloat = new Float32Array(1);
const kBits = new Uint32Array(kFloat.buffer);

/** The same for both directions; different edges have the same one with a probability of about 2^-50. */
function edgeHash(a: Float32Array, i: number, b: Float32Array, j: number): number {
  return pointHash(a, i) + pointHash(b, j);
}

function pointHash(array: Float32Array, at: number): number {
  let [low, high] = [0x811c9dc5, 0x9e3779b9];
  for (let axis = 0; axis < 3; axis++) {
    kFloat[0] = array[at + axis]! + 0; // -0 is 0
    low = Math.imul(low ^ kBits[0]!, 0x01000193) ^ (kBits[0]! >>> 15);
    high = Math.imul(high ^ (kBits[0]! >>> 7), 0x85ebca6b) ^ low;
  }
  return (low >>> 0) * 2 ** 20 + ((high >>> 0) & 0xfffff);
}
