/** Writes the binary glTF of docs/http-api.md, so that the scene can be tested without a server. */

import { BufferGeometry, BufferAttribute } from "three";
import { MeshBVH, SAH } from "three-mesh-bvh";

export interface TestShape {
  readonly row: number;
  readonly kind: string;
  readonly translation?: readonly [number, number, number];
  readonly positions: readonly number[];
  /** Signed bytes, three a vertex. */
  readonly normals?: readonly number[];
  readonly faces?: readonly number[];
  readonly edges?: readonly number[];
  readonly boundary?: readonly number[];
  readonly nonmanifold?: readonly number[];
  readonly points?: boolean;
  readonly lines?: readonly number[];
  readonly triangles?: number;
  readonly shown?: number;
  readonly tree?: boolean;
  readonly faceIds?: readonly number[];
  readonly vertexIds?: readonly number[];
  readonly deviation?: number;
  readonly empty?: boolean;
}

interface Json {
  asset: { version: string };
  nodes: object[];
  meshes: { primitives: object[] }[];
  accessors: object[];
  bufferViews: object[];
  buffers: object[];
}

class GlbWriter {
  private readonly parts: Uint8Array[] = [];
  private size = 0;
  readonly json: Json = {
    asset: { version: "2.0" },
    nodes: [],
    meshes: [],
    accessors: [],
    bufferViews: [],
    buffers: [],
  };

  view(bytes: Uint8Array, stride?: number): number {
    this.json.bufferViews.push({
      buffer: 0,
      byteOffset: this.size,
      byteLength: bytes.byteLength,
      ...(stride ? { byteStride: stride } : {}),
    });
    const padding = (4 - (bytes.byteLength % 4)) % 4;
    this.parts.push(bytes, new Uint8Array(padding));
    this.size += bytes.byteLength + padding;
    return this.json.bufferViews.length - 1;
  }

  accessor(view: number, componentType: number, count: number, type: string, normalized = false): number {
    this.json.accessors.push({
      bufferView: view,
      componentType,
      count,
      type,
      ...(normalized ? { normalized } : {}),
    });
    return this.json.accessors.length - 1;
  }

  numbers(values: readonly number[]): number {
    const wide = values.some((value) => value > 65535);
    const array = wide ? new Uint32Array(values) : new Uint16Array(values);
    return this.accessor(
      this.view(new Uint8Array(array.buffer)),
      wide ? 5125 : 5123,
      values.length,
      "SCALAR",
    );
  }

  finish(): ArrayBuffer {
    this.json.buffers.push({ byteLength: this.size });
    let text = JSON.stringify(this.json);
    while (new TextEncoder().encode(text).length % 4 !== 0) text += " ";
    const json = new TextEncoder().encode(text);
    const total = 12 + 8 + json.length + 8 + this.size;
    const out = new Uint8Array(total);
    const header = new DataView(out.buffer);
    [0x46546c67, 2, total, json.length, 0x4e4f534a].forEach((word, i) => header.setUint32(4 * i, word, true));
    out.set(json, 20);
    header.setUint32(20 + json.length, this.size, true);
    header.setUint32(24 + json.length, 0x004e4942, true);
    let at = 28 + json.length;
    for (const part of this.parts) {
      out.set(part, at);
      at += part.byteLength;
    }
    return out.buffer;
  }
}

/** The tree of three-mesh-bvh, which is the layout of docs/http-api.md. */
function treeBytes(positions: readonly number[], faces: number[]): Uint8Array {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  geometry.setIndex(new BufferAttribute(new Uint32Array(faces), 1));
  const tree = MeshBVH.serialize(new MeshBVH(geometry, { strategy: SAH }));
  (tree.index as Uint32Array).forEach((value, i) => (faces[i] = value)); // in the order of the leaves
  return new Uint8Array(tree.roots[0]!);
}

function addShape(writer: GlbWriter, shape: TestShape): void {
  const box = boxOf(shape.positions, shape.translation ?? [0, 0, 0]);
  const count = shape.triangles ?? (shape.faces?.length ?? 0) / 3;
  const extras = {
    row: shape.row,
    box,
    triangles: count,
    shown: shape.shown ?? (shape.faces?.length ?? 0) / 3,
    kind: shape.kind,
  };
  if (shape.empty) {
    writer.json.nodes.push({ extras: { row: shape.row, triangles: 0, shown: 0, kind: shape.kind } });
    return;
  }
  const floats = new Uint8Array(new Float32Array(shape.positions).buffer);
  const vertices = shape.positions.length / 3;
  const position = writer.accessor(writer.view(floats), 5126, vertices, "VEC3");
  const primitives: object[] = [];
  if (shape.faces) {
    const faces = [...shape.faces];
    const more: Record<string, number> = {};
    if (shape.tree) more["tree"] = writer.view(treeBytes(shape.positions, faces));
    if (shape.faceIds) more["faceIds"] = writer.numbers(shape.faceIds);
    if (shape.vertexIds) more["vertexIds"] = writer.numbers(shape.vertexIds);
    if (shape.deviation) more["deviation"] = shape.deviation;
    const attributes: Record<string, number> = { POSITION: position };
    if (shape.normals) {
      const bytes = new Int8Array(vertices * 4);
      shape.normals.forEach((value, i) => (bytes[Math.floor(i / 3) * 4 + (i % 3)] = value));
      attributes["NORMAL"] = writer.accessor(
        writer.view(new Uint8Array(bytes.buffer), 4),
        5120,
        vertices,
        "VEC3",
        true,
      );
    }
    primitives.push({
      mode: 4,
      attributes,
      indices: writer.numbers(faces),
      extras: { role: "faces", ...more },
    });
  }
  for (const role of ["edges", "boundary", "nonmanifold", "lines"] as const) {
    const indices = shape[role];
    if (!indices?.length) continue;
    primitives.push({
      mode: 1,
      attributes: { POSITION: position },
      indices: writer.numbers(indices),
      extras: { role },
    });
  }
  if (shape.points)
    primitives.push({ mode: 0, attributes: { POSITION: position }, extras: { role: "points" } });
  writer.json.meshes.push({ primitives });
  writer.json.nodes.push({
    mesh: writer.json.meshes.length - 1,
    translation: shape.translation ?? [0, 0, 0],
    extras,
  });
}

function boxOf(positions: readonly number[], origin: readonly number[]): number[] {
  const box = [Infinity, -Infinity, Infinity, -Infinity, Infinity, -Infinity];
  positions.forEach((value, i) => {
    const axis = i % 3;
    box[2 * axis] = Math.min(box[2 * axis]!, value + origin[axis]!);
    box[2 * axis + 1] = Math.max(box[2 * axis + 1]!, value + origin[axis]!);
  });
  return box;
}

export function buildGlb(shapes: readonly TestShape[]): ArrayBuffer {
  const writer = new GlbWriter();
  for (const shape of shapes) addShape(writer, shape);
  return writer.finish();
}
