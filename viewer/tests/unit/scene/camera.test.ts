import { Box3, Vector3 } from "three";
import { describe, expect, it } from "vitest";

import {
  basisOf,
  between,
  cameraDifference,
  cornersOf,
  eyeDistance,
  fitted,
  looking,
  normalizedCamera,
  orbit,
  pan,
  placeInTargetPlane,
  turned,
  zoom,
} from "../../../src/scene/camera";
import type { CameraState, StandardView, Vec3 } from "../../../src/scene/api";
import { Projector } from "../../../src/scene/projection";
import { toVector3 } from "../../../src/scene/vec";
import { kDefaultCamera } from "../../../src/scene/state";

const start = normalizedCamera({ ...kDefaultCamera, target: [1, 2, 3] });

function close(a: Vec3, b: Vec3): void {
  for (const axis of [0, 1, 2] as const) expect(a[axis]).toBeCloseTo(b[axis], 9);
}

describe("movements of the camera", () => {
  it("keeps its direction where the eye could not be told from the target", () => {
    for (const far of [1e9, 1e17, 1e30]) {
      const box = new Box3(new Vector3(far, far, 0), new Vector3(far, far, 0));
      const camera = normalizedCamera(fitted(start, box, 1.5));
      const [before, after] = [basisOf(start).back, basisOf(camera).back];
      expect(after.distanceTo(before)).toBeLessThan(1e-15);
      const top = basisOf(looking(camera, "top"));
      expect(top.back.distanceTo(new Vector3(0, 0, 1))).toBeLessThan(1e-4);
    }
  });

  it("fits an object of size 1 as far as doubles tell it from its neighbours, and moves about it in small steps", () => {
    for (const far of [1e12, 1e15]) {
      const box = new Box3(new Vector3(far, far, -far), new Vector3(far + 1, far + 1, 1 - far));
      const camera = fitted(start, box, 1);
      expect(camera.height).toBeLessThan(2);
      let moved = camera;
      for (let i = 0; i < 1000; i++) moved = pan(moved, 0.0007, 0);
      const by = new Vector3(...moved.target)
        .sub(new Vector3(...camera.target))
        .add(new Vector3(...moved.rest));
      const expected = basisOf(camera).right.multiplyScalar(-0.7 * camera.height);
      expect(by.distanceTo(expected)).toBeLessThan(1e-12);
      let turning = camera;
      for (let i = 0; i < 1000; i++) turning = orbit(turning, Math.PI / 500, 0, "turntable");
      expect(cameraDifference(turning, camera)).toBeLessThan(1e-9);
    }
  });

  it("sees what is tiny as something tiny", () => {
    const size = 1e-160;
    const camera = fitted(start, new Box3(new Vector3(0, 0, 0), new Vector3(size, size, size)), 1.5);
    expect(camera.height).toBe(1e-30);
    expect(basisOf(normalizedCamera(camera)).back.distanceTo(basisOf(start).back)).toBeLessThan(1e-9);
  });

  it("looks from the standard sides", () => {
    const backs: Record<StandardView, Vec3> = {
      front: [0, -1, 0],
      back: [0, 1, 0],
      left: [-1, 0, 0],
      right: [1, 0, 0],
      top: [0, 0, 1],
      bottom: [0, 0, -1],
      isometric: [1 / Math.sqrt(3), -1 / Math.sqrt(3), 1 / Math.sqrt(3)],
    };
    for (const [view, back] of Object.entries(backs)) {
      const camera = looking(start, view as StandardView);
      close(basisOf(camera).back.toArray(), back);
      expect(camera.target).toEqual([1, 2, 3]);
    }
    close(basisOf(looking(start, "front")).right.toArray(), [1, 0, 0]);
    close(basisOf(looking(start, "top")).right.toArray(), [1, 0, 0]);
  });

  it("orbits around the upright axis, and stops at the poles", () => {
    const front = looking(start, "front");
    // Dragging to the right turns the front away to the right: the left side comes into sight.
    close(basisOf(orbit(front, Math.PI / 2, 0, "turntable")).back.toArray(), [-1, 0, 0]);
    const above = orbit(front, 0, 10, "turntable");
    close(basisOf(above).back.toArray(), [0, 0, 1]);
    close(basisOf(orbit(above, 0, 1, "turntable")).back.toArray(), [0, 0, 1]);
    close(basisOf(orbit(above, 0, -Math.PI / 2, "turntable")).back.toArray(), [0, -1, 0]);
  });

  it("passes the poles with the trackball", () => {
    const over = orbit(looking(start, "front"), 0, Math.PI, "trackball");
    close(basisOf(over).back.toArray(), [0, 1, 0]);
    close(basisOf(over).up.toArray(), [0, 0, -1]);
  });

  it("pans by fractions of the height", () => {
    const front = looking(start, "front");
    close(pan(front, 0.5, 0).target, [1 - 5, 2, 3]);
    close(pan(front, 0, 0.25).target, [1, 2, 3 - 2.5]);
  });

  it("keeps the anchor of a zoom in place", () => {
    const projector = new Projector();
    projector.size = { width: 800, height: 600 };
    for (const projection of ["perspective", "orthographic"] as const) {
      const camera: CameraState = { ...start, projection };
      const anchor = placeInTargetPlane(camera, 0.6, -0.3, 800 / 600);
      projector.camera(camera, new Box3());
      const place = toVector3(camera.target).add(toVector3(anchor));
      const before = projector.project(place);
      const closer = zoom(camera, 0.4, anchor);
      expect(closer.height).toBeCloseTo(4, 12);
      projector.camera(closer, new Box3());
      const after = projector.project(place);
      expect(after.x).toBeCloseTo(before.x, 6);
      expect(after.y).toBeCloseTo(before.y, 6);
    }
  });

  it("rolls by quarter turns", () => {
    const front = looking(start, "front");
    close(basisOf(turned(front, "roll", 90)).right.toArray(), [0, 0, 1]);
    close(basisOf(turned(front, "side", -90)).back.toArray(), [0, 0, 1]);
    let camera = front;
    for (let i = 0; i < 4; i++) camera = turned(camera, "roll", 90);
    expect(cameraDifference(camera, front)).toBeLessThan(1e-12);
  });

  it("fits a box so that all corners are seen and two touch the border", () => {
    const box = new Box3(new Vector3(1e6, -3, 0), new Vector3(1e6 + 8, 5, 2));
    const projector = new Projector();
    for (const projection of ["perspective", "orthographic"] as const) {
      for (const [width, height] of [
        [1280, 720],
        [360, 700],
      ] as const) {
        projector.size = { width, height };
        const camera = fitted({ ...looking(start, "isometric"), projection }, box, width / height);
        projector.camera(camera, box);
        const places = cornersOf(box).map((corner) => projector.project(corner));
        const margins = places.map(({ x, y }) =>
          Math.min(x / width, 1 - x / width, y / height, 1 - y / height),
        );
        expect(Math.min(...margins)).toBeGreaterThan(0);
        expect(Math.min(...margins)).toBeLessThan(0.05);
      }
    }
  });

  it("goes from one camera to another", () => {
    const to = { ...looking(start, "top"), height: 1000 };
    expect(cameraDifference(between(start, to, 0), start)).toBeLessThan(1e-9);
    expect(between(start, to, 1)).toEqual(to);
    expect(between(start, to, 0.5).height).toBeCloseTo(100, 9);
  });
});

describe("Projector", () => {
  it("casts rays through what it projects, far from the origin too", () => {
    const projector = new Projector();
    projector.size = { width: 1000, height: 500 };
    const target: Vec3 = [3e8, -2e8, 5e7];
    for (const projection of ["perspective", "orthographic"] as const) {
      const camera = normalizedCamera({
        ...looking({ ...start, target }, "isometric"),
        projection,
        height: 2,
      });
      projector.camera(camera, new Box3());
      const point = new Vector3(...target).add(new Vector3(0.3, 0.2, -0.1));
      const { x, y, visible } = projector.project(point);
      expect(visible).toBe(true);
      expect(projector.ray(x, y).distanceToPoint(projector.toLocal(point))).toBeLessThan(1e-7);
    }
  });

  it("knows the size of a pixel", () => {
    const projector = new Projector();
    projector.size = { width: 1000, height: 500 };
    projector.camera(start, new Box3());
    expect(projector.unitsPerPixel(start.target)).toBeCloseTo(10 / 500, 12);
    const halfway = toVector3(start.target).addScaledVector(basisOf(start).back, eyeDistance(10) / 2);
    expect(projector.unitsPerPixel(halfway)).toBeCloseTo(5 / 500, 12);
  });
});
