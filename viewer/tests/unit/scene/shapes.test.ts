import { Ray, Vector3 } from "three";
import type { Mesh, Object3D } from "three";
import { describe, expect, it } from "vitest";

import { decodeShapes } from "../../../src/glb/shapes";
import { creaseLines, featureLines } from "../../../src/scene/features";
import { geometryOf, AttributeCache, primitiveOf, triangleEdges } from "../../../src/scene/geometry";
import type { Look } from "../../../src/scene/look";
import { closestOnLine, draggedTo, moveVertices, placeOf } from "../../../src/scene/vertex_drag";
import { buildGlb } from "./support/glb_builder";
import { cube, points, sphere } from "./support/solids";
import { kWhite, sceneOf } from "./support/store";

const look: Look = { ...kWhite, color: "#ff0000" };

describe("geometries", () => {
  it("draw from the bytes of the server", () => {
    const bytes = buildGlb([cube(0, 2)]);
    const faces = decodeShapes(bytes)[0]!.primitives[0]!;
    const geometry = geometryOf(faces, new AttributeCache(), null);
    expect(geometry.getAttribute("position").array.buffer).toBe(bytes);
    expect(geometry.getAttribute("normal").getZ(23)).toBeCloseTo(1, 6);
    expect(geometry.index!.array.buffer).toBe(bytes);
  });

  it("share one attribute of positions", () => {
    const shape = decodeShapes(buildGlb([cube(0, 2)]))[0]!;
    const cache = new AttributeCache();
    const [faces, edges] = shape.primitives.map((primitive) => geometryOf(primitive, cache, null));
    expect(faces!.getAttribute("position")).toBe(edges!.getAttribute("position"));
  });
});

describe("triangleEdges", () => {
  it("has each edge of a closed mesh once", () => {
    const faces = primitiveOf(decodeShapes(buildGlb([sphere(0, 1, 10)]))[0]!, "faces")!;
    const edges = triangleEdges(faces.indices!);
    expect(edges.length / 2).toBe((faces.indices!.length / 3) * 1.5);
    const keys = new Set<string>();
    for (let i = 0; i < edges.length; i += 2) keys.add(`${edges[i]!} ${edges[i + 1]!}`);
    expect(keys.size).toBe(edges.length / 2);
  });
});

describe("featureLines", () => {
  it("are the creases of a solid: all edges of a cube, none of a smooth ball", () => {
    const [box, ball] = decodeShapes(buildGlb([cube(0, 2), sphere(1, 1, 12)]));
    expect(featureLines(box!)!.length / 2).toBe(12);
    expect(featureLines(ball!)).toBeNull();
  });

  it("are all edges of a mesh of polygons", () => {
    const mesh = decodeShapes(buildGlb([sphere(1, 1, 12, [0, 0, 0], { kind: "mesh3d" })]))[0]!;
    expect(featureLines(mesh)).toBe(primitiveOf(mesh, "edges")!.indices);
  });

  it("keep lines whose sides have vertices of their own", () => {
    // Two triangles with a common edge 1-2, once with the same vertices, once with double ones.
    expect([...creaseLines(new Uint16Array([1, 2]), new Uint16Array([0, 1, 2, 2, 1, 3]), 4)]).toEqual([]);
    expect([...creaseLines(new Uint16Array([1, 2]), new Uint16Array([0, 1, 2, 4, 5, 3]), 6)]).toEqual([1, 2]);
  });
});

