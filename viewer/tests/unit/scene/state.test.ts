import { describe, expect, it } from "vitest";

import { kDefaultState, patched, stateToJson } from "../../../src/scene/state";
import { stateFromJson } from "../../../src/scene/state_json";
import { overridden } from "../../../src/scene/coloring";
import type { SceneState } from "../../../src/scene/api";

describe("the state", () => {
  it("tells which parts a patch changed", () => {
    const { state, parts } = patched(kDefaultState, { display: { grid: true }, section: { on: false } });
    expect(parts).toEqual(["display"]);
    expect(state.display.grid).toBe(true);
    expect(state.display.axes).toBe(true);
    expect(kDefaultState.display.grid).toBe(false);
  });

  it("goes to JSON and back", () => {
    const changed = patched(kDefaultState, {
      camera: { projection: "orthographic", direction: [0.6, 0, 0.8], target: [0, 0, 1e9], height: 2e-5 },
      appearance: {
        edges: "all",
        scheme: { by: "attribute", attribute: "Volume", palette: "magma" },
        background: "#ffffff",
      },
      navigation: { preset: "blender" },
      lights: {
        lights: [{ id: 3, on: true, color: "#ff0000", brightness: 2, position: [1, 1, 1], reach: 9 }],
      },
      section: { on: true, normal: [0, 1, 0] },
      display: { arrangement: "exploded", explode: 0.5, sortBy: "Volume" },
      index: { name: "Parts_Solid", level: 2 },
      overrides: [{ cell: { result: "r1", row: 4, column: "Solid" }, color: "#00ff00" }],
    }).state;
    const json = JSON.parse(JSON.stringify(stateToJson(changed))) as unknown;
    const { patch, rejected } = stateFromJson(json);
    expect(rejected).toEqual([]);
    expect(patched(kDefaultState, patch).state).toEqual(changed);
  });

  it("writes only what differs", () => {
    expect(Object.keys(stateToJson(kDefaultState))).toEqual(["camera"]);
    const { state } = patched(kDefaultState, { display: { grid: true } });
    expect(stateToJson(state)["display"]).toEqual({ grid: true });
  });

  it("takes only names and whole levels of an index, which become a part of a statement", () => {
    for (const index of [{ name: "a nodes count; delete b" }, { name: "1a" }, { level: 1.5 }, { level: -1 }])
      expect(stateFromJson({ index }).rejected).toEqual([`index.${Object.keys(index)[0] ?? ""}`]);
  });

  it("takes the eye of former links for a direction", () => {
    const { patch, rejected } = stateFromJson({ camera: { position: [1, 2, 13], target: [1, 2, 3] } });
    expect(patch.camera).toEqual({ direction: [0, 0, 10], target: [1, 2, 3], rest: [0, 0, 0] });
    expect(rejected).toEqual([]);
  });

  it("leaves out what it does not understand, and says so", () => {
    const { patch, rejected } = stateFromJson({
      camera: { direction: [1, 2], height: -1, up: [0, 0, 0], projection: "fisheye", target: [1, 2, 3] },
      appearance: { color: "javascript:alert(1)", opacity: 7, scheme: { by: "attribute" }, faces: false },
      __proto__: { x: 1 },
      constructor: {},
      overrides: [{ cell: { result: "r", row: -1, column: "c" } }],
      lights: { lights: [{ id: 1 }] },
    });
    expect(patch).toEqual({ camera: { target: [1, 2, 3] }, appearance: { faces: false }, lights: {} });
    expect(rejected).toEqual([
      "camera.direction",
      "camera.height",
      "camera.up",
      "camera.projection",
      "appearance.color",
      "appearance.opacity",
      "appearance.scheme",
      "constructor",
      "overrides",
      "lights.lights",
    ]);
    expect(stateFromJson(null).rejected).toEqual(["the whole view"]);
  });
});

describe("overrides", () => {
  const cell = { result: "r1", row: 4, column: "Solid" };
  const other = { ...cell, row: 5 };

  it("are merged by object, and removed when they go back to the default", () => {
    let overrides: SceneState["overrides"] = overridden([], [cell, other], { color: "#ff0000" });
    overrides = overridden(overrides, [cell], { pointSize: 9 });
    expect(overrides).toEqual([
      { cell, color: "#ff0000", pointSize: 9 },
      { cell: other, color: "#ff0000" },
    ]);
    overrides = overridden(overrides, [other], { color: undefined });
    expect(overrides).toEqual([{ cell, color: "#ff0000", pointSize: 9 }]);
  });
});
