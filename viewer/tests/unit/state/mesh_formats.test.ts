import { expect, test } from "vitest";
import type { MeshFormat } from "../../../src/api/types";
import { downloadsOf, importerOf, listedFormats, unreadFormat } from "../../../src/state/mesh_formats";

function format(name: string, endings: string[], forms: [string, boolean][]): MeshFormat {
  return {
    name,
    endings,
    importer: `import${name}`,
    polygons: true,
    names: false,
    attributes: false,
    forms: forms.map(([form, binary]) => ({
      format: form,
      binary,
      coordinates: "floats",
      mediaType: "model/mesh",
    })),
  };
}

const wide = format(
  "WIDE",
  [".wide", ".wd"],
  [
    ["wide", true],
    ["wide-ascii", false],
  ],
);
const flat = format("FLAT", [".flat"], [["flat", false]]);

test("each form of each format is a download", () => {
  expect(downloadsOf([wide, flat]).map(({ form, label, ending }) => [form.format, label, ending])).toEqual([
    ["wide", "WIDE", ".wide"],
    ["wide-ascii", "WIDE (text)", ".wide"],
    ["flat", "FLAT", ".flat"],
  ]);
  expect(downloadsOf([])).toEqual([]);
});

test("the ending of a file says which operator imports it", () => {
  const importers = ["a.WIDE", "b.wd", "c.flat", "d.csv", "wide", "e.flat.zip"];
  expect(importers.map((name) => importerOf([wide, flat], name))).toEqual([
    "importWIDE",
    "importWIDE",
    "importFLAT",
    null,
    null,
    null,
  ]);
});

test("formats in a sentence", () => {
  expect(listedFormats([])).toBe("mesh");
  expect(listedFormats([flat])).toBe("FLAT");
  expect(listedFormats([wide, flat])).toBe("WIDE or FLAT");
  expect(listedFormats([flat, wide, flat])).toBe("FLAT, WIDE or FLAT");
});

test("formats of geometry that are not read are known by their endings", () => {
  expect(unreadFormat("Part.PLY")).toBe("PLY");
  expect(unreadFormat("a.b.step")).toBe("STEP");
  expect(unreadFormat("prices.csv")).toBeNull();
  expect(unreadFormat("part.stl")).toBeNull();
  expect(unreadFormat("toString")).toBeNull();
});
