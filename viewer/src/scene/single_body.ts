/** A shape with draw calls of its own, straight from the bytes that came from the server. */

import {
  BufferAttribute,
  Color,
  FrontSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  Points,
  Vector3,
} from "three";
import type { BufferGeometry, MeshLambertMaterial, Object3D, PointsMaterial } from "three";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";

import type { Primitive, Role, Shape } from "../glb/shapes";
import type { Body, Preview } from "./body";
import {
  AttributeCache,
  geometryOf,
  kMaxWideSegments,
  primitiveOf,
  sphereOf,
  triangleEdges,
  wideLines,
} from "./geometry";
import { coloredFaces } from "./element_colors";
import { featureLines } from "./features";
import { FrontFaces, isWorthChoosing } from "./front_faces";
import type { EyeFrom, PlaneBudget } from "./front_faces";
import { isTransparent, kSelectionColor } from "./look";
import type { Look, Style } from "./look";
import { bringForward, clip, faceMaterial, pointMaterial, styleFaces } from "./materials";
import type { SharedMaterials } from "./materials";
import { kOutlineLayer } from "./outline";

/** The colour of points and lines, which have no outline. */
export function thinColor({ color, selected }: Look): Color {
  return new Color(selected ? kSelectionColor : color);
}

export class SingleBody implements Body {
  readonly group = new Group();
  private readonly cache = new AttributeCache();
  private readonly faces: Mesh<BufferGeometry, MeshLambertMaterial> | null;
  private readonly points: Points<BufferGeometry, PointsMaterial> | null;
  private readonly lines: LineSegments<BufferGeometry, LineBasicMaterial> | null;
  private readonly edges: LineSegments | null;
  /** Of the faces, all of them. */
  private readonly whole: BufferGeometry | null;
  private fronts: FrontFaces | null = null;
  /** The faces in the colours of their elements. */
  private colored: BufferGeometry | null = null;
  private allEdges: LineSegments | null = null;
  private readonly boundary: Object3D | null;
  private readonly nonManifold: Object3D | null;
  private stencils: Mesh[] = [];
  private vertices: Points | null = null;
  private hasGrips = false;
  private look: Look | null = null;
  private style: Style | null = null;
  private preview: Preview | null = null;

  constructor(
    readonly shape: Shape,
    private readonly parent: Object3D,
    private readonly shared: SharedMaterials,
  ) {
    this.faces = this.make("faces", (geometry) => new Mesh(geometry, faceMaterial(false, shared.place)));
    this.whole = this.faces?.geometry ?? null;
    this.points = this.make("points", (geometry) => new Points(geometry, pointMaterial(false)));
    this.lines = this.make("lines", (geometry) => new LineSegments(geometry, new LineBasicMaterial()));
    this.edges = this.make("edges", (geometry) => new LineSegments(geometry, shared.edges));
    this.boundary = this.makeDefects("boundary");
    this.nonManifold = this.makeDefects("nonmanifold");
    this.place();
    parent.add(this.group);
  }

  private make<T extends Object3D>(role: Role, build: (geometry: BufferGeometry) => T): T | null {
    const primitive = primitiveOf(this.shape, role);
    if (!primitive) return null;
    const object = build(geometryOf(primitive, this.cache, sphereOf(this.shape)));
    this.group.add(object);
    return object;
  }

  private makeDefects(role: "boundary" | "nonmanifold"): Object3D | null {
    const primitive = primitiveOf(this.shape, role);
    if (!primitive) return null;
    const object = isShort(primitive)
      ? new LineSegments2(
          wideLines(primitive.positions, primitive.indices),
          role === "boundary" ? this.shared.wideBoundary : this.shared.wideNonManifold,
        )
      : new LineSegments(
          geometryOf(primitive, this.cache, sphereOf(this.shape)),
          role === "boundary" ? this.shared.boundary : this.shared.nonManifold,
        );
    object.renderOrder = 2;
    this.group.add(object);
    return object;
  }

  setVisible(visible: boolean): void {
    this.group.visible = visible;
  }

  setLook(look: Look): void {
    const before = this.look?.elements ?? null;
    this.look = look;
    this.place();
    if (look.elements !== before) this.colorElements(look.elements);
    if (this.faces) {
      this.faces.material.color.set(this.colored ? "#ffffff" : look.color);
      this.faces.material.opacity = look.opacity;
      bringForward(this.faces.material, look.selected);
      if (look.selected) this.faces.layers.enable(kOutlineLayer);
      else this.faces.layers.disable(kOutlineLayer);
    }
    const thin = thinColor(look);
    if (this.points) this.points.material.color.copy(thin);
    if (this.lines) this.lines.material.color.copy(thin);
    this.refresh();
  }

  private colorElements(elements: Look["elements"]): void {
    const { faces, whole } = this;
    if (!faces || !whole) return;
    this.dropFronts();
    this.colored?.dispose();
    this.colored = elements && coloredFaces(this.shape, elements, sphereOf(this.shape));
    faces.geometry = this.colored ?? whole;
    faces.material.vertexColors = this.colored !== null;
    faces.material.needsUpdate = true;
  }

  setPreview(preview: Preview | null): void {
    this.preview = preview;
    this.place();
  }

  private place(): void {
    const { position, quaternion, scale } = this.group;
    position.set(...this.shape.translation);
    if (this.look) position.add(new Vector3(...this.look.offset));
    quaternion.identity();
    scale.set(1, 1, 1);
    if (!this.preview) return;
    const { centre, move } = this.preview;
    quaternion.copy(this.preview.quaternion);
    scale.copy(this.preview.scale);
    position.sub(centre).multiply(scale).applyQuaternion(quaternion).add(centre).add(move);
  }

