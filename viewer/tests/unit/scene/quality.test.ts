import { expect, test } from "vitest";

import { Quality } from "../../../src/scene/quality";

const few = { fine: 1_000, coarse: 1_000 };

function observe(quality: Quality, milliseconds: number, frames: number): void {
  for (let i = 0; i < frames; i++) quality.observe(milliseconds);
}

test("stays fine as long as frames are fast", () => {
  const quality = new Quality(false);
  quality.begin(few);
  observe(quality, 17, 100);
  expect(quality.step).toEqual({ scale: 1, edges: true, coarse: false });
});

test("lowers the resolution first, and takes coarse levels at last", () => {
  const quality = new Quality(false);
  quality.begin(few);
  observe(quality, 50, 6);
  expect(quality.step.scale).toBeLessThan(1);
  expect(quality.step.coarse).toBe(false);
  observe(quality, 50, 12);
  expect(quality.step.coarse).toBe(true);
});

test("the first frames of a movement do not count", () => {
  const quality = new Quality(false);
  quality.begin(few);
  observe(quality, 500, 3);
  observe(quality, 17, 30);
  expect(quality.step.scale).toBe(1);
  expect(quality.step.coarse).toBe(false);
});

test("a step that was too slow is tried again after a while, and in the next movement", () => {
  const quality = new Quality(false);
  quality.begin(few);
  observe(quality, 50, 6);
  observe(quality, 10, 30);
  expect(quality.step.scale).toBeLessThan(1);
  observe(quality, 10, 60);
  expect(quality.step.scale).toBe(1);
});

test("without hardware, coarse levels from the start where there are too many triangles, but not for 200,000", () => {
  const quality = new Quality(true);
  quality.begin({ fine: 1_000_000, coarse: 20_000 });
  observe(quality, 10, 200);
  expect(quality.step.coarse).toBe(true);
  const other = new Quality(true);
  other.begin({ fine: 200_000, coarse: 20_000 });
  expect(other.step.coarse).toBe(false);
});
