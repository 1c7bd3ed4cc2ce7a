/**
 * Many small shapes in few draw calls: their vertices are copied into common arrays, relative to the origin of the
 * chunk, which follows the camera where floats would not resolve what it looks at. Each shape keeps a range of
 * vertices, for its colour and offset, and of indices, left out while it is hidden.
 */

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  FrontSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  Points,
  Vector3,
} from "three";
import type { Material, MeshLambertMaterial, Object3D } from "three";

import type { Vec3 } from "./api";
import type { IndexArray, Primitive, Role, Shape } from "../glb/shapes";
import type { Body } from "./body";
import { featureLines } from "./features";
import { FrontFaces, isWorthChoosing } from "./front_faces";
import type { EyeFrom, PlaneBudget } from "./front_faces";
import { triangleEdges } from "./geometry";
import { isTransparent } from "./look";
import type { Look, Style } from "./look";
import { bringForward, clip, faceMaterial, pointMaterial, styleFaces } from "./materials";
import type { SharedMaterials } from "./materials";
import { kOutlineLayer } from "./outline";
import { thinColor } from "./single_body";
import { isFarOrigin } from "./vec";

/** Shapes with fewer vertices are merged if there are many. */
export const kSmallVertices = 4_000;
/** A chunk has at most so many vertices, so that making it, or changing one of its shapes, takes no longer than a frame. */
export const kChunkVertices = 100_000;

export function vertexCount(shape: Shape): number {
  return distinctPositions(shape).reduce((sum, array) => sum + array.length / 3, 0);
}

function distinctPositions(shape: Shape): Float32Array[] {
  const arrays: Float32Array[] = [];
  for (const { positions } of shape.primitives) {
    if (!arrays.some((other) => sameArray(other, positions))) arrays.push(positions);
  }
  return arrays;
}

function sameArray(a: Float32Array, b: Float32Array): boolean {
  return a.buffer === b.buffer && a.byteOffset === b.byteOffset && a.length === b.length;
}

/** Where a shape lies in the arrays of its chunk. */
interface Slot {
  readonly shape: Shape;
  readonly firstVertex: number;
  readonly vertices: number;
  visible: boolean;
  offset: Vec3;
  group: FaceGroup;
}

/** Faces are drawn in one call each: the solid ones, those that are seen through, and those of selected objects. */
type FaceGroup = "faces" | "glass" | "chosen";
const kFaceGroups: readonly FaceGroup[] = ["faces", "glass", "chosen"];

const kRoles: readonly Role[] = ["faces", "edges", "boundary", "nonmanifold", "lines", "points"];

/** Besides the roles: all edges of triangles, and the vertices of faces. */
type LayerKey = Role | FaceGroup | "all" | "vertices";

const isFaceGroup = (key: LayerKey): key is FaceGroup => (kFaceGroups as readonly LayerKey[]).includes(key);

/** One draw call: the indices of a role, and those of all shapes to make them from. */
interface Layer {
  readonly object: Mesh | LineSegments | Points;
  readonly geometry: BufferGeometry;
}

export class Chunk {
  readonly group = new Group();
  private readonly slots: Slot[] = [];
  private readonly positions: Float32Array<ArrayBuffer>;
  private readonly colors: Uint16Array<ArrayBuffer>;
  private readonly sizes: Float32Array<ArrayBuffer> | null;
  private readonly attributes: Readonly<Record<"position" | "color", BufferAttribute>>;
  private readonly layers = new Map<LayerKey, Layer>();
  private readonly origin = new Vector3();
  private style: Style | null = null;
  private indicesStale = false;
  /** What the indices were made of. */
  private drawn = "";
  private drawsAllEdges = false;
  private bodies = 0;
  private fronts: FrontFaces | null = null;

  constructor(
    shapes: readonly Shape[],
    private readonly parent: Object3D,
    private readonly shared: SharedMaterials,
  ) {
    this.origin.fromArray(shapes[0]?.translation ?? [0, 0, 0]);
    let vertices = 0;
    for (const shape of shapes) {
      const count = vertexCount(shape);
      this.slots.push({
        shape,
        firstVertex: vertices,
        vertices: count,
        visible: true,
        offset: [0, 0, 0],
        group: "faces",
      });
      vertices += count;
    }
    this.positions = new Float32Array(3 * vertices);
    this.colors = new Uint16Array(4 * vertices).fill(65535);
    const hasPoints = shapes.some((shape) => shape.primitives.some(({ role }) => role === "points"));
    this.sizes = hasPoints ? new Float32Array(vertices).fill(1) : null;
    this.attributes = {
      position: new BufferAttribute(this.positions, 3),
      color: new BufferAttribute(this.colors, 4, true),
    };
    for (const slot of this.slots) this.writePositions(slot);
    for (const role of kRoles) this.addLayer(role);
    this.drawn = this.seenSlots();
    this.group.position.copy(this.origin);
    parent.add(this.group);
  }

