import { expect, test } from "vitest";
import { cameraFor } from "../../../src/app/compare/fit_both";

test("the camera keeps its direction and sees both boxes", () => {
  const camera = {
    projection: "perspective" as const,
    target: [1, 0, 0] as const,
    rest: [0, 0, 0] as const,
    direction: [1, 0, 0] as const,
    up: [0, 0, 1] as const,
    height: 5,
  };
  const fitted = cameraFor(camera, [
    [0, 2, 0, 2, 0, 2],
    [4, 6, 0, 2, 0, 4],
  ]);
  expect(fitted.target).toEqual([3, 1, 2]);
  expect(fitted.height).toBeCloseTo(Math.hypot(6, 2, 4));
  expect(fitted.direction).toEqual([1, 0, 0]);
});
