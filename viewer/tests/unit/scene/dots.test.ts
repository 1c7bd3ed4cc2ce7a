import { expect, test } from "vitest";

import { decodeShapes } from "../../../src/glb/shapes";
import { Dots } from "../../../src/scene/dots";
import { partsOf } from "../../../src/scene/parts";
import type { TestShape } from "./support/glb_builder";
import { buildGlb } from "./support/glb_builder";
import { cube, points } from "./support/solids";
import { sceneOf } from "./support/store";

/** Two shapes as one value. */
function together(a: TestShape, b: TestShape, shift: number): TestShape {
  const first = a.positions.length / 3;
  const moved = b.positions.map((value, i) => (i % 3 === 0 ? value + shift : value));
  return {
    ...a,
    positions: [...a.positions, ...moved],
    normals: [...a.normals!, ...b.normals!],
    faces: [...a.faces!, ...b.faces!.map((vertex) => vertex + first)],
    edges: [],
  };
}

const rows = (scene: ReturnType<typeof sceneOf>, camera = scene.camera) =>
  scene.dots.dots(camera, 800).map(({ record }) => record.row);

test("what is smaller than a pixel is a dot, until one comes close", () => {
  const scene = sceneOf([cube(0, 1), cube(1, 1, [1e12, 0, 0]), cube(2, 1e11, [1e11, 0, 0])]);
  expect(rows(scene)).toEqual([0, 1]);
  for (const projection of ["perspective", "orthographic"] as const) {
    const close = { ...scene.camera, projection, target: [1e12, 0, 0] as const, height: 2 };
    expect(rows(scene, close)).not.toContain(1);
    // At the distance of the eye everything is seen twice as small as at half of it.
    const limit = { ...close, height: (800 * Math.sqrt(3)) / 1.5 };
    expect(rows(scene, { ...limit, height: limit.height * 1.01 })).toContain(1);
    expect(rows(scene, { ...limit, height: limit.height * 0.99 })).not.toContain(1);
  }
});

test("a dot is picked within some pixels, unless something hides it", () => {
  const scene = sceneOf([cube(0, 1), cube(1, 1, [1e12, 0, 0])]);
  const { x, y } = scene.projector.project([1e12, 0, 0]);
  const plain = { clipping: [], facesVisible: true, snap: null };
  expect(scene.picker.pick(x + 4, y - 3, plain)).toMatchObject({ cell: { row: 1 }, point: [1e12, 0, 0] });
  expect(scene.picker.pick(x + 20, y, plain)).toBeNull();
  const hidden = sceneOf([cube(0, 1), cube(1, 1, [1e12, 0, 0]), cube(2, 1e12, [1e12, 0, 2e12])]);
  expect(hidden.picker.pick(...placeOf(hidden), plain)!.cell.row).toBe(2);
});

function placeOf({ projector }: ReturnType<typeof sceneOf>): [number, number] {
  const { x, y } = projector.project([1e12, 0, 0]);
  return [x, y];
}

test("the parts of one object that are too small are dots, too", () => {
  const [near, far] = [cube(0, 1), cube(0, 1)];
  const scene = sceneOf([together(near, far, 1e6)]);
  expect(scene.dots.dots(scene.camera, 800).map(({ at }) => Math.round(at.x))).toEqual([0, 1e6]);
  expect(partsOf(decodeShapes(buildGlb([near]))[0]!)).toEqual([[-0.5, 0.5, -0.5, 0.5, -0.5, 0.5]]);
});

test("points and what is hidden are no dots", () => {
  const scene = sceneOf([points(0, [0, 0, 0]), cube(1, 1, [1e9, 0, 0]), cube(2, 1, [2e9, 0, 0])]);
  const dots = new Dots();
  scene.store.record({ result: "r1", row: 2, column: "Solid" })!.hidden = true;
  dots.setRecords(scene.store.visibleRecords());
  expect(dots.dots(scene.camera, 800).map(({ record }) => record.row)).toEqual([1]);
});
