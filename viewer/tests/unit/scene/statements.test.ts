import { describe, expect, it } from "vitest";

import { Vector3 } from "three";

import type { Hit, Vec3 } from "../../../src/scene/api";
import {
  angleOf,
  arePlacesExact,
  distanceOf,
  faceAngleOf,
  faceAreaOf,
  isRegionExact,
  regionAxes,
  regionOf,
  sectionOf,
} from "../../../src/scene/statements";
import { meets } from "../../../src/scene_panels/section_control";

const cell = { result: "r1", row: 2, column: "Solid" };

function hit(point: Vec3, vertex: number | null = null, face: number | null = null): Hit {
  return {
    cell,
    point,
    snap: vertex === null ? "face" : "vertex",
    face,
    vertex,
    triangle: null,
    edge: null,
    deviation: 0,
  };
}

const normals: readonly Vec3[] = [
  [1, 0, 0],
  [-1, 0, 0],
  [0, 1, 0],
  [0, -1, 0],
  [0, 0, 1],
  [0, 0, -1],
  [0.48, -0.6, 0.64],
  [-0.48, 0.64, -0.6],
];

it.each(normals)("the axes of a region are turned to x and y by its statement: (%d %d %d)", (...normal) => {
  const { statement } = regionOf(cell, { point: [1, 2, 3], normal });
  const turn = /makeVector3D\((\S+), (\S+), (\S+)\), (\S+)\]/.exec(statement)?.slice(1).map(Number);
  const [x, y, z, degrees] = turn ?? [0, 0, 1, 0];
  const axis = new Vector3(x, y, z).normalize();
  const turned = ([a, b, c]: Vec3) => new Vector3(a, b, c).applyAxisAngle(axis, (degrees! * Math.PI) / 180);
  const [u, v] = regionAxes(normal);
  expect(turned(u).distanceTo(new Vector3(1, 0, 0))).toBeLessThan(1e-12);
  expect(turned(v).distanceTo(new Vector3(0, 1, 0))).toBeLessThan(1e-12);
  expect(turned(normal).distanceTo(new Vector3(0, 0, 1))).toBeLessThan(1e-12);
});

// The same statements are run by tests/e2e/tools.e2e.ts.
describe("statements", () => {
  it("of sections write numbers in full", () => {
    const question = sectionOf(cell, { point: [0.1, -1e-7, 1e21], normal: [0, 0, 1] });
    expect(question.statement).toBe(
      "query section($v, makePlane3D(makePoint3D(0.1, -1e-7, 1e+21), makeVector3D(0, 0, 1)))",
    );
    expect(question.parameters).toEqual({ v: cell });
  });

  it("of regions turn the normal upwards", () => {
    const at = (normal: Vec3): string => regionOf(cell, { point: [1, 2, 3], normal }).statement;
    expect(at([0, 0, 2])).toBe("query slice($v, 3)");
    expect(at([0, 0, -1])).toBe(
      "query slice($v rotate[makePoint3D(1, 2, 3), makeVector3D(1, 0, 0), 180], 3)",
    );
    expect(at([1, 0, 0])).toBe("query slice($v rotate[makePoint3D(1, 2, 3), makeVector3D(0, -1, 0), 90], 3)");
    expect(at([0, 1, 0])).toBe("query slice($v rotate[makePoint3D(1, 2, 3), makeVector3D(1, 0, 0), 90], 3)");
    expect(at([1, 0, 1])).toContain(", 45], 3)");
    expect(isRegionExact([0, -3, 0])).toBe(true);
    expect(isRegionExact([1, 1, 0])).toBe(false);
  });

  it("of distances take vertices by their numbers, other places by their coordinates", () => {
    const [a, b] = [hit([0, 0, 0], 4), hit([1, 2, 3])];
    expect(distanceOf(a, b)).toEqual({
      statement: "query distance((vertices($a) filter[.Id = 4] extract[Position]), makePoint3D(1, 2, 3))",
      parameters: { a: cell },
    });
    expect(arePlacesExact([a, a])).toBe(true);
    expect(arePlacesExact([a, b])).toBe(false);
  });

  it("of angles and areas", () => {
    expect(angleOf(hit([1, 0, 0]), hit([0, 0, 0]), hit([0, 1, 0])).statement).toBe(
      "query rad2deg(atan2(length(cross(makeVector3D(makePoint3D(0, 0, 0), makePoint3D(1, 0, 0)), " +
        "makeVector3D(makePoint3D(0, 0, 0), makePoint3D(0, 1, 0)))), dot(makeVector3D(makePoint3D(0, 0, 0), " +
        "makePoint3D(1, 0, 0)), makeVector3D(makePoint3D(0, 0, 0), makePoint3D(0, 1, 0)))))",
    );
    expect(faceAreaOf(hit([0, 0, 0], null, 5)).statement).toBe(
      "query faces($a) filter[.Id = 5] extract[Area]",
    );
    expect(faceAngleOf(hit([0, 0, 0], null, 5), hit([0, 0, 0], null, 6)).parameters).toEqual({
      a: cell,
      b: cell,
    });
  });
});

describe("meets", () => {
  const box = [0, 2, 0, 2, 0, 2] as const;
  it("tells whether a plane meets a box", () => {
    expect(meets({ box }, { point: [1, 0, 0], normal: [1, 0, 0] })).toBe(true);
    expect(meets({ box }, { point: [2, 0, 0], normal: [1, 0, 0] })).toBe(true);
    expect(meets({ box }, { point: [2.1, 0, 0], normal: [-1, 0, 0] })).toBe(false);
    expect(meets({ box }, { point: [3, 0, 0], normal: [1, 1, 0] })).toBe(true);
    expect(meets({ box: null }, { point: [3, 0, 0], normal: [1, 1, 0] })).toBe(false);
  });
});
