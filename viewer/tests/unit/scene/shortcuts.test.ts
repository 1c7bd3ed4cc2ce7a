import { describe, expect, it } from "vitest";

import { Quality } from "../../../src/scene/quality";
import { keyName, kShortcuts, searchShortcuts, shortcutOf } from "../../../src/scene/shortcuts";

const key = (name: string, more: Partial<KeyboardEvent> = {}): string =>
  keyName({ key: name, ctrlKey: false, metaKey: false, altKey: false, shiftKey: false, ...more });

describe("shortcuts", () => {
  it("have F3D's keys where it has them", () => {
    const f3d: Record<string, string> = {
      "1": "view.front",
      "3": "view.right",
      "7": "view.top",
      "9": "view.isometric",
      "5": "projection",
      Enter: "home",
      e: "edges",
      g: "grid",
      x: "axes",
      F12: "screenshot",
    };
    for (const [name, action] of Object.entries(f3d)) expect(shortcutOf(name)?.action).toBe(action);
  });

  it("are different keys for different actions", () => {
    const keys = kShortcuts.flatMap((shortcut) => shortcut.keys.split(" "));
    expect(new Set(keys).size).toBe(keys.length);
    expect(new Set(kShortcuts.map(({ action }) => action)).size).toBe(kShortcuts.length);
  });

  it("are recognised with modifiers", () => {
    expect(key("X", { shiftKey: true })).toBe("Shift+x");
    expect(key("?", { shiftKey: true })).toBe("?");
    expect(key("p", { metaKey: true })).toBe("Ctrl+p");
    expect(key("ArrowLeft", { shiftKey: true })).toBe("Shift+ArrowLeft");
    expect(shortcutOf(key("+", { shiftKey: true }))?.action).toBe("zoom.in");
  });

  it("are found by all their words", () => {
    expect(searchShortcuts("wire").map(({ action }) => action)).toEqual(["edges", "faces"]);
    expect(searchShortcuts("section back").map(({ action }) => action)).toEqual(["section.back"]);
    expect(searchShortcuts("")).toHaveLength(kShortcuts.length);
    expect(searchShortcuts("teapot")).toEqual([]);
  });
});

describe("Quality", () => {
  const observe = (quality: Quality, milliseconds: number, frames: number): void => {
    for (let i = 0; i < frames; i++) quality.observe(milliseconds);
  };

  it("is full on hardware, and lower step by step when frames are slow", () => {
    const quality = new Quality(false);
    expect(quality.step).toEqual({ scale: 1, edges: true, coarse: false });
    observe(quality, 40, 3);
    expect(quality.step.scale).toBe(0.8);
    observe(quality, 40, 30);
    expect(quality.step).toEqual({ scale: 0.4, edges: false, coarse: true });
  });

  it("takes coarse levels at once when frames are far too slow", () => {
    const quality = new Quality(true);
    observe(quality, 200, 3);
    expect(quality.step.coarse).toBe(true);
  });

  it("begins with coarse levels where the processor cannot draw the fine ones", () => {
    const quality = new Quality(true);
    quality.begin({ fine: 1_000_000, coarse: 20_000 });
    expect(quality.step.coarse).toBe(true);
    const hardware = new Quality(false);
    hardware.begin({ fine: 1_000_000, coarse: 20_000 });
    expect(hardware.step.coarse).toBe(false);
  });

  it("does not go back to a step that was too slow until the scene changes", () => {
    const quality = new Quality(false);
    observe(quality, 40, 3);
    observe(quality, 10, 30);
    expect(quality.step.scale).toBe(0.8);
    quality.reset();
    observe(quality, 10, 3);
    expect(quality.step.scale).toBe(1);
  });
});
