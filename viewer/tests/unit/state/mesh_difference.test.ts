import { expect, test } from "vitest";
import type { Shape } from "../../../src/glb/shapes";
import { meshDifference } from "../../../src/state/mesh_difference";
import { objectName, quoted } from "../../../src/state/uploads";

/** A shape of triangles over (0 0 0), (1 0 0), (0 1 0), (0 0 1), given relative to a translation. */
function shape(indices: number[], translation: readonly [number, number, number] = [0, 0, 0]): Shape {
  const positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1].map(
    (value, at) => value - (translation[at % 3] ?? 0),
  );
  const faces = {
    role: "faces" as const,
    positions: new Float32Array(positions),
    normals: null,
    indices: new Uint16Array(indices),
    tree: null,
    faceIds: null,
    vertexIds: null,
    deviation: 0,
  };
  return {
    row: 0,
    kind: "mesh3d",
    box: [0, 1, 0, 1, 0, 1],
    triangles: 0,
    shown: 0,
    translation,
    primitives: [faces],
  };
}

test("triangles that one mesh lacks, whatever the order of corners and the origin of positions", () => {
  const open = shape([0, 2, 1, 0, 1, 3, 0, 3, 2]);
  const closed = shape([1, 0, 2, 3, 0, 1, 0, 2, 3, 1, 2, 3], [0.1, 5, -3]);
  const { removed, added } = meshDifference([open], [closed]);
  expect(removed).toEqual([]);
  expect(added).toHaveLength(1);
  expect(added[0]?.map((corner) => corner.map((value) => Math.round(value) + 0))).toEqual([
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ]);
  expect(meshDifference([closed], [open]).removed).toHaveLength(1);
});

test("names of files become names of objects and literals", () => {
  expect(objectName("my part (2).stl", [])).toBe("My_part_2_");
  expect(objectName("bolt.stl", ["Bolt", "Bolt_2"])).toBe("Bolt_3");
  expect(objectName("123.stl", [])).toBe("Part");
  expect(quoted("uploads/o'neil \\ 1.stl")).toBe("'uploads/o\\'neil \\\\ 1.stl'");
});
