import { Box3 } from "three";
import { expect, test } from "vitest";

import { looking } from "../../../src/scene/camera";
import { newLight } from "../../../src/scene/lights";
import { Projector } from "../../../src/scene/projection";
import { kDefaultCamera, kDefaultState } from "../../../src/scene/state";

test("the marker of a new light is in sight, so that it can be dragged", () => {
  const projector = new Projector();
  projector.size = { width: 400, height: 400 };
  for (const projection of ["perspective", "orthographic"] as const)
    for (const place of [0, 1e12]) {
      const target = [place, place, 0] as const;
      const camera = { ...looking({ ...kDefaultCamera, target }, "isometric"), projection };
      projector.camera(camera, new Box3());
      const first = newLight(kDefaultState.lights, camera);
      const second = newLight({ ...kDefaultState.lights, lights: [first] }, camera);
      expect([first.id, second.id]).toEqual([1, 2]);
      for (const { position } of [first, second]) {
        const { x, y } = projector.project(position);
        for (const part of [x, y]) {
          expect(part).toBeGreaterThan(20);
          expect(part).toBeLessThan(380);
        }
      }
    }
});
