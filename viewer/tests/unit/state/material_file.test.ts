import { expect, test } from "vitest";

import { readMaterialFile } from "../../../src/state/material_file";

test("diffuse colours of materials by their names, with one number for all three", () => {
  const text =
    "# bricks\nnewmtl red brick\nKa 0 0 0\nKd 1 0.5 0\r\nmap_Kd red.png\n\nnewmtl grey\n  Kd 0.2\nnewmtl none\nKd spectral x.rfl\n";
  expect(readMaterialFile(text)).toEqual({
    colors: { "red brick": "#ff8000", grey: "#333333" },
    textures: 1,
  });
});

test("a colour before the first material belongs to none", () => {
  expect(readMaterialFile("Kd 1 1 1\n")).toEqual({ colors: {}, textures: 0 });
});
