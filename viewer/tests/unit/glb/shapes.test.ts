import { describe, expect, it } from "vitest";

import { decodeShapes } from "../../../src/glb/shapes";
import { buildGlb } from "../scene/support/glb_builder";
import { cube, points, sphere, square } from "../scene/support/solids";

describe("decodeShapes", () => {
  it("reads row, kind, box, translation and counts", () => {
    const [shape] = decodeShapes(buildGlb([cube(7, 2, [1e9, 5, -3])]));
    expect(shape).toMatchObject({
      row: 7,
      kind: "volume3d",
      triangles: 12,
      shown: 12,
      translation: [1e9, 5, -3],
    });
    expect(shape?.box).toEqual([1e9 - 1, 1e9 + 1, 4, 6, -4, -2]);
  });

  it("gives views into the one buffer and copies nothing", () => {
    const bytes = buildGlb([sphere(0, 1, 30, [0, 0, 0], { tree: true })]);
    const faces = decodeShapes(bytes)[0]!.primitives.find((p) => p.role === "faces")!;
    for (const array of [faces.positions, faces.normals!.array, faces.indices!, faces.tree!]) {
      expect(array.buffer).toBe(bytes);
    }
    expect(faces.normals!.stride).toBe(4);
    expect(faces.tree!.byteLength % 32).toBe(0);
  });

  it("reads all roles, and cells without geometry", () => {
    const shapes = decodeShapes(
      buildGlb([square(0, 1), { ...cube(1, 1), empty: true }, points(2, [0, 0, 0, 1, 2, 3]), cube(3, 1)]),
    );
    expect(shapes.map((s) => s.primitives.map((p) => p.role))).toEqual([
      ["faces", "boundary"],
      [],
      ["points"],
      ["faces", "edges"],
    ]);
    expect(shapes[2]!.primitives[0]!.indices).toBeNull();
    expect([...shapes[2]!.primitives[0]!.positions]).toEqual([0, 0, 0, 1, 2, 3]);
  });

  it("reads 32-bit indices, numbers of faces and vertices, and the deviation", () => {
    const ids = { faceIds: [70000, 3], vertexIds: [9, 8, 7, 6], deviation: 0.25 };
    const faces = decodeShapes(buildGlb([square(0, 1, [0, 0, 0], ids)]))[0]!.primitives[0]!;
    expect([...faces.faceIds!]).toEqual([70000, 3]);
    expect([...faces.vertexIds!]).toEqual([9, 8, 7, 6]);
    expect(faces.deviation).toBe(0.25);
  });

  it("refuses what is not binary glTF, or goes beyond its end, and says where", () => {
    expect(() => decodeShapes(new ArrayBuffer(3))).toThrow("3 bytes are too few");
    expect(() => decodeShapes(new TextEncoder().encode('{"error": {"code": "gone"}}').buffer)).toThrow(
      "byte 0",
    );
    const bytes = buildGlb([cube(0, 1)]);
    expect(() => decodeShapes(bytes.slice(0, bytes.byteLength - 8))).toThrow("announces");
    const text = new Uint8Array(bytes);
    const count = new TextDecoder().decode(text).indexOf('"count":24');
    text.set(new TextEncoder().encode('"count":99'), count);
    expect(() => decodeShapes(bytes)).toThrow("goes to byte");
  });
});
