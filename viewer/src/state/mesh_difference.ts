import type { Vec3 } from "../scene/api";
import type { Shape } from "../glb/shapes";

export type Triangle = readonly [Vec3, Vec3, Vec3];

export interface MeshDifference {
  /** Triangles of the first mesh that the second one does not have. */
  readonly removed: readonly Triangle[];
  /** Triangles of the second mesh that the first one does not have. */
  readonly added: readonly Triangle[];
}

/**
 * The triangles in which two meshes differ; those with the same corners are equal, in whatever order and orientation.
 * Corners are compared after rounding to a 2^20th of the larger box, since shapes have floats. Cost: linear.
 */
export function meshDifference(before: readonly Shape[], after: readonly Shape[]): MeshDifference {
  const grid = gridOf([...before, ...after]);
  const old = trianglesOf(before, grid);
  const next = trianglesOf(after, grid);
  return {
    removed: [...old].filter(([key]) => !next.has(key)).map(([, triangle]) => triangle),
    added: [...next].filter(([key]) => !old.has(key)).map(([, triangle]) => triangle),
  };
}

function gridOf(shapes: readonly Shape[]): number {
  let extent = 0;
  for (const { box } of shapes)
    if (box) extent = Math.max(extent, box[1] - box[0], box[3] - box[2], box[5] - box[4]);
  return extent > 0 ? extent / 2 ** 20 : 1;
}

function trianglesOf(shapes: readonly Shape[], grid: number): Map<string, Triangle> {
  const triangles = new Map<string, Triangle>();
  for (const { primitives, translation } of shapes) {
    const faces = primitives.find(({ role }) => role === "faces");
    if (!faces) continue;
    const count = (faces.indices?.length ?? faces.positions.length / 3) / 3;
    for (let index = 0; index < count; index++) {
      const corner = (offset: number): Vec3 => {
        const vertex = (faces.indices?.[index * 3 + offset] ?? index * 3 + offset) * 3;
        return [0, 1, 2].map(
          (axis) => (faces.positions[vertex + axis] ?? 0) + (translation[axis] ?? 0),
        ) as unknown as Vec3;
      };
      const triangle: Triangle = [corner(0), corner(1), corner(2)];
      triangles.set(keyOf(triangle, grid), triangle);
    }
  }
  return triangles;
}

/** The same text for triangles with the same corners. */
function keyOf(triangle: Triangle, grid: number): string {
  return triangle
    .map((corner) => corner.map((value) => Math.round(value / grid)).join(","))
    .sort()
    .join(";");
}
