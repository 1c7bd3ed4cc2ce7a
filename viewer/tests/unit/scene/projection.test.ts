import { Box3, Vector3, Vector4 } from "three";
import { describe, expect, it } from "vitest";

import { fitted, normalizedCamera } from "../../../src/scene/camera";
import { Projector } from "../../../src/scene/projection";
import { kDefaultCamera } from "../../../src/scene/state";

describe("the projection of objects of any size", () => {
  const projector = new Projector();
  projector.size = { width: 600, height: 400 };

  const projected = (size: number, projection: "perspective" | "orthographic") => {
    const box = new Box3(new Vector3(0, 0, 0), new Vector3(size, size, size));
    const state = fitted(normalizedCamera({ ...kDefaultCamera, projection }), box, 1.5);
    const camera = projector.camera(state, box);
    const place = projector.project([size, 0.25 * size, 0.5 * size]);
    const clip = new Vector4(size, 0, 0, 1)
      .applyMatrix4(camera.matrixWorldInverse)
      .applyMatrix4(camera.projectionMatrix);
    return { place, clip, camera };
  };

  for (const projection of ["perspective", "orthographic"] as const)
    it(`shows the same in ${projection}`, () => {
      const { place } = projected(1, projection);
      for (const size of [1e-25, 1e-12, 1e12, 1e20, 1e36]) {
        const other = projected(size, projection);
        expect(other.place.x).toBeCloseTo(place.x, 3);
        expect(other.place.y).toBeCloseTo(place.y, 3);
        expect(other.place.depth).toBeCloseTo(place.depth, 3);
        // What the graphics card interpolates with stays far from the ends of its floats.
        for (const part of other.clip.toArray()) expect(Math.abs(part)).toBeLessThan(1e10);
        expect(Math.abs(other.clip.w)).toBeGreaterThan(projection === "perspective" ? 1e-3 : 1e-40);
        const both = other.camera.projectionMatrix.clone().multiply(other.camera.projectionMatrixInverse);
        expect(both.elements[0]).toBeCloseTo(1, 9);
        expect(both.elements[15]).toBeCloseTo(1, 6);
      }
    });

  for (const projection of ["perspective", "orthographic"] as const)
    it(`sees what is near in ${projection}, however far something else is`, () => {
      const near = new Box3(new Vector3(0, 0, 0), new Vector3(1, 1, 1));
      const state = fitted(normalizedCamera({ ...kDefaultCamera, projection }), near, 1.5);
      for (const distance of [1e2, 1e6, 1e12])
        for (const sign of [-1, 1]) {
          const far = new Box3()
            .copy(near)
            .expandByPoint(new Vector3(sign, -sign, sign).multiplyScalar(distance));
          projector.camera(state, far);
          const [front, back] = [projector.project([1, 0, 1]), projector.project([0, 1, 0])];
          for (const { depth } of [front, back]) expect(Math.abs(depth)).toBeLessThan(1);
          // 24 bits of the depth buffer tell them apart.
          expect(back.depth - front.depth).toBeGreaterThan(100 * 2 ** -23);
        }
    });
});
