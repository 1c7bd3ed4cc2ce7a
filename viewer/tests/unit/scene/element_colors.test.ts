import { expect, test } from "vitest";

import { decodeShapes } from "../../../src/glb/shapes";
import { coloredFaces, drawnColors, meanColor } from "../../../src/scene/element_colors";
import { buildGlb } from "./support/glb_builder";

/** A square of two faces; its first face has two triangles in the value's numbering. */
const square = {
  row: 0,
  kind: "mesh3d",
  positions: [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0],
  normals: [0, 0, 127, 0, 0, 127, 0, 0, 127, 0, 0, 127],
  faces: [0, 1, 2, 0, 2, 3],
};

const colorsOf = (told: Parameters<typeof drawnColors>[0], shape: object = {}): number[] | null => {
  const [decoded] = decodeShapes(buildGlb([{ ...square, ...shape }]));
  const geometry = coloredFaces(decoded!, drawnColors(told), null);
  return geometry && [...geometry.getAttribute("color").array];
};
const [red, green] = [
  [1, 0, 0],
  [0, 1, 0],
];
const times = (color: readonly number[] | undefined, count: number) =>
  Array.from({ length: count }, () => color!).flat();

test("materials colour the triangles of their faces, as they are numbered in the value", () => {
  const told = {
    elements: "face",
    materials: ["grass", "brick"],
    colors: { brick: "#ff0000", grass: "#00ff00" },
  } as const;
  expect(colorsOf(told)).toEqual([...times(green, 3), ...times(red, 3)]);
  expect(colorsOf(told, { faceIds: [1, 0] })).toEqual([...times(red, 3), ...times(green, 3)]);
});

test("colours of vertices are those of the corners", () => {
  const rgb = new Float32Array([1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1]);
  expect(colorsOf({ elements: "vertex", rgb })?.slice(0, 9)).toEqual([1, 0, 0, 0, 1, 0, 0, 0, 1]);
  expect(colorsOf({ elements: "vertex", rgb }, { vertexIds: [1, 0, 2, 3] })?.slice(0, 3)).toEqual([0, 1, 0]);
});

test("a coarser level, which has vertices and faces of its own, is not coloured", () => {
  const rgb = new Float32Array(12);
  expect(colorsOf({ elements: "vertex", rgb }, { triangles: 8 })).toBeNull();
});

test("materials that no file describes have one colour each, and are counted", () => {
  const { materials, rgb } = drawnColors({ elements: "face", materials: ["b", "a", "b", ""], colors: {} });
  expect(materials.map(({ label, count }) => [label, count])).toEqual([
    ["a", 1],
    ["b", 2],
  ]);
  expect(materials[0]!.color).not.toBe(materials[1]!.color);
  expect([...rgb.slice(9)].map((part) => Math.round(part * 255))).toEqual([153, 153, 153]);
});

test("the mean of the colours", () => {
  const rgb = new Float32Array([1, 0, 0, 0, 0, 1]);
  expect(meanColor({ elements: "face", rgb, materials: [] })).toBe("#800080");
});
