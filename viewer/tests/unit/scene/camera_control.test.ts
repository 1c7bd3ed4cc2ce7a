import { Box3, Vector3 } from "three";
import { afterEach, beforeEach, expect, test, vi } from "vitest";

import type { CameraState } from "../../../src/scene/api";
import { cameraDifference, looking } from "../../../src/scene/camera";
import { CameraControl } from "../../../src/scene/camera_control";
import { kDefaultCamera } from "../../../src/scene/state";

let reduced = false;
let camera: CameraState;
let shown: CameraState[];
let control: CameraControl;

beforeEach(() => {
  // Node.js has no frames; timers stand in for them.
  vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout", "performance"] });
  vi.stubGlobal("requestAnimationFrame", (step: () => void) => Number(setTimeout(step, 16)));
  vi.stubGlobal("cancelAnimationFrame", (id: number) => clearTimeout(id));
  vi.stubGlobal("matchMedia", () => ({ matches: reduced }));
  reduced = false;
  camera = looking(kDefaultCamera, "front");
  shown = [];
  control = new CameraControl({
    camera: () => camera,
    show: (next) => {
      camera = next;
      shown.push(next);
    },
    aspect: () => 1.5,
    isBlind: () => false,
  });
});

afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

const top = (): CameraState => looking(kDefaultCamera, "top");

test("the camera goes to its goal in several frames", () => {
  control.go(top());
  expect(shown).toHaveLength(0);
  expect(cameraDifference(control.goal, top())).toBeLessThan(1e-9);
  vi.advanceTimersByTime(1000);
  expect(shown.length).toBeGreaterThan(10);
  expect(cameraDifference(camera, top())).toBeLessThan(1e-9);
});

test("it jumps where animations are not wanted, and when the projection changes", () => {
  reduced = true;
  control.go(top());
  expect(shown).toHaveLength(1);
  reduced = false;
  control.go({ ...top(), projection: "orthographic" });
  expect(shown).toHaveLength(2);
});

test("it can be stopped on its way, or brought to its end", () => {
  control.go(top());
  vi.advanceTimersByTime(100);
  control.stop();
  const count = shown.length;
  vi.advanceTimersByTime(1000);
  expect(shown).toHaveLength(count);
  control.go(top());
  control.finish();
  expect(cameraDifference(camera, top())).toBeLessThan(1e-9);
});

test("a second movement starts from the goal of the first", () => {
  control.go(top());
  control.fit(new Box3(new Vector3(0, 0, 0), new Vector3(2, 2, 2)));
  vi.advanceTimersByTime(1000);
  expect(camera.target).toEqual([1, 1, 1]);
  expect(camera.direction[2]).toBeCloseTo(1, 9);
});
