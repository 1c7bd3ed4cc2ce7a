import { describe, expect, it } from "vitest";

import {
  categoryColor,
  isColor,
  kOtherColor,
  kUndefinedColor,
  mix,
  paletteColor,
  scaleOf,
} from "../../../src/scene/colors";

describe("colours", () => {
  it("mixes", () => {
    expect(mix("#000000", "#ffffff", 0)).toBe("#000000");
    expect(mix("#000000", "#ffffff", 1)).toBe("#ffffff");
    expect(mix("#ff0000", "#0000ff", 0.5)).toBe("#800080");
  });

  it("recognises colours", () => {
    expect(isColor("#12aBcD")).toBe(true);
    for (const bad of ["#123", "red", "#12345g", 5, null, "#1234567"]) expect(isColor(bad)).toBe(false);
  });

  it("scales numbers from the first to the last colour of the palette", () => {
    const { legend, color } = scaleOf("Volume", "viridis", [3, 1, null, 2]);
    expect(legend).toMatchObject({ kind: "numbers", attribute: "Volume", min: 1, max: 3, undefinedCount: 1 });
    expect(color(1)).toBe(paletteColor("viridis", 0));
    expect(color(3)).toBe(paletteColor("viridis", 1));
    expect(color(2)).toBe("#21918c");
    expect(color(null)).toBe(kUndefinedColor);
  });

  it("gives equal numbers the middle, not a division by zero", () => {
    expect(scaleOf("N", "greys", [5, 5]).color(5)).toBe(paletteColor("greys", 0.5));
  });

  it("gives each category a colour of its own, the most frequent first", () => {
    const { legend, color } = scaleOf("Kind", "viridis", ["nut", "bolt", "bolt", true, null, "undefined"]);
    expect(legend.kind === "categories" && legend.entries.map(({ label, count }) => [label, count])).toEqual([
      ["bolt", 2],
      ["nut", 1],
      ["TRUE", 1],
      ["undefined", 1],
      ["undefined", 1],
    ]);
    expect(color("bolt")).toBe(categoryColor(0));
    expect(color("undefined")).not.toBe(color(null));
    expect(new Set(["bolt", "nut", true, "undefined", null].map((value) => color(value))).size).toBe(5);
  });

  it("keeps 36 categories apart and counts the others", () => {
    const values = Array.from({ length: 50 }, (_, i) => `k${String(i).padStart(2, "0")}`);
    const { legend, color } = scaleOf("K", "viridis", values);
    expect(legend.kind === "categories" && [legend.entries.length, legend.others]).toEqual([36, 14]);
    expect(new Set(values.slice(0, 36).map((value) => color(value))).size).toBe(36);
    expect(color("k49")).toBe(kOtherColor);
  });
});
