import { Box3, Vector3 } from "three";
import { expect, it } from "vitest";

import { isDotBeside, mainBox } from "../../../src/scene/main_box";

const cube = (x: number, size = 1) => new Box3(new Vector3(x, 0, 0), new Vector3(x + size, size, size));
const row = [0, 2, 4, 6].map((x) => cube(x));

it("takes all objects that lie together", () => {
  expect(mainBox([]).box.isEmpty()).toBe(true);
  expect(mainBox([cube(5)])).toEqual({ box: cube(5), far: 0 });
  expect(mainBox([...row, cube(60)])).toEqual({ box: cube(0).union(cube(60)), far: 0 });
  // Of two nobody is the main one.
  expect(mainBox([cube(0), cube(1e9)])).toEqual({ box: cube(0).union(cube(1e9)), far: 0 });
});

it("leaves out the few that are far away, and the empty ones", () => {
  const all = cube(0).union(cube(6));
  expect(mainBox([...row, cube(1e9)])).toEqual({ box: all, far: 1 });
  expect(mainBox([cube(-1e9), new Box3(), ...row, new Box3()])).toEqual({ box: all, far: 1 });
});

it("keeps one large object among small ones at its place", () => {
  const dots = row.map(({ min }) => new Box3(min, min));
  expect(mainBox([...dots, ...dots, cube(-50, 100)]).far).toBe(0);
});

it("keeps points that lie in one place", () => {
  const point = new Box3(new Vector3(1, 1, 1), new Vector3(1, 1, 1));
  expect(mainBox([point, point, point, cube(1e6)])).toEqual({ box: point.clone().union(cube(1e6)), far: 0 });
});

it("tells what would become a dot in a picture with something else", () => {
  expect(isDotBeside(cube(0), cube(1e6))).toBe(true);
  expect(isDotBeside(cube(0), cube(20))).toBe(false);
  expect(isDotBeside(cube(0), new Box3())).toBe(false);
  const point = new Box3(new Vector3(1, 1, 1), new Vector3(1, 1, 1));
  expect(isDotBeside(point, cube(1e6))).toBe(false);
});