  /** The shapes as bodies, in their order; the chunk is freed with the last of them. */
  makeBodies(): Body[] {
    this.bodies = this.slots.length;
    return this.slots.map((slot) => ({
      shape: slot.shape,
      setVisible: (visible) => this.setVisible(slot, visible),
      setLook: (look) => this.setLook(slot, look),
      setStyle: (style) => this.setStyle(style),
      positionsChanged: () => this.writePositions(slot),
      chooseFronts: () => undefined, // of the chunk as a whole
      showGrips: () => undefined,
      setPreview: () => undefined,
      dispose: () => this.release(slot),
    }));
  }

  /** Puts the origin where a view of this height looks, if it is too far from it. Cost: linear, seldom. */
  approach(target: Vector3, height: number): void {
    if (!isFarOrigin(this.origin, target, height)) return;
    this.origin.copy(target);
    this.group.position.copy(target);
    for (const slot of this.slots) this.writePositions(slot);
  }

  /** Makes the indices of what is visible; called once before drawing, after any number of changes. */
  update(): void {
    if (!this.indicesStale) return;
    this.indicesStale = false;
    this.group.visible = this.slots.some(({ visible }) => visible);
    if (!this.group.visible) return;
    // What was hidden as a whole, as while coarser levels are drawn, comes back as it was.
    const drawn = this.seenSlots();
    if (drawn === this.drawn) return;
    this.drawn = drawn;
    this.dropFronts();
    for (const [role, layer] of this.layers) {
      if (role === "all" || role === "vertices" || isFaceGroup(role)) continue;
      layer.geometry.setIndex(new BufferAttribute(this.indicesOf(role), 1));
    }
    this.divideFaces();
    if (this.layers.has("all")) this.makeAllEdges();
    if (this.layers.has("vertices")) this.makeVertices();
  }

  /** What the indices depend on. */
  private seenSlots(): string {
    return this.slots.map(({ visible, group }) => (visible ? group : "")).join() + String(this.drawsAllEdges);
  }

  /** Gives each group of faces the indices of its shapes. */
  private divideFaces(): void {
    const whole = this.layers.get("faces");
    if (!whole) return;
    for (const group of kFaceGroups) {
      const isUsed = this.slots.some((slot) => slot.visible && slot.group === group);
      if (!isUsed && !this.layers.has(group)) continue;
      const { geometry } = this.layers.get(group) ?? this.addFaces(group, whole.geometry);
      geometry.setIndex(new BufferAttribute(this.indicesOf("faces", group), 1));
    }
  }

  private addFaces(group: FaceGroup, whole: BufferGeometry): Layer {
    const geometry = new BufferGeometry();
    for (const [name, attribute] of Object.entries(whole.attributes)) geometry.setAttribute(name, attribute);
    const mesh = new Mesh(geometry, faceMaterial(true, this.shared.place));
    bringForward(mesh.material, group === "chosen");
    if (group === "chosen") mesh.layers.enable(kOutlineLayer);
    const layer = this.addObject(group, mesh);
    if (this.style) this.applyStyle(this.style);
    return layer;
  }

  /** Whether all shapes were disposed of. */
  get isFree(): boolean {
    return this.bodies === 0;
  }

  /** As of a body. */
  chooseFronts(eyeFrom: EyeFrom | null, budget: PlaneBudget): void {
    const layer = this.layers.get("faces");
    if (!layer?.object.visible || !this.group.visible) return;
    const { object, geometry } = layer;
    const fronts =
      eyeFrom && faceMaterialOf(object).side === FrontSide ? this.frontFaces(geometry, budget) : null;
    object.geometry = fronts?.geometry ?? geometry;
    if (fronts && eyeFrom) fronts.choose(eyeFrom(this.group.position));
  }

  private frontFaces(whole: BufferGeometry, budget: PlaneBudget): FrontFaces | null {
    const indices = whole.index!.array as Uint32Array<ArrayBuffer>;
    if (!this.fronts && budget.triangles > 0 && isWorthChoosing(indices)) {
      budget.triangles -= indices.length / 3;
      this.fronts = new FrontFaces(whole, this.positions, indices);
    }
    return this.fronts;
  }

  private dropFronts(): void {
    this.fronts?.dispose();
    this.fronts = null;
  }

  private setVisible(slot: Slot, visible: boolean): void {
    if (slot.visible === visible) return;
    slot.visible = visible;
    this.indicesStale = true;
  }

