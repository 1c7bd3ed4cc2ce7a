import { describe, expect, it } from "vitest";

import {
  buttonsOf,
  describePreset,
  kNavigationPresets,
  motionOf,
  wheelMotion,
} from "../../../src/scene/navigation";

const none = { shift: false, ctrl: false, alt: false };

describe("navigation presets", () => {
  it("default: left rotates, right pans, wheel and Alt zoom", () => {
    expect(motionOf("default", ["left"], none)).toBe("rotate");
    expect(motionOf("default", ["right"], none)).toBe("pan");
    expect(motionOf("default", ["left"], { ...none, alt: true })).toBe("zoom");
    const away = wheelMotion("default", { x: 0, y: 100, mode: 0, ctrl: false, shift: false });
    expect(away).toEqual({ motion: "zoom", x: 0, y: 100 });
  });

  it.each([
    ["blender", ["middle"], none, "rotate"],
    ["blender", ["middle"], { ...none, shift: true }, "pan"],
    ["solidworks", ["middle"], { ...none, ctrl: true }, "pan"],
    ["fusion", ["middle"], { ...none, shift: true }, "rotate"],
    ["onshape", ["right"], none, "rotate"],
    ["freecad", ["left", "middle"], none, "rotate"],
    ["maya", ["left"], { ...none, alt: true }, "rotate"],
    ["f3d", ["right"], none, "zoom"],
    ["rhino", ["right"], { ...none, shift: true }, "pan"],
  ] as const)("%s: %s with %o", (preset, buttons, modifiers, motion) => {
    expect(motionOf(preset, buttons, modifiers)).toBe(motion);
  });

  it("every preset can rotate, pan and zoom, and tells how", () => {
    for (const { id } of kNavigationPresets) {
      const motions = describePreset(id).map(([, motion]) => motion);
      expect(motions).toContain("rotate");
      expect(motions).toContain("pan");
      expect(motions.some((motion) => motion.includes("zoom"))).toBe(true);
    }
  });

  it("turns the wheel the other way round where the program does", () => {
    const turn = { x: 0, y: 100, mode: 0, ctrl: false, shift: false };
    expect(wheelMotion("solidworks", turn).y).toBe(-100);
    // A pinch is a pinch everywhere.
    expect(wheelMotion("solidworks", { ...turn, ctrl: true }).y).toBe(300);
    expect(wheelMotion("touchpad", turn).motion).toBe("rotate");
    expect(wheelMotion("default", { ...turn, mode: 1 }).y).toBe(1800);
  });

  it("reads the buttons of events", () => {
    expect(buttonsOf(1)).toEqual(["left"]);
    expect(buttonsOf(2)).toEqual(["right"]);
    expect(buttonsOf(5)).toEqual(["left", "middle"]);
  });
});
