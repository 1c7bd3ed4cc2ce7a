/** Buffer geometries of the primitives of shapes; views into the server's bytes, nothing is copied. */

import {
  BufferAttribute,
  BufferGeometry,
  InterleavedBuffer,
  InterleavedBufferAttribute,
  Sphere,
  Vector3,
} from "three";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";

import type { IndexArray, Normals, Primitive, Role, Shape } from "../glb/shapes";

/** Lines that are drawn wide have at most so many segments; more are drawn thin. */
export const kMaxWideSegments = 20_000;

export function primitiveOf(shape: Shape, role: Role): Primitive | undefined {
  return shape.primitives.find((primitive) => primitive.role === role);
}

/** Positions and indices of several primitives of one shape are uploaded once: attributes are shared by array. */
export class AttributeCache {
  private readonly attributes = new Map<Float32Array, BufferAttribute>();

  positions(array: Float32Array): BufferAttribute {
    const known = this.attributes.get(array);
    if (known) return known;
    // Views of the same bytes that are not the same object are one accessor of the file.
    for (const [other, attribute] of this.attributes) {
      if (
        other.byteOffset === array.byteOffset &&
        other.length === array.length &&
        other.buffer === array.buffer
      ) {
        return attribute;
      }
    }
    const attribute = new BufferAttribute(array, 3);
    this.attributes.set(array, attribute);
    return attribute;
  }
}

export function normalAttribute(normals: Normals): InterleavedBufferAttribute | BufferAttribute {
  if (normals.stride === 3) return new BufferAttribute(normals.array, 3, true);
  return new InterleavedBufferAttribute(new InterleavedBuffer(normals.array, normals.stride), 3, 0, true);
}

/** The geometry of a primitive, with a sphere around the box of its shape so that nothing has to be scanned. */
export function geometryOf(
  primitive: Primitive,
  cache: AttributeCache,
  sphere: Sphere | null,
): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", cache.positions(primitive.positions));
  if (primitive.normals) geometry.setAttribute("normal", normalAttribute(primitive.normals));
  if (primitive.indices) geometry.setIndex(new BufferAttribute(primitive.indices, 1));
  if (sphere) geometry.boundingSphere = sphere;
  return geometry;
}

/** Around the box of a shape, relative to its translation. */
export function sphereOf(shape: Shape): Sphere | null {
  if (!shape.box) return null;
  const [x1, x2, y1, y2, z1, z2] = shape.box;
  const centre = new Vector3((x1 + x2) / 2, (y1 + y2) / 2, (z1 + z2) / 2);
  const radius = Math.hypot(x2 - x1, y2 - y1, z2 - z1) / 2;
  return new Sphere(centre.sub(new Vector3(...shape.translation)), radius * 1.000001);
}

/**
 * The ends of all edges of triangles that have the same vertices on both sides, each edge once: where a < b.
 * The others, at creases and boundaries, are the roles `edges` and `boundary`. Cost: linear.
 */
export function triangleEdges(indices: IndexArray): Uint32Array<ArrayBuffer> {
  let count = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [indices[i]!, indices[i + 1]!, indices[i + 2]!];
    count += (a < b ? 1 : 0) + (b < c ? 1 : 0) + (c < a ? 1 : 0);
  }
  const edges = new Uint32Array(2 * count);
  let at = 0;
  const add = (from: number, to: number): void => {
    if (from >= to) return;
    edges[at++] = from;
    edges[at++] = to;
  };
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [indices[i]!, indices[i + 1]!, indices[i + 2]!];
    add(a, b);
    add(b, c);
    add(c, a);
  }
  return edges;
}

/** Segments for wide lines, copied. */
export function wideLines(positions: Float32Array, indices: IndexArray | null): LineSegmentsGeometry {
  const count = indices ? indices.length : positions.length / 3;
  const ends = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) {
    const vertex = indices ? indices[i]! : i;
    ends.set(positions.subarray(3 * vertex, 3 * vertex + 3), 3 * i);
  }
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(ends);
  return geometry;
}
