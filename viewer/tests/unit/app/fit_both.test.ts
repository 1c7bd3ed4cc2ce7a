import { expect, test } from "vitest";
import { boxAround } from "../../../src/app/compare/fit_both";

test("the box around several boxes", () => {
  expect(
    boxAround([
      [0, 2, -1, 2, 0, 2],
      [4, 6, 0, 2, -3, 4],
    ]),
  ).toEqual([0, 6, -1, 2, -3, 4]);
});
