/** Decoder of the shapes of docs/http-api.md. All arrays are views into the one buffer that came from the server. */

import { ShapeFormatError, readContainer } from "./container";
import type { Container } from "./container";
import { ComponentType } from "./gltf";
import type { Gltf, GltfAccessor, GltfPrimitive } from "./gltf";

export type Role = "faces" | "edges" | "boundary" | "nonmanifold" | "points" | "lines";
const kRoles: readonly string[] = ["faces", "edges", "boundary", "nonmanifold", "points", "lines"];

export type IndexArray = Uint16Array<ArrayBuffer> | Uint32Array<ArrayBuffer>;

/** Normals of vertices: signed bytes, 127 for 1; `stride` bytes from one to the next. */
export interface Normals {
  readonly array: Int8Array<ArrayBuffer>;
  readonly stride: number;
}

/** One primitive of a shape. Positions are relative to the translation of the shape. */
export interface Primitive {
  readonly role: Role;
  /** Three floats a vertex. */
  readonly positions: Float32Array<ArrayBuffer>;
  readonly normals: Normals | null;
  /** null: the vertices in their order. */
  readonly indices: IndexArray | null;
  /** The bytes of the bounding volume hierarchy, see scene/tree.ts. */
  readonly tree: Uint8Array<ArrayBuffer> | null;
  /** Number in the value of each triangle and vertex; null: their positions. */
  readonly faceIds: IndexArray | null;
  readonly vertexIds: IndexArray | null;
  readonly deviation: number;
}

/** What is drawn of one cell. */
export interface Shape {
  readonly row: number;
  readonly kind: string;
  readonly box: readonly [number, number, number, number, number, number] | null;
  readonly triangles: number;
  readonly shown: number;
  readonly translation: readonly [number, number, number];
  readonly primitives: readonly Primitive[];
}

/**
 * The shapes of an answer of GET /api/results/{id}/shapes, in the order of its nodes.
 * Errors: ShapeFormatError if it is not as documented. Cost: linear in the number of shapes, not in their size.
 */
export function decodeShapes(buffer: ArrayBuffer): Shape[] {
  const container = readContainer(buffer);
  const gltf = container.json as Gltf;
  const reader = new Reader(container, gltf);
  return (gltf.nodes ?? []).map((node, index) => {
    const extras = node.extras ?? {};
    const mesh = node.mesh === undefined ? undefined : gltf.meshes?.[node.mesh];
    if (node.mesh !== undefined && !mesh) {
      throw new ShapeFormatError(`shapes: node ${index} has mesh ${node.mesh}, which is not there`);
    }
    return {
      row: extras.row ?? index,
      kind: extras.kind ?? "",
      box: extras.box?.length === 6 ? (extras.box as unknown as Shape["box"]) : null,
      triangles: extras.triangles ?? 0,
      shown: extras.shown ?? extras.triangles ?? 0,
      translation: vec3(node.translation),
      primitives: (mesh?.primitives ?? []).map((primitive) => reader.primitive(primitive)),
    };
  });
}

function vec3(values: readonly number[] | undefined): readonly [number, number, number] {
  return [values?.[0] ?? 0, values?.[1] ?? 0, values?.[2] ?? 0];
}

class Reader {
  constructor(
    private readonly container: Container,
    private readonly gltf: Gltf,
  ) {}

  primitive(primitive: GltfPrimitive): Primitive {
    const extras = primitive.extras ?? {};
    const role = extras.role ?? "";
    if (!kRoles.includes(role)) throw new ShapeFormatError(`shapes: unknown role '${role}'`);
    const position = primitive.attributes["POSITION"];
    if (position === undefined) throw new ShapeFormatError(`shapes: role ${role} has no POSITION`);
    const normal = primitive.attributes["NORMAL"];
    return {
      role: role as Role,
      positions: this.positions(position),
      normals: normal === undefined ? null : this.normals(normal),
      indices: primitive.indices === undefined ? null : this.numbers(primitive.indices),
      tree: extras.tree === undefined ? null : this.bytes(extras.tree),
      faceIds: extras.faceIds === undefined ? null : this.numbers(extras.faceIds),
      vertexIds: extras.vertexIds === undefined ? null : this.numbers(extras.vertexIds),
      deviation: extras.deviation ?? 0,
    };
  }

