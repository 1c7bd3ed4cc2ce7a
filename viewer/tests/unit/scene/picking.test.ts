import { Plane, Ray, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import { decodeShapes } from "../../../src/glb/shapes";
import type { PickOptions } from "../../../src/scene/picking";
import { visibleRange } from "../../../src/scene/picking";
import { FeatureEdges } from "../../../src/scene/snapping";
import { checkedTree } from "../../../src/scene/tree";
import type { Hit } from "../../../src/scene/api";
import { buildGlb } from "./support/glb_builder";
import { cube, points, sphere, square } from "./support/solids";
import { sceneOf } from "./support/store";
import type { TestScene } from "./support/store";

const plain: PickOptions = { clipping: [], facesVisible: true, snap: null };

function pickAt(scene: TestScene, place: readonly [number, number, number], options = plain): Hit | null {
  const { x, y } = scene.projector.project(place);
  return scene.picker.pick(x, y, options);
}

describe("picking", () => {
  it("finds the nearest object, its triangle and the point, far from the origin too", () => {
    const far = 1e8;
    const scene = sceneOf([cube(0, 2, [far, 0, 0]), cube(1, 2, [far, 0, 5]), cube(2, 2, [far + 4, 0, 0])]);
    const hit = pickAt(scene, [far + 0.25, 0.5, 0])!;
    expect(hit.cell).toEqual({ result: "r1", row: 1, column: "Solid" });
    expect(hit.point[0]).toBeCloseTo(far + 0.25, 5);
    expect(hit.point[2]).toBeCloseTo(6, 6);
    expect(hit.triangle!.normal[2]).toBeCloseTo(1, 9);
    expect(hit.triangle!.area).toBeCloseTo(2, 6);
    expect(hit.face).toBeGreaterThanOrEqual(0);
    expect(pickAt(scene, [far + 4, 0, 0])!.cell.row).toBe(2);
    expect(pickAt(scene, [far + 2, 0, 0])).toBeNull();
  });

  it("leaves out what is hidden", () => {
    const scene = sceneOf([cube(0, 2), cube(1, 2, [0, 0, 5])]);
    scene.store.record({ result: "r1", row: 1, column: "Solid" })!.hidden = true;
    expect(pickAt(scene, [0.3, 0.2, 0])!.cell.row).toBe(0);
    scene.column.visible = false;
    expect(pickAt(scene, [0.3, 0.2, 0])).toBeNull();
  });

  it("sees through what the section cuts away", () => {
    const scene = sceneOf([cube(0, 2), cube(1, 2, [0, 0, 5])]);
    const at = scene.projector.toLocal([0, 0, 3]);
    const below = new Plane().setFromNormalAndCoplanarPoint(new Vector3(0, 0, -1), at);
    expect(pickAt(scene, [0.3, 0.2, 0], { ...plain, clipping: [below] })!.cell.row).toBe(0);
  });

  it("gives the numbers of faces and vertices in the value", () => {
    const ids = { faceIds: [40, 41], vertexIds: [7, 8, 9, 10] };
    const scene = sceneOf([square(0, 2, [0, 0, 0], ids)]);
    const hit = pickAt(scene, [0.5, -0.5, 0])!;
    expect(hit.face).toBe(40);
    expect(hit.triangle!.ids).toEqual([7, 8, 9]);
  });

  it("does not give numbers of a coarser level for those of the value", () => {
    const scene = sceneOf([square(0, 2, [0, 0, 0], { triangles: 500, deviation: 0.125 })]);
    const hit = pickAt(scene, [0.5, -0.5, 0])!;
    expect(hit.face).toBeNull();
    expect(hit.triangle!.ids).toEqual([null, null, null]);
    expect(hit.deviation).toBe(0.125);
  });

  it("uses the server's tree and finds the same as without", () => {
    const withTree = sceneOf([sphere(0, 3, 60, [1, 2, 3], { tree: true })], "isometric");
    const without = sceneOf([sphere(0, 3, 60, [1, 2, 3])], "isometric");
    let hits = 0;
    for (let i = 0; i < 60; i++) {
      const [x, y] = [150 + 90 * (i % 8), 60 + 90 * Math.floor(i / 8)];
      const [a, b] = [withTree.picker.pick(x, y, plain), without.picker.pick(x, y, plain)];
      expect(a === null).toBe(b === null);
      if (!a || !b) continue;
      hits++;
      for (const axis of [0, 1, 2] as const) expect(a.point[axis]).toBeCloseTo(b.point[axis], 5);
      const radius = Math.hypot(a.point[0] - 1, a.point[1] - 2, a.point[2] - 3);
      expect(radius).toBeGreaterThan(2.98);
      expect(radius).toBeLessThanOrEqual(3.000001);
    }
    expect(hits).toBeGreaterThan(20);
  });

  it("finds points within some pixels, also on a face", () => {
    const scene = sceneOf([square(0, 4), points(1, [1, 1, 0, -1, -1, 0])]);
    const { x, y } = scene.projector.project([1, 1, 0]);
    const hit = scene.picker.pick(x + 3, y - 3, plain)!;
    expect(hit).toMatchObject({ snap: "point", vertex: 0, point: [1, 1, 0] });
    expect(hit.cell.row).toBe(1);
    expect(scene.picker.pick(x + 30, y, plain)!.cell.row).toBe(0);
  });
});

describe("snapping", () => {
  const shapes = [cube(0, 2)];
  const features = new FeatureEdges(decodeShapes(buildGlb(shapes))[0]!);
  const snap = { vertices: true, edges: true, features };

  it("goes to a corner, an edge of the shape, or stays on the face", () => {
    const scene = sceneOf(shapes);
    const at = (x: number, y: number): Hit => pickAt(scene, [x, y, 1], { ...plain, snap })!;
    expect(at(0.99, 0.99)).toMatchObject({ snap: "vertex", point: [1, 1, 1] });
    expect(at(0.99, 0.99).vertex).not.toBeNull();
    const edge = at(0.99, 0.3);
    expect(edge.snap).toBe("edge");
    expect(edge.point[0]).toBeCloseTo(1, 6);
    expect(edge.point[1]).toBeCloseTo(0.3, 6);
    // The diagonal of a flat face is none of its edges.
    expect(at(0.3, 0.301).snap).toBe("face");
    expect(pickAt(scene, [0.3, 0.301, 1], { ...plain, snap: { ...snap, features: null } })!.snap).toBe(
      "edge",
    );
  });
});

describe("checkedTree", () => {
  const shape = decodeShapes(buildGlb([sphere(0, 1, 40, [0, 0, 0], { tree: true })]))[0]!;
  const faces = shape.primitives[0]!;
  const triangles = faces.indices!.length / 3;

  it("accepts the documented layout and refuses trees that lead out of the data", () => {
    expect(checkedTree(faces.tree!, triangles)).not.toBeNull();
    expect(checkedTree(faces.tree!, triangles - 1)).toBeNull();
    expect(checkedTree(faces.tree!.slice(0, 33), triangles)).toBeNull();
    expect(checkedTree(faces.tree!.slice(0, faces.tree!.byteLength - 32), triangles)).toBeNull();
  });

  it("leaves the server's bytes as they are", () => {
    const before = faces.tree!.slice();
    checkedTree(faces.tree!, triangles);
    expect(faces.tree!).toEqual(before);
  });
});

describe("visibleRange", () => {
  const ray = new Ray(new Vector3(0, 0, 10), new Vector3(0, 0, -1));
  it("is the part of the ray on the seen side of the planes", () => {
    expect(visibleRange(ray, [])).toEqual([0, Infinity]);
    expect(visibleRange(ray, [new Plane(new Vector3(0, 0, -1), 4)])).toEqual([6, Infinity]);
    expect(visibleRange(ray, [new Plane(new Vector3(0, 0, 1), -4)])).toEqual([0, 6]);
    expect(visibleRange(ray, [new Plane(new Vector3(1, 0, 0), -1)])).toBeNull();
  });
});
