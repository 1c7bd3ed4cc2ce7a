import { describe, expect, it, test } from "vitest";

import { entryPoint, isInCorner } from "../../../src/scene/furniture";
import { formatStep, multiples, roundStep } from "../../../src/scene/steps";

describe("round steps", () => {
  it.each([
    [1, 1],
    [1.01, 2],
    [3, 5],
    [7, 10],
    [0.03, 0.05],
    [1e-9, 1e-9],
    [4.2e12, 5e12],
  ])("of at least %d is %d", (length, step) => {
    expect(roundStep(length)).toBeCloseTo(step, 20);
  });

  it("are written with the digits of the step", () => {
    expect(formatStep(0.30000000000000004, 0.1)).toBe("0.3");
    expect(formatStep(-1e-18, 0.1)).toBe("0");
    expect(formatStep(250, 50)).toBe("250");
    expect(formatStep(1e9 + 5, 5)).toBe("1000000005");
    expect(formatStep(1e12 + 0.5, 0.5)).toBe("1000000000000.5");
    expect(formatStep(1e15 + 5, 5)).toBe("1000000000000005");
    expect(formatStep(2e12, 2e12)).toBe("2000000000000");
  });

  it("have their multiples in a range", () => {
    expect(multiples(-0.5, 2, 0.5, 100)).toEqual([-0.5, 0, 0.5, 1, 1.5, 2]);
    expect(multiples(0, 1000, 1, 3)).toHaveLength(3);
  });
});

describe("entryPoint", () => {
  const size = { width: 100, height: 50 };
  it("finds where a line comes into the view", () => {
    expect(entryPoint({ x: -90, y: 25 }, { x: 110, y: 25 }, size, 10)).toEqual({ x: 10, y: 25 });
    expect(entryPoint({ x: 50, y: 20 }, { x: 50, y: 500 }, size, 10)).toEqual({ x: 50, y: 20 });
    expect(entryPoint({ x: 50, y: 60 }, { x: 70, y: 90 }, size, 0)).toBeNull();
  });
});

test("numbers of the grid are not written over the axes and the scale bar", () => {
  const size = { width: 1000, height: 500 };
  expect(isInCorner({ x: 46, y: 454 }, size)).toBe(true);
  expect(isInCorner({ x: 900, y: 470 }, size)).toBe(true);
  expect(isInCorner({ x: 500, y: 480 }, size)).toBe(false);
  expect(isInCorner({ x: 20, y: 200 }, size)).toBe(false);
});
