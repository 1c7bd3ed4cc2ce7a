/**
 * The section plane: clips everything on the side of its normal. While it moves, the cut through solids is filled by the
 * graphics card: the stencil buffer counts the faces before and behind each pixel, and where they differ the plane is
 * inside a solid. At rest the exact surfaces from the database take its place.
 */

import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  NotEqualStencilFunc,
  Plane,
  PlaneGeometry,
  Quaternion,
  ReplaceStencilOp,
  Vector3,
} from "three";
import type { Box3 } from "three";

import type { CellRef, SectionState, Vec3 } from "./api";
import type { Shape } from "../glb/shapes";
import { cornersOf } from "./camera";
import { AttributeCache, geometryOf, primitiveOf, sphereOf } from "./geometry";
import { normalized, toVector3 } from "./vec";

export interface Cap {
  readonly cell: CellRef;
  readonly shapes: readonly Shape[];
}

export class Section {
  readonly group = new Group();
  private readonly plane = new Plane();
  private readonly planes = [this.plane];
  private readonly quad: Mesh<PlaneGeometry, MeshBasicMaterial>;
  private readonly caps = new Group();
  private readonly capMaterial = new MeshBasicMaterial({ side: DoubleSide });
  private readonly lineMaterial = new LineBasicMaterial();
  private capCells: readonly CellRef[] = [];

  constructor() {
    this.quad = new Mesh(
      new PlaneGeometry(1, 1),
      new MeshBasicMaterial({
        side: DoubleSide,
        stencilWrite: true,
        stencilRef: 0,
        stencilFunc: NotEqualStencilFunc,
        stencilFail: ReplaceStencilOp,
        stencilZFail: ReplaceStencilOp,
        stencilZPass: ReplaceStencilOp,
      }),
    );
    this.quad.renderOrder = -1;
    this.quad.frustumCulled = false;
    this.capMaterial.polygonOffset = true;
    this.capMaterial.polygonOffsetFactor = 1;
    this.capMaterial.polygonOffsetUnits = 1;
    this.group.add(this.quad, this.caps);
  }

  /** What all materials are clipped by, relative to the local origin of a projector. */
  clipping(state: SectionState, origin: Vector3): readonly Plane[] {
    if (!state.on) return [];
    const normal = toVector3(normalized(state.normal));
    this.plane.setFromNormalAndCoplanarPoint(normal.negate(), toVector3(state.point).sub(origin));
    return this.planes;
  }

  update(state: SectionState, box: Box3, edgeColor: string): void {
    this.group.visible = state.on && !box.isEmpty();
    const preview = state.cap === "preview";
    this.quad.visible = preview;
    this.caps.visible = !preview;
    this.quad.material.color.set(state.capColor);
    this.capMaterial.color.set(state.capColor);
    this.lineMaterial.color.set(edgeColor);
    if (!this.group.visible) return;
    const normal = toVector3(normalized(state.normal));
    const centre = box.getCenter(new Vector3());
    const foot = centre.addScaledVector(normal, toVector3(state.point).sub(centre).dot(normal));
    const size = box.getSize(new Vector3()).length() * 1.5 || 1;
    this.quad.position.copy(foot);
    this.quad.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), normal));
    this.quad.scale.set(size, size, 1);
  }

  setCaps(caps: readonly Cap[], offsetOf: (cell: CellRef) => Vec3): void {
    this.clearCaps();
    this.capCells = caps.map(({ cell }) => cell);
    for (const { cell, shapes } of caps) {
      for (const shape of shapes) this.addCap(shape, offsetOf(cell));
    }
  }

  get cells(): readonly CellRef[] {
    return this.capCells;
  }

  private addCap(shape: Shape, offset: Vec3): void {
    const cache = new AttributeCache();
    const group = new Group();
    group.position.set(...shape.translation).add(toVector3(offset));
    const faces = primitiveOf(shape, "faces");
    if (faces) group.add(new Mesh(geometryOf(faces, cache, sphereOf(shape)), this.capMaterial));
    const outline = primitiveOf(shape, "boundary");
    if (outline) group.add(new LineSegments(geometryOf(outline, cache, sphereOf(shape)), this.lineMaterial));
    this.caps.add(group);
  }

  private clearCaps(): void {
    this.caps.traverse((object) => {
      if (object instanceof Mesh || object instanceof LineSegments)
        (object.geometry as BufferGeometry).dispose();
    });
    this.caps.clear();
  }

  dispose(): void {
    this.clearCaps();
    this.quad.geometry.dispose();
    for (const material of [this.quad.material, this.capMaterial, this.lineMaterial]) material.dispose();
  }
}

/** The normal or its opposite: that which turns to the eye, so that what lies before the cut is taken away. */
export function facingEye(normal: Vec3, direction: Vec3): Vec3 {
  const [x, y, z] = normal;
  const along = x * direction[0] + y * direction[1] + z * direction[2];
  return along < 0 ? [0 - x, 0 - y, 0 - z] : normal;
}

/** The rectangle of the plane that covers the box, and a handle along the normal. */
export interface PlaneOutline {
  readonly corners: readonly Vec3[];
  readonly centre: Vec3;
  readonly tip: Vec3;
}

export function outlineOf(state: SectionState, box: Box3): PlaneOutline {
  const normal = toVector3(normalized(state.normal));
  const u = new Vector3(0, 0, 1).cross(normal);
  if (u.lengthSq() < 1e-6) u.set(1, 0, 0).addScaledVector(normal, -normal.x);
  u.normalize();
  const v = normal.clone().cross(u);
  const middle = box.getCenter(new Vector3());
  const foot = middle.addScaledVector(normal, toVector3(state.point).sub(middle).dot(normal));
  let [ru, rv] = [0, 0];
  for (const corner of cornersOf(box)) {
    ru = Math.max(ru, Math.abs(corner.clone().sub(foot).dot(u)));
    rv = Math.max(rv, Math.abs(corner.sub(foot).dot(v)));
  }
  const margin = 1.1;
  const at = (a: number, b: number): Vec3 =>
    foot
      .clone()
      .addScaledVector(u, a * ru * margin)
      .addScaledVector(v, b * rv * margin)
      .toArray();
  const tip = foot.clone().addScaledVector(normal, box.getSize(new Vector3()).length() * 0.18);
  return {
    corners: [at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)],
    centre: foot.toArray(),
    tip: tip.toArray(),
  };
}

/** A geometry of loose triangles, for markers. */
export function looseTriangles(coordinates: readonly number[]): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(coordinates), 3));
  return geometry;
}