describe("chunks of small shapes", () => {
  const shapes = [
    ...Array.from({ length: 40 }, (_, i) => cube(i, 1, [3 * i, 1e7, 0])),
    points(40, [0, 0, 0, 1, 1, 1]),
  ];

  function drawn(root: Object3D, type: "Mesh" | "LineSegments" | "Points"): Mesh[] {
    const found: Mesh[] = [];
    root.traverse((object) => {
      if (object.type === type && object.visible) found.push(object as unknown as Mesh);
    });
    return found;
  }

  it("take few draw calls", () => {
    const { store } = sceneOf(shapes);
    expect(drawn(store.root, "Mesh")).toHaveLength(1);
    expect(drawn(store.root, "Mesh")[0]!.geometry.index!.count).toBe(40 * 36);
    expect(drawn(store.root, "Points")).toHaveLength(1);
  });

  it("keep coordinates precise beside the origin of the chunk", () => {
    const { store } = sceneOf(shapes);
    const mesh = drawn(store.root, "Mesh")[0]!;
    const parent = mesh.parent!.position;
    const positions = mesh.geometry.getAttribute("position");
    const last = positions.count - 3; // of the last cube
    expect(parent.x + positions.getX(last)).toBe(3 * 39 - 0.5);
    expect(Math.abs(parent.y + positions.getY(last) - 1e7)).toBe(0.5);
  });

  it("are told apart in floats where the camera looks, however far that is", () => {
    const far = 1e15;
    const apart = shapes.map((shape, i) => (i < 20 ? shape : cube(i, 1, [far + 3 * i, far, 0])));
    const { store, camera } = sceneOf(apart);
    const mesh = drawn(store.root, "Mesh")[0]!;
    const target = [far + 90, far, 0] as const;
    store.update({ ...camera, target, height: 4 }, null);
    const parent = mesh.parent!.position;
    const positions = mesh.geometry.getAttribute("position");
    const first = 30 * 24;
    expect(parent.x + positions.getX(first)).toBe(far + 90 - 0.5);
    expect(new Set(Array.from({ length: 24 }, (_, i) => positions.getX(first + i)))).toEqual(
      new Set([-0.5, 0.5]),
    );
  });

  it("hide, colour and move single shapes", () => {
    const { store, camera } = sceneOf(shapes);
    const mesh = drawn(store.root, "Mesh")[0]!;
    const record = store.record({ result: "r1", row: 5, column: "Solid" })!;
    record.hidden = true;
    store.refreshVisibility();
    store.update(camera, null);
    expect(mesh.geometry.index!.count).toBe(39 * 36);
    store.setLook(record, { ...look, offset: [0, 0, 7] });
    const color = mesh.geometry.getAttribute("color");
    const first = 5 * 24;
    expect([color.getX(first), color.getY(first)]).toEqual([1, 0]);
    expect(color.getY(first - 1)).toBe(1);
    const positions = mesh.geometry.getAttribute("position");
    expect(Math.abs(positions.getZ(first) - 7)).toBe(0.5);
    expect(Math.abs(positions.getZ(first - 1))).toBe(0.5);
  });

  it("are not seen before they have a look, and come back as they were after all were hidden", () => {
    const { store, column, camera } = sceneOf(shapes);
    const mesh = drawn(store.root, "Mesh")[0]!;
    const index = mesh.geometry.index;
    for (const hidden of [true, false]) {
      for (const record of column.records.values()) record.hidden = hidden;
      store.refreshVisibility();
      store.update(camera, null);
      expect(mesh.parent!.visible).toBe(!hidden);
    }
    expect(mesh.geometry.index).toBe(index);
    const more = shapes.map((shape) => ({ ...shape, row: shape.row + 100 }));
    for (const record of store.addShapes(column, decodeShapes(buildGlb(more)))) {
      expect(record.visible).toBe(true);
      expect(record.look).toBeNull();
    }
    store.update(camera, null);
    expect(drawn(store.root, "Mesh")[1]!.parent!.visible).toBe(false);
  });

  it("are freed with their last shape", () => {
    const { store, column } = sceneOf(shapes);
    store.removeColumn(column);
    expect(store.root.children).toHaveLength(0);
  });
});

describe("levels of detail", () => {
  it("keep the coarsest and the finest, and draw the coarsest while moving", () => {
    const { store, column } = sceneOf([sphere(0, 1, 4, [0, 0, 0], { triangles: 5000 })]);
    for (const rings of [10, 30]) {
      store.addShapes(column, decodeShapes(buildGlb([sphere(0, 1, rings, [0, 0, 0], { triangles: 5000 })])));
    }
    const record = store.record({ result: "r1", row: 0, column: "Solid" })!;
    expect(record.levels.map(({ shape }) => shape.shown)).toEqual([48, 3480]);
    expect(store.root.children.map(({ visible }) => visible)).toEqual([false, true]);
    store.setCoarse(true);
    expect(store.root.children.map(({ visible }) => visible)).toEqual([true, false]);
    expect(store.triangleCounts()).toEqual({ fine: 3480, coarse: 48 });
    store.dropFinest(record);
    expect(record.shown).toBe(48);
  });

  it("are replaced when the value has changed", () => {
    const { store, column } = sceneOf([cube(0, 2)]);
    column.generation++;
    store.addShapes(column, decodeShapes(buildGlb([cube(0, 6)])));
    const record = store.record({ result: "r1", row: 0, column: "Solid" })!;
    expect(record.levels).toHaveLength(1);
    expect(record.info().box).toEqual([-3, 3, -3, 3, -3, 3]);
  });
});

describe("dragging a vertex", () => {
  const faces = (): ReturnType<typeof primitiveOf> =>
    primitiveOf(decodeShapes(buildGlb([cube(0, 2)]))[0]!, "faces");

  it("takes all vertices at the corner, and its normal", () => {
    const primitive = faces()!;
    const place = placeOf(primitive, 0);
    expect(place.vertices).toHaveLength(3);
    const corner = new Vector3().fromArray(primitive.positions, 0);
    expect(place.normal.distanceTo(corner.normalize())).toBeLessThan(1e-6);
    moveVertices(primitive, place.vertices, new Vector3(9, 8, 7));
    for (const vertex of place.vertices) {
      expect([...primitive.positions.subarray(3 * vertex, 3 * vertex + 3)]).toEqual([9, 8, 7]);
    }
  });

  it("stays on the normal, in its plane, or parallel to the view", () => {
    const from = new Vector3(1, 1, 1);
    const up = new Vector3(0, 0, 1);
    const ray = new Ray(new Vector3(1, -9, 4), new Vector3(0, 1, 0));
    expect(draggedTo(ray, from, up, "normal")!.toArray()).toEqual([1, 1, 4]);
    expect(draggedTo(ray, from, up, "free")!.toArray()).toEqual([1, 1, 4]);
    expect(draggedTo(ray, from, up, "plane")).toBeNull(); // parallel to the plane
    const down = new Ray(new Vector3(5, 6, 9), new Vector3(0, 0, -1));
    expect(draggedTo(down, from, up, "plane")!.toArray()).toEqual([5, 6, 1]);
    expect(closestOnLine(down, from, up)).toBeNull();
  });
});
