import { Box3, Vector3 } from "three";
import { expect, test } from "vitest";

import { eyeDistance } from "../../../src/scene/camera";
import { FrontFaces, isWorthChoosing } from "../../../src/scene/front_faces";
import type { Eye } from "../../../src/scene/front_faces";
import { AttributeCache, geometryOf, primitiveOf } from "../../../src/scene/geometry";
import { Projector } from "../../../src/scene/projection";
import { kDefaultCamera } from "../../../src/scene/state";
import { decodeShapes } from "../../../src/glb/shapes";
import { buildGlb } from "./support/glb_builder";
import { sphere } from "./support/solids";

const shape = decodeShapes(buildGlb([sphere(0, 2, 40)]))[0]!;
const faces = primitiveOf(shape, "faces")!;

function chosenBy(eye: Eye): number[][] {
  const fronts = new FrontFaces(
    geometryOf(faces, new AttributeCache(), null),
    faces.positions,
    faces.indices!,
  );
  fronts.choose(eye);
  const { geometry } = fronts;
  const numbers = [...geometry.index!.array].slice(0, geometry.drawRange.count);
  return triplesOf(numbers);
}

function triplesOf(numbers: ArrayLike<number>): number[][] {
  return Array.from({ length: numbers.length / 3 }, (_, i) => [0, 1, 2].map((k) => numbers[3 * i + k]!));
}

/** Cosine of the angle between the normal of a triangle and the direction to the eye. */
function facing(triangle: readonly number[], [x, y, z, w]: Eye): number {
  const [a, b, c] = triangle.map((vertex) => new Vector3().fromArray(faces.positions, 3 * vertex));
  const normal = b!.clone().sub(a!).cross(c!.clone().sub(a!)).normalize();
  return normal.dot(new Vector3(x, y, z).addScaledVector(a!, -w).normalize());
}

const eyes: readonly Eye[] = [
  [10, 0, 0, 1],
  [3, -4, 2.5, 1],
  [1e5, 2e5, -1e5, 1],
  [0.1, 0.2, -0.1, 1],
  [0, 0, 1, 0],
  [-0.6, 0, 0.8, 0],
];

test.each(eyes)("draws the triangles that show their fronts to (%d %d %d %d)", (...eye) => {
  const chosen = new Set(chosenBy(eye).map(String));
  for (const triangle of triplesOf(faces.indices!)) {
    const cosine = facing(triangle, eye);
    if (Math.abs(cosine) > 1e-3) expect(chosen.has(String(triangle))).toBe(cosine > 0);
  }
});

test("keeps the order, and draws about half of a sphere", () => {
  const all = triplesOf(faces.indices!).map(String);
  const places = chosenBy([100, 0, 0, 1]).map((triangle) => all.indexOf(String(triangle)));
  expect(places).toEqual([...places].sort((a, b) => a - b));
  expect(places.length / all.length).toBeGreaterThan(0.4);
  expect(places.length / all.length).toBeLessThan(0.6);
});

test("an eye is seen from a place, however far it is; a direction is the same everywhere", () => {
  const projector = new Projector();
  const place = new Vector3(1e15, 0, 0);
  for (const projection of ["perspective", "orthographic"] as const) {
    const target = [1e15 + 1, 0, 0] as const;
    const camera = { ...kDefaultCamera, projection, target, direction: [0, 0, 1] as const, height: 2 };
    projector.camera(camera, new Box3());
    const eye = projection === "perspective" ? [1, 0, eyeDistance(2), 1] : [0, 0, 1, 0];
    expect(projector.eyeFrom(place)).toEqual(eye);
  }
});

test("few triangles are drawn as they are, and too many", () => {
  expect(isWorthChoosing(new Uint16Array(3 * 12))).toBe(false);
  expect(isWorthChoosing(faces.indices!)).toBe(true);
  expect(isWorthChoosing(new Uint32Array(3 * 1_000_000))).toBe(false);
});
