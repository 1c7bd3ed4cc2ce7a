/** Dragging a vertex of a shape: along its normal, in the plane of its normal, or parallel to the view. */

import { Plane, Triangle, Vector3 } from "three";
import type { Ray } from "three";

import type { Primitive } from "../glb/shapes";

/** The vertices at one place: creases have several. */
export interface VertexPlace {
  readonly vertices: readonly number[];
  /** Number in the value. */
  readonly id: number;
  readonly normal: Vector3;
}

/** All vertices with the coordinates of one, and the normal there, weighted by the angles of the faces. Cost: linear. */
export function placeOf(faces: Primitive, vertex: number): VertexPlace {
  const { positions, indices } = faces;
  const [x, y, z] = positions.subarray(3 * vertex, 3 * vertex + 3);
  const same = new Set<number>();
  for (let i = 0; i < positions.length / 3; i++) {
    if (positions[3 * i] === x && positions[3 * i + 1] === y && positions[3 * i + 2] === z) same.add(i);
  }
  const normal = new Vector3();
  const count = indices?.length ?? positions.length / 3;
  for (let i = 0; i < count; i += 3) {
    const corners = [0, 1, 2].map((k) => indices?.[i + k] ?? i + k);
    const at = corners.findIndex((corner) => same.has(corner));
    if (at < 0) continue;
    const [a, b, c] = [0, 1, 2].map((k) => new Vector3().fromArray(positions, 3 * corners[(at + k) % 3]!));
    const angle = b!.clone().sub(a!).angleTo(c!.clone().sub(a!));
    normal.addScaledVector(new Triangle(a, b, c).getNormal(new Vector3()), angle);
  }
  if (normal.lengthSq() === 0) normal.set(0, 0, 1);
  return { vertices: [...same], id: faces.vertexIds?.[vertex] ?? vertex, normal: normal.normalize() };
}

/** Where the ray takes a vertex that was at `from`. */
export function draggedTo(
  ray: Ray,
  from: Vector3,
  normal: Vector3,
  along: "normal" | "plane" | "free",
): Vector3 | null {
  if (along === "normal") return closestOnLine(ray, from, normal);
  const across = along === "plane" ? normal : ray.direction;
  return ray.intersectPlane(new Plane().setFromNormalAndCoplanarPoint(across, from), new Vector3());
}

/** The point of the line through `from` that is nearest to the ray; null if they are parallel. */
export function closestOnLine(ray: Ray, from: Vector3, direction: Vector3): Vector3 | null {
  const slope = ray.direction.dot(direction);
  const denominator = 1 - slope * slope;
  if (denominator < 1e-6) return null;
  const gap = from.clone().sub(ray.origin);
  const along = (slope * gap.dot(ray.direction) - gap.dot(direction)) / denominator;
  return from.clone().addScaledVector(direction, along);
}

/** Moves the vertices in the arrays that are drawn; `to` is relative to the origin of the shape. */
export function moveVertices(faces: Primitive, vertices: readonly number[], to: Vector3): void {
  for (const vertex of vertices) to.toArray(faces.positions, 3 * vertex);
}