  setStyle(style: Style): void {
    this.style = style;
    this.refresh();
  }

  chooseFronts(eyeFrom: EyeFrom | null, budget: PlaneBudget): void {
    const { faces, whole } = this;
    if (!faces || !whole || !this.group.visible || !faces.visible) return;
    const fronts =
      eyeFrom && !this.colored && faces.material.side === FrontSide ? this.frontFaces(whole, budget) : null;
    faces.geometry = fronts?.geometry ?? this.colored ?? whole;
    if (fronts && eyeFrom) fronts.choose(eyeFrom(this.group.position));
  }

  private frontFaces(whole: BufferGeometry, budget: PlaneBudget): FrontFaces | null {
    const primitive = primitiveOf(this.shape, "faces");
    const isWanted = !this.fronts && budget.triangles > 0;
    if (isWanted && primitive?.indices && isWorthChoosing(primitive.indices)) {
      budget.triangles -= primitive.indices.length / 3;
      this.fronts = new FrontFaces(whole, primitive.positions, primitive.indices);
    }
    return this.fronts;
  }

  private refresh(): void {
    const { look, style } = this;
    if (!look || !style) return;
    const { appearance, display } = style;
    if (this.faces) {
      this.faces.visible = appearance.faces;
      const hasNormals = this.faces.geometry.hasAttribute("normal");
      styleFaces(this.faces.material, style, { closed: this.isClosed, hasNormals, opacity: look.opacity });
    }
    if (this.points) {
      this.points.material.size = look.pointSize;
      clip(this.points.material, style.clipping);
    }
    if (this.lines) clip(this.lines.material, style.clipping);
    this.showEdges(appearance);
    this.showAllEdges(appearance.edges === "all");
    this.showVertices();
    if (this.boundary) this.boundary.visible = display.boundary || appearance.edges === "all";
    if (this.nonManifold) this.nonManifold.visible = display.nonManifold;
    this.showStencils(style.stencil && this.isClosed && appearance.faces && !isTransparent(look.opacity));
  }

  private get isClosed(): boolean {
    return this.shape.kind === "volume3d";
  }

  /** The creases, or all that the server sent, which with those inside of smooth faces make all edges of triangles. */
  private showEdges({ edges: mode, faces }: Style["appearance"]): void {
    if (!this.edges) return;
    const all = primitiveOf(this.shape, "edges")?.indices ?? null;
    // Without faces, a smooth object would be empty with its creases alone.
    const creases = mode === "features" && faces;
    const indices = mode === "none" ? null : creases ? featureLines(this.shape) : all;
    this.edges.visible = indices !== null;
    if (!indices || this.edges.geometry.index?.array === indices) return;
    this.edges.geometry.setIndex(new BufferAttribute(indices, 1));
  }

  private showAllEdges(show: boolean): void {
    const faces = primitiveOf(this.shape, "faces");
    if (show && !this.allEdges && faces?.indices) {
      const lines: Primitive = { ...faces, normals: null, indices: triangleEdges(faces.indices) };
      this.allEdges = new LineSegments(
        geometryOf(lines, this.cache, sphereOf(this.shape)),
        this.shared.edges,
      );
      this.group.add(this.allEdges);
    }
    if (!show && this.allEdges) {
      this.allEdges.geometry.dispose();
      this.group.remove(this.allEdges);
      this.allEdges = null;
    }
  }

  private showStencils(show: boolean): void {
    const { whole } = this;
    if (show && this.stencils.length === 0 && whole) {
      this.stencils = [this.shared.stencilBack, this.shared.stencilFront].map((material) => {
        const mesh = new Mesh(whole, material);
        mesh.renderOrder = -2;
        this.group.add(mesh);
        return mesh;
      });
    }
    for (const mesh of this.stencils) mesh.visible = show;
  }

  showGrips(show: boolean): void {
    this.hasGrips = show;
    this.showVertices();
  }

  private showVertices(): void {
    const faces = primitiveOf(this.shape, "faces");
    const show = this.hasGrips || (this.style?.appearance.vertices ?? false);
    if (show && !this.vertices && faces) {
      const corners: Primitive = { ...faces, normals: null, indices: null };
      this.vertices = new Points(geometryOf(corners, this.cache, sphereOf(this.shape)));
      this.vertices.renderOrder = 3;
      this.group.add(this.vertices);
    }
    if (!this.vertices) return;
    this.vertices.visible = show;
    this.vertices.material = this.hasGrips ? this.shared.grips : this.shared.vertices;
  }

  positionsChanged(): void {
    this.dropFronts();
    this.colorElements(this.look?.elements ?? null);
    for (const child of this.group.children) {
      const attribute = geometryOfChild(child).getAttribute("position");
      if (attribute instanceof BufferAttribute) attribute.needsUpdate = true;
    }
  }

  private dropFronts(): void {
    if (this.faces && this.whole) this.faces.geometry = this.colored ?? this.whole;
    this.fronts?.dispose();
    this.fronts = null;
  }

  dispose(): void {
    this.parent.remove(this.group);
    this.dropFronts();
    this.whole?.dispose();
    for (const child of this.group.children) geometryOfChild(child).dispose();
    this.faces?.material.dispose();
    this.points?.material.dispose();
    this.lines?.material.dispose();
  }
}

function isShort(primitive: Primitive): boolean {
  return (primitive.indices?.length ?? primitive.positions.length / 3) / 2 <= kMaxWideSegments;
}

/** All children of the group of a body draw a geometry. */
function geometryOfChild(child: Object3D): BufferGeometry {
  return (child as Object3D & { readonly geometry: BufferGeometry }).geometry;
}
