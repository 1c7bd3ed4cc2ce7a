/** Solids for tests, in the documented layout of shapes. */

import type { TestShape } from "./glb_builder";

type Vec3 = readonly [number, number, number];

/** An axis-parallel cube around the origin of its translation, with four vertices a face. */
export function cube(
  row: number,
  size: number,
  translation: Vec3 = [0, 0, 0],
  more: Partial<TestShape> = {},
): TestShape {
  const h = size / 2;
  const positions: number[] = [];
  const normals: number[] = [];
  const faces: number[] = [];
  const edges: number[] = [];
  for (let axis = 0; axis < 3; axis++) {
    for (const sign of [-1, 1]) {
      const first = positions.length / 3;
      for (const [u, v] of [
        [-1, -1],
        [1, -1],
        [1, 1],
        [-1, 1],
      ] as const) {
        const corner = [0, 0, 0];
        const normal = [0, 0, 0];
        corner[axis] = sign * h;
        corner[(axis + 1) % 3] = u * h;
        corner[(axis + 2) % 3] = v * h;
        normal[axis] = sign * 127;
        positions.push(...corner);
        normals.push(...normal);
      }
      const order = sign > 0 ? [0, 1, 2, 0, 2, 3] : [0, 2, 1, 0, 3, 2];
      faces.push(...order.map((i) => first + i));
      if (axis === 0) edges.push(...[0, 1, 1, 2, 2, 3, 3, 0].map((i) => first + i));
      if (axis === 1) edges.push(...[1, 2, 3, 0].map((i) => first + i));
    }
  }
  // Edges along x: the faces of axis 1 have u = z, v = x; both of their edges along x.
  return { row, kind: "volume3d", translation, positions, normals, faces, edges, ...more };
}

/** A sphere of `rings` x `2 rings` quadrilaterals with shared vertices. */
export function sphere(
  row: number,
  radius: number,
  rings: number,
  translation: Vec3 = [0, 0, 0],
  more: Partial<TestShape> = {},
): TestShape {
  const positions: number[] = [];
  const normals: number[] = [];
  const faces: number[] = [];
  const columns = 2 * rings;
  for (let i = 0; i <= rings; i++) {
    for (let j = 0; j < columns; j++) {
      if ((i === 0 || i === rings) && j > 0) continue;
      const theta = (Math.PI * i) / rings;
      const phi = (2 * Math.PI * j) / columns;
      const unit = [Math.sin(theta) * Math.cos(phi), Math.sin(theta) * Math.sin(phi), Math.cos(theta)];
      positions.push(...unit.map((value) => value * radius));
      normals.push(...unit.map((value) => Math.round(value * 127)));
    }
  }
  const at = (i: number, j: number): number => {
    if (i === 0) return 0;
    if (i === rings) return positions.length / 3 - 1;
    return 1 + (i - 1) * columns + (j % columns);
  };
  const edges: number[] = [];
  for (let i = 0; i < rings; i++) {
    for (let j = 0; j < columns; j++) {
      const [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
      if (i > 0) faces.push(a, c, d);
      if (i < rings - 1) faces.push(a, b, c);
      edges.push(a, b);
      if (i > 0) edges.push(a, d);
    }
  }
  return { row, kind: "volume3d", translation, positions, normals, faces, edges, ...more };
}

/** A square surface in z = 0, with its boundary. */
export function square(
  row: number,
  size: number,
  translation: Vec3 = [0, 0, 0],
  more: Partial<TestShape> = {},
): TestShape {
  const h = size / 2;
  return {
    row,
    kind: "surface3d",
    translation,
    positions: [-h, -h, 0, h, -h, 0, h, h, 0, -h, h, 0],
    normals: [0, 0, 127, 0, 0, 127, 0, 0, 127, 0, 0, 127],
    faces: [0, 1, 2, 0, 2, 3],
    boundary: [0, 1, 1, 2, 2, 3, 3, 0],
    ...more,
  };
}

export function points(
  row: number,
  coordinates: readonly number[],
  more: Partial<TestShape> = {},
): TestShape {
  return { row, kind: "points3d", positions: coordinates, points: true, triangles: 0, ...more };
}
