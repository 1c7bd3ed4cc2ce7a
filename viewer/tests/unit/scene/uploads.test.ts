import { BufferAttribute, BufferGeometry } from "three";
import { expect, test } from "vitest";

import { finishUploads, kLargeBytes, takeReserved, uploadNext } from "../../../src/scene/uploads";

/** Of so many numbers, all of them positions. */
function geometryOf(numbers: number): { geometry: BufferGeometry; attribute: BufferAttribute } {
  const geometry = new BufferGeometry();
  const attribute = new BufferAttribute(new Float32Array(numbers), 3);
  geometry.setAttribute("position", attribute);
  return { geometry, attribute };
}

/** A context that notes what it is given: bytes, or room for them. */
function context(): { gl: WebGL2RenderingContext; given: (number | "copy")[] } {
  const given: (number | "copy")[] = [];
  const bufferData = (_: number, data: number | ArrayBufferView): void => {
    given.push(typeof data === "number" ? data : "copy");
  };
  const gl = { bufferData } as unknown as WebGL2RenderingContext;
  takeReserved(gl);
  return { gl, given };
}

test("a large array gets room first, and then its content in ranges", () => {
  const numbers = (2.5 * kLargeBytes) / 4;
  const { geometry, attribute } = geometryOf(numbers);
  const { gl, given } = context();
  expect(uploadNext(geometry, kLargeBytes)).toBeGreaterThan(0);
  gl.bufferData(1, attribute.array, 2);
  const ranges: number[][] = [];
  while (uploadNext(geometry, kLargeBytes) > 0) {
    ranges.push(...attribute.updateRanges.map(({ start, count }) => [start, count]));
    attribute.clearUpdateRanges();
  }
  expect(attribute.version).toBe(3);
  expect(ranges).toEqual([
    [0, 1_000_000],
    [1_000_000, 1_000_000],
    [2_000_000, 500_000],
  ]);
  // A context that comes back gets all of it.
  gl.bufferData(1, attribute.array, 2);
  expect(given).toEqual([numbers * 4, "copy"]);
});

test("what is begun can be finished at once, and small arrays are left to the renderer", () => {
  const { geometry, attribute } = geometryOf(kLargeBytes / 2);
  uploadNext(geometry, 1);
  uploadNext(geometry, 1000);
  finishUploads();
  expect(attribute.updateRanges.map(({ start, count }) => [start, count])).toEqual([
    [0, 250],
    [250, kLargeBytes / 2 - 250],
  ]);
  expect(uploadNext(geometry, 1000)).toBe(0);
  expect(uploadNext(geometryOf(300).geometry, 1000)).toBe(0);
});
