import { Box3, Scene, Vector3 } from "three";
import { expect, test } from "vitest";

import type { Transformation, TransformMode } from "../../../src/scene/api";
import { TransformHandle } from "../../../src/scene/transform_handle";
import { cube } from "./support/solids";
import { sceneOf } from "./support/store";

/** A cube of side 2 with its handle, seen along -z. */
function handleOf(mode: TransformMode) {
  const { store, projector, camera } = sceneOf([cube(0, 2)]);
  const handle = new TransformHandle(new Scene(), store, projector);
  handle.target = { cell: [...store.records()][0]!.cell, how: mode };
  const box = new Box3(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
  const state = { ...camera, direction: [0, 0, 1], up: [0, 1, 0], target: [0, 0, 0], height: 8 } as const;
  handle.update(projector.camera({ ...state, projection: "orthographic" }, box));
  const done: Transformation[] = [];
  const host = {
    redraw: () => undefined,
    transformed: (_cell: unknown, map: Transformation) => done.push(map),
  };
  const { x, y } = projector.project([0, 0, 0]);
  const pixels = projector.size.height / state.height;
  /** Drags from the first place along x where the handle is, by coordinate units. */
  const drag = (dx: number, dy: number): boolean => {
    for (let reach = 5; reach < 2 * pixels; reach++) {
      const dragged = handle.grab(x + reach, y, host);
      if (!dragged) continue;
      dragged.move(x + reach + dx * pixels, y - dy * pixels, {} as PointerEvent);
      dragged.end(x + reach + dx * pixels, y - dy * pixels);
      return true;
    }
    return false;
  };
  return { handle, drag, done };
}

test("the middle moves in the plane of the view", () => {
  const { drag, done } = handleOf("translate");
  expect(drag(1.5, 0.5)).toBe(true);
  expect(done).toHaveLength(1);
  const [move] = done as [Extract<Transformation, { mode: "translate" }>];
  expect(move.by[0]).toBeCloseTo(1.5, 6);
  expect(Math.abs(move.by[2])).toBeLessThan(1e-9);
});

test("boxes scale about the middle", () => {
  const { drag, done } = handleOf("scale");
  expect(drag(1, 0)).toBe(true);
  const [scale] = done as [Extract<Transformation, { mode: "scale" }>];
  expect(scale.about).toEqual([0, 0, 0]);
  expect(scale.factors[0]).toBeGreaterThan(1);
});

test("rings turn about the middle, by a unit axis and degrees", () => {
  const { drag, done } = handleOf("rotate");
  expect(drag(0.7, 0.3)).toBe(true);
  const [turn] = done as [Extract<Transformation, { mode: "rotate" }>];
  expect(turn.about).toEqual([0, 0, 0]);
  expect(Math.hypot(...turn.axis)).toBeCloseTo(1, 12);
  expect(Math.abs(turn.degrees)).toBeGreaterThan(1);
});

test("a press without a movement changes nothing", () => {
  const { drag, done } = handleOf("translate");
  expect(drag(0, 0)).toBe(true);
  expect(done).toEqual([]);
});

test("without a target there is no handle", () => {
  const { handle, drag } = handleOf("translate");
  handle.target = null;
  expect(drag(1, 0)).toBe(false);
});
