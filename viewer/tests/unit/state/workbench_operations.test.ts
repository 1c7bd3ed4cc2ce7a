import { expect, test } from "vitest";

import { isWorkbenchStatement, transformation, triangulation } from "../../../src/state/workbench_operations";

test("maps are written with all digits, and are statements of the workbench", () => {
  const about = [0.1, -2, 1e-7] as const;
  const maps = [
    transformation({ mode: "translate", by: [1, 0, -0] }),
    transformation({ mode: "scale", about, factors: [2, 1, 0.5] }),
    transformation({ mode: "rotate", about, axis: [0, 0, 1], degrees: 90 }),
  ];
  expect(maps.map(({ expression }) => expression)).toEqual([
    "$a translate[[const vector3d value (1 0 0)]]",
    "$a scaleDir[[const point3d value (0.1 -2 1e-7)], [const vector3d value (2 1 0.5)]]",
    "$a rotate[[const point3d value (0.1 -2 1e-7)], [const vector3d value (0 0 1)], 90.0]",
  ]);
  for (const { expression } of maps) expect(isWorkbenchStatement(`query ${expression}`)).toBe(true);
});

test("solids and surfaces consist of triangles, meshes are triangulated", () => {
  expect(triangulation("mesh3d").expression).toBe("triangulate($a)");
  expect(triangulation("volume3d").expression).toBe("volume2mesh($a)");
});