  private setLook(slot: Slot, look: Look): void {
    const isThin = !slot.shape.primitives.some(({ role }) => role === "faces");
    const color = isThin ? thinColor(look) : new Color(look.color);
    this.setColor(slot, [color.r, color.g, color.b, look.opacity]);
    if (this.sizes) {
      this.sizes.fill(look.pointSize, slot.firstVertex, slot.firstVertex + slot.vertices);
      const attribute = this.layers.get("points")?.geometry.getAttribute("pointSize");
      if (attribute) (attribute as BufferAttribute).needsUpdate = true;
    }
    const group = look.selected ? "chosen" : isTransparent(look.opacity) ? "glass" : "faces";
    if (group !== slot.group) {
      slot.group = group;
      this.indicesStale = true;
    }
    if (slot.offset.every((part, axis) => part === look.offset[axis])) return;
    slot.offset = look.offset;
    this.writePositions(slot);
  }

  private setColor({ firstVertex, vertices }: Slot, rgba: readonly number[]): void {
    const words = Uint16Array.from(rgba, (part) => Math.round(part * 65535));
    const [whole] = new BigUint64Array(words.buffer);
    new BigUint64Array(this.colors.buffer).fill(whole!, firstVertex, firstVertex + vertices);
    this.attributes.color.needsUpdate = true;
  }

  private setStyle(style: Style): void {
    if (this.style === style) return;
    this.style = style;
    this.applyStyle(style);
  }

  private applyStyle(style: Style): void {
    const { appearance, display } = style;
    const wantAll = appearance.edges === "all";
    if (wantAll && !this.layers.has("all")) this.makeAllEdges();
    if (appearance.vertices && !this.layers.has("vertices")) this.makeVertices();
    this.chooseEdges(wantAll || !appearance.faces);
    const visible: Record<string, boolean> = {
      faces: appearance.faces,
      glass: appearance.faces,
      chosen: appearance.faces,
      edges: appearance.edges !== "none",
      all: wantAll,
      vertices: appearance.vertices,
      boundary: display.boundary || wantAll,
      nonmanifold: display.nonManifold,
      lines: true,
      points: true,
    };
    for (const [role, { object, geometry }] of this.layers) {
      object.visible = visible[role]!;
      const material = object.material as Material;
      if (isFaceGroup(role)) {
        const options = {
          closed: this.slots.every(({ shape }) => shape.kind === "volume3d"),
          hasNormals: geometry.hasAttribute("normal"),
          opacity: role === "glass" ? 0.5 : 1,
        };
        styleFaces(faceMaterialOf(object), style, options);
      } else if (role === "points" || role === "lines") {
        clip(material, style.clipping);
      }
    }
    this.showStencils(style.stencil && appearance.faces && appearance.opacity >= 0.999);
  }

  /** All edges that the server sent, or the creases. */
  private chooseEdges(all: boolean): void {
    if (this.drawsAllEdges === all) return;
    this.drawsAllEdges = all;
    this.indicesStale = true;
  }

  private readonly stencils = new Map<FaceGroup, readonly Mesh[]>();

  /** What is seen through has no cut that could be filled. */
  private showStencils(show: boolean): void {
    for (const group of ["faces", "chosen"] as const) {
      const layer = this.layers.get(group);
      if (show && layer && !this.stencils.has(group)) this.stencils.set(group, this.makeStencils(layer));
      for (const mesh of this.stencils.get(group) ?? []) mesh.visible = show;
    }
  }

  private makeStencils({ geometry }: Layer): readonly Mesh[] {
    return [this.shared.stencilBack, this.shared.stencilFront].map((material) => {
      const mesh = new Mesh(geometry, material);
      mesh.renderOrder = -2;
      mesh.frustumCulled = false;
      this.group.add(mesh);
      return mesh;
    });
  }

  private writePositions({ shape, offset, firstVertex }: Slot): void {
    this.dropFronts();
    const { translation } = shape;
    const origin = this.origin.toArray();
    const shift = [0, 1, 2].map((axis) => translation[axis]! - origin[axis]! + offset[axis]!);
    let at = 3 * firstVertex;
    for (const array of distinctPositions(shape)) {
      for (let i = 0; i < array.length; i += 3, at += 3) {
        this.positions[at] = array[i]! + shift[0]!;
        this.positions[at + 1] = array[i + 1]! + shift[1]!;
        this.positions[at + 2] = array[i + 2]! + shift[2]!;
      }
    }
    this.attributes.position.needsUpdate = true;
  }