  private positions(index: number): Float32Array<ArrayBuffer> {
    const accessor = this.accessor(index, "VEC3", [ComponentType.f32]);
    const { offset, stride } = this.place(accessor, 12, 12);
    if (stride !== 12)
      throw new ShapeFormatError(`shapes: accessor ${index}: positions with stride ${stride}`);
    return new Float32Array(this.container.buffer, offset, accessor.count * 3);
  }

  private normals(index: number): Normals {
    const accessor = this.accessor(index, "VEC3", [ComponentType.i8]);
    const { offset, stride } = this.place(accessor, 3, 1);
    // The last vertex need not have the bytes that fill up its stride; a buffer attribute wants them.
    const whole = Math.min(accessor.count * stride, this.container.buffer.byteLength - offset);
    return { array: new Int8Array(this.container.buffer, offset, whole), stride };
  }

  private numbers(index: number): IndexArray {
    const accessor = this.accessor(index, "SCALAR", [ComponentType.u16, ComponentType.u32]);
    const size = accessor.componentType === ComponentType.u16 ? 2 : 4;
    const { offset, stride } = this.place(accessor, size, size);
    if (stride !== size) throw new ShapeFormatError(`shapes: accessor ${index}: numbers with gaps`);
    return size === 2
      ? new Uint16Array(this.container.buffer, offset, accessor.count)
      : new Uint32Array(this.container.buffer, offset, accessor.count);
  }

  private bytes(viewIndex: number): Uint8Array<ArrayBuffer> {
    const view = this.gltf.bufferViews?.[viewIndex];
    if (!view) throw new ShapeFormatError(`shapes: buffer view ${viewIndex} is not there`);
    const offset = this.container.binaryOffset + (view.byteOffset ?? 0);
    this.checkEnd(offset + view.byteLength, `buffer view ${viewIndex}`);
    return new Uint8Array(this.container.buffer, offset, view.byteLength);
  }

  private accessor(index: number, type: string, componentTypes: readonly number[]): GltfAccessor {
    const accessor = this.gltf.accessors?.[index];
    if (!accessor) throw new ShapeFormatError(`shapes: accessor ${index} is not there`);
    if (accessor.type !== type || !componentTypes.includes(accessor.componentType)) {
      const expected = `${type} of ${componentTypes.join(" or ")}`;
      const found = `${accessor.type} of ${accessor.componentType}`;
      throw new ShapeFormatError(`shapes: accessor ${index}: expected ${expected}, found ${found}`);
    }
    return accessor;
  }

  /** Where the elements of an accessor lie in the buffer; each has `size` bytes, aligned to `alignment`. */
  private place(accessor: GltfAccessor, size: number, alignment: number): { offset: number; stride: number } {
    const view = this.gltf.bufferViews?.[accessor.bufferView ?? -1];
    if (!view) throw new ShapeFormatError(`shapes: buffer view ${accessor.bufferView ?? "?"} is not there`);
    const offset = this.container.binaryOffset + (view.byteOffset ?? 0) + (accessor.byteOffset ?? 0);
    const stride = view.byteStride ?? size;
    if (offset % Math.min(alignment, 4) !== 0) {
      throw new ShapeFormatError(`shapes: byte ${offset}: not aligned to ${Math.min(alignment, 4)}`);
    }
    if (accessor.count > 0) this.checkEnd(offset + (accessor.count - 1) * stride + size, "an accessor");
    return { offset, stride };
  }

  private checkEnd(end: number, what: string): void {
    const limit = this.container.binaryOffset + this.container.binaryLength;
    if (end > limit)
      throw new ShapeFormatError(`shapes: ${what} goes to byte ${end}, the data end at ${limit}`);
  }
}