  private addLayer(role: Role): void {
    const primitives = this.slots.flatMap(({ shape }) => shape.primitives.filter((p) => p.role === role));
    if (primitives.length === 0) return;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.attributes.position);
    geometry.setAttribute("color", this.attributes.color);
    const normals = role === "faces" ? this.normals() : null;
    if (normals) geometry.setAttribute("normal", normals);
    if (role === "points") geometry.setAttribute("pointSize", new BufferAttribute(this.sizes!, 1));
    geometry.setIndex(new BufferAttribute(this.indicesOf(role), 1));
    this.addObject(role, this.objectOf(role, geometry));
  }

  private objectOf(role: Role, geometry: BufferGeometry): Mesh | LineSegments | Points {
    switch (role) {
      case "faces":
        return new Mesh(geometry, faceMaterial(true, this.shared.place));
      case "points":
        return new Points(geometry, pointMaterial(true));
      case "lines":
        return new LineSegments(geometry, new LineBasicMaterial({ vertexColors: true }));
      case "edges":
        return new LineSegments(geometry, this.shared.edges);
      case "boundary":
        return new LineSegments(geometry, this.shared.boundary);
      case "nonmanifold":
        return new LineSegments(geometry, this.shared.nonManifold);
    }
  }

  private addObject(key: LayerKey, object: Mesh | LineSegments | Points): Layer {
    // The arrays change, and with them the box; a chunk is nearly always in sight.
    object.frustumCulled = false;
    if (key === "boundary" || key === "nonmanifold") object.renderOrder = 2;
    const layer = { object, geometry: object.geometry };
    this.layers.set(key, layer);
    this.group.add(object);
    return layer;
  }

  /** null if a shape has none. */
  private normals(): BufferAttribute | null {
    const bytes = new Int8Array(4 * (this.positions.length / 3));
    for (const { shape, firstVertex } of this.slots) {
      for (const primitive of shape.primitives) {
        if (primitive.role !== "faces") continue;
        if (!primitive.normals) return null;
        const { array, stride } = primitive.normals;
        const first = firstVertex + baseOf(shape, primitive);
        for (let i = 0; i < primitive.positions.length / 3; i++) {
          for (let axis = 0; axis < 3; axis++) bytes[4 * (first + i) + axis] = array[stride * i + axis]!;
        }
      }
    }
    return new BufferAttribute(bytes, 4, true);
  }

  /** Of what is visible; of faces only those of a group, if one is given. */
  private indicesOf(role: Role, group: FaceGroup | null = null): Uint32Array<ArrayBuffer> {
    const parts: { indices: IndexArray | null; base: number; primitive: Primitive }[] = [];
    let count = 0;
    for (const { shape, firstVertex, visible, group: own } of this.slots) {
      if (!visible || (group !== null && own !== group)) continue;
      for (const primitive of shape.primitives) {
        if (primitive.role !== role) continue;
        const lines = role === "edges" && !this.drawsAllEdges ? featureLines(shape) : primitive.indices;
        if (role === "edges" && !lines) continue;
        parts.push({ indices: lines, base: firstVertex + baseOf(shape, primitive), primitive });
        count += lines?.length ?? primitive.positions.length / 3;
      }
    }
    const indices = new Uint32Array(count);
    let at = 0;
    for (const { indices: own, base, primitive } of parts) {
      const length = own?.length ?? primitive.positions.length / 3;
      if (own) for (let i = 0; i < length; i++) indices[at++] = base + own[i]!;
      else for (let i = 0; i < length; i++) indices[at++] = base + i;
    }
    return indices;
  }

  private makeAllEdges(): void {
    const faces = this.indicesOf("faces");
    const old = this.layers.get("all");
    const geometry = old?.geometry ?? new BufferGeometry();
    geometry.setAttribute("position", this.attributes.position);
    geometry.setIndex(new BufferAttribute(triangleEdges(faces), 1));
    if (!old) this.addObject("all", new LineSegments(geometry, this.shared.edges));
  }

  private makeVertices(): void {
    const old = this.layers.get("vertices");
    const geometry = old?.geometry ?? new BufferGeometry();
    geometry.setAttribute("position", this.attributes.position);
    geometry.setIndex(new BufferAttribute(Uint32Array.from(new Set(this.indicesOf("faces"))), 1));
    if (!old) this.addObject("vertices", new Points(geometry, this.shared.vertices));
  }

  private release(slot: Slot): void {
    this.setVisible(slot, false);
    this.bodies--;
    if (this.bodies > 0) return;
    this.parent.remove(this.group);
    this.dropFronts();
    for (const { object, geometry } of this.layers.values()) {
      geometry.dispose();
      const material = object.material as Material;
      if (material.vertexColors) material.dispose();
    }
  }
}

function faceMaterialOf(object: Layer["object"]): MeshLambertMaterial {
  return object.material as MeshLambertMaterial;
}

/** The first vertex of a primitive among those of its shape. */
function baseOf(shape: Shape, primitive: Primitive): number {
  let base = 0;
  for (const array of distinctPositions(shape)) {
    if (sameArray(array, primitive.positions)) return base;
    base += array.length / 3;
  }
  return base;
}
