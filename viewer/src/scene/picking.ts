/** What lies under the pointer: triangles by their trees, points and lines by their distance in pixels. All on the CPU. */

import { Box3, BufferAttribute, BufferGeometry, DoubleSide, Ray, Triangle, Vector3 } from "three";
import type { Plane } from "three";

import type { Hit, Vec3 } from "./api";
import type { Primitive } from "../glb/shapes";
import type { Dot } from "./dots";
import { primitiveOf } from "./geometry";
import type { Projector } from "./projection";
import type { ShapeRecord, ShapeStore } from "./shape_store";
import { snapped } from "./snapping";
import type { SnapOptions } from "./snapping";
import { TreeMaker } from "./tree";
import { fromVector3 } from "./vec";

/** A point or line is hit within so many CSS pixels. */
const kReach = 7;

export interface PickOptions {
  /** What lies on the negative side of these planes is cut away; relative to the local origin of the projector. */
  readonly clipping: readonly Plane[];
  readonly facesVisible: boolean;
  readonly snap: SnapOptions | null;
}

interface Candidate {
  readonly record: ShapeRecord;
  /** null: of a dot, which stands for the whole object. */
  readonly primitive: Primitive | null;
  /** Relative to the local origin, as the ray. */
  readonly point: Vector3;
  /** From the origin of the ray. */
  readonly distance: number;
  /** Of the triangle in its primitive, or of the vertex of a point; null for lines. */
  readonly index: number | null;
}

export class Picker {
  private readonly trees = new TreeMaker();
  private readonly geometries = new WeakMap<Primitive, BufferGeometry>();

  constructor(
    private readonly store: ShapeStore,
    private readonly projector: Projector,
    /** What is drawn as a dot now. */
    private readonly dots: () => readonly Dot[],
    /** Called when a tree that was being built is there. */
    private readonly ready: () => void,
  ) {}

  /** The nearest thing at a place in CSS pixels. Cost: linear in the objects, logarithmic in their triangles. */
  pick(x: number, y: number, options: PickOptions): Hit | null {
    const ray = this.projector.ray(x, y);
    const range = visibleRange(ray, options.clipping);
    if (!range) return null;
    let best: Candidate | null = null;
    for (const record of this.store.visibleRecords()) {
      const level = record.finest;
      if (!level) continue;
      const limit: number = best?.distance ?? Infinity;
      if (options.facesVisible || record.firstShape.kind !== "volume3d") {
        const faces = primitiveOf(level.shape, "faces");
        if (faces) best = this.pickFaces(record, faces, ray, [range[0], Math.min(range[1], limit)]) ?? best;
      }
      for (const role of options.facesVisible ? kThinRoles : kAllThinRoles) {
        const primitive = primitiveOf(level.shape, role);
        if (primitive) best = this.pickThin(record, primitive, [x, y], ray, range, best) ?? best;
      }
    }
    for (const dot of this.dots()) best = this.pickDot(dot, [x, y], ray, range, best) ?? best;
    return best ? this.hitOf(best, [x, y], options.snap) : null;
  }

  private pickFaces(
    record: ShapeRecord,
    faces: Primitive,
    ray: Ray,
    range: readonly number[],
  ): Candidate | null {
    const [near, far] = range;
    if (near! >= far! || !ray.intersectsBox(this.localBox(record))) return null;
    const tree = this.trees.tree(faces, this.geometryOf(faces), this.ready);
    if (!tree) return null;
    const fromShape = new Ray(ray.origin.clone().sub(this.localOrigin(record)), ray.direction);
    const found = tree.raycastFirst(fromShape, DoubleSide, near, far);
    if (!found) return null;
    const point = ray.at(found.distance, new Vector3());
    return { record, primitive: faces, point, distance: found.distance, index: found.faceIndex ?? null };
  }

  /** Points and lines, by their distance from the pointer on the view. */
  private pickThin(
    record: ShapeRecord,
    primitive: Primitive,
    pointer: readonly [number, number],
    ray: Ray,
    range: readonly number[],
    best: Candidate | null,
  ): Candidate | null {
    const margin = this.projector.unitsPerPixel(record.box(kBox).getCenter(new Vector3())) * kReach * 2;
    const box = this.localBox(record);
    if (!ray.intersectsBox(box.expandByScalar(margin))) return null;
    const origin = this.localOrigin(record);
    const { positions, indices } = primitive;
    const place = (vertex: number): Vector3 => new Vector3().fromArray(positions, 3 * vertex).add(origin);
    let found: Candidate | null = null;
    let nearest = Math.max(kReach, (record.look?.pointSize ?? 0) / 2);
    const offer = (point: Vector3, vertex: number | null): void => {
      const gap = this.gapTo(point, pointer);
      if (gap > nearest) return;
      const distance = this.reachedAt(point, ray, range, best);
      if (distance === null) return;
      nearest = gap;
      found = {
        record,
        primitive,
        point,
        distance: Math.min(distance, best?.distance ?? Infinity),
        index: vertex,
      };
    };
    const count = indices?.length ?? positions.length / 3;
    if (primitive.role === "points") {
      for (let i = 0; i < count; i++) offer(place(indices?.[i] ?? i), indices?.[i] ?? i);
    } else {
      for (let i = 0; i + 1 < count; i += 2) {
        const onSegment = new Vector3();
        ray.distanceSqToSegment(
          place(indices?.[i] ?? i),
          place(indices?.[i + 1] ?? i + 1),
          undefined,
          onSegment,
        );
        offer(onSegment, null);
      }
    }
    return found;
  }

  private pickDot(
    { record, at }: Dot,
    pointer: readonly [number, number],
    ray: Ray,
    range: readonly number[],
    best: Candidate | null,
  ): Candidate | null {
    const point = this.projector.toLocal(at);
    if (this.gapTo(point, pointer) > kReach) return null;
    const distance = this.reachedAt(point, ray, range, best);
    return distance === null ? null : { record, primitive: null, point, distance, index: null };
  }

  /** From the pointer to a local point, in CSS pixels. */
  private gapTo(point: Vector3, pointer: readonly [number, number]): number {
    const { x, y, visible } = this.projector.projectLocal(point);
    return visible ? Math.hypot(x - pointer[0], y - pointer[1]) : Infinity;
  }

  /** The distance along the ray at which a point near it lies; null if it is cut away or hidden by `best`. */
  private reachedAt(
    point: Vector3,
    ray: Ray,
    range: readonly number[],
    best: Candidate | null,
  ): number | null {
    const distance = point.clone().sub(ray.origin).dot(ray.direction);
    // A point on a face must win over the face.
    const slack = this.projector.unitsPerPixelLocal(point) * kReach;
    const isReached = distance >= range[0]! && distance <= range[1]!;
    return isReached && (!best || distance <= best.distance + slack) ? distance : null;
  }

  /** Relative to the local origin, as rays are. */
  private localBox(record: ShapeRecord): Box3 {
    return record.box(kBox).translate(this.projector.origin.clone().negate());
  }

  private localOrigin(record: ShapeRecord): Vector3 {
    return this.projector.toLocal(originOf(record));
  }

  /** A geometry for the trees, never drawn. */
  private geometryOf(primitive: Primitive): BufferGeometry {
    const known = this.geometries.get(primitive);
    if (known) return known;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(primitive.positions, 3));
    if (primitive.indices) geometry.setIndex(new BufferAttribute(primitive.indices, 1));
    this.geometries.set(primitive, geometry);
    return geometry;
  }

  private hitOf(found: Candidate, pointer: readonly [number, number], snap: SnapOptions | null): Hit {
    const { record, primitive, index } = found;
    const isPoints = primitive?.role === "points";
    const bare: Hit = {
      cell: record.cell,
      point: fromVector3(this.projector.toGlobal(found.point)),
      snap: primitive?.role === "faces" ? "face" : !primitive || isPoints ? "point" : "edge",
      face: null,
      vertex: isPoints && index !== null ? (primitive.vertexIds?.[index] ?? index) : null,
      triangle: null,
      edge: null,
      deviation: record.deviation,
    };
    if (primitive?.role !== "faces" || index === null) return bare;
    const hit = { ...bare, ...triangleInfo(record, primitive, index) };
    return snap ? snapped(hit, primitive, originOf(record), this.projector, pointer, snap) : hit;
  }

  /** The geometry of this primitive was changed in place. */
  forget(primitive: Primitive): void {
    this.trees.forget(primitive);
  }

  dispose(): void {
    this.trees.dispose();
  }
}

const kThinRoles = ["points", "lines"] as const;
const kAllThinRoles = ["points", "lines", "edges"] as const;
const kBox = new Box3();

/** Where the coordinates of a shape begin, in doubles. */
export function originOf(record: ShapeRecord): Vector3 {
  const origin = new Vector3(...(record.finest ?? record.levels[0])!.shape.translation);
  return record.look ? origin.add(new Vector3(...record.look.offset)) : origin;
}

/** The part of a ray that is not cut away, or null. */
export function visibleRange(ray: Ray, planes: readonly Plane[]): readonly [number, number] | null {
  let [near, far] = [0, Infinity];
  for (const plane of planes) {
    const slope = plane.normal.dot(ray.direction);
    const height = plane.distanceToPoint(ray.origin);
    if (slope === 0) {
      if (height < 0) return null;
    } else if (slope > 0) near = Math.max(near, -height / slope);
    else far = Math.min(far, -height / slope);
  }
  return near < far ? [near, far] : null;
}

function triangleInfo(record: ShapeRecord, faces: Primitive, index: number): Pick<Hit, "face" | "triangle"> {
  const origin = originOf(record);
  const vertices = [0, 1, 2].map((corner) => faces.indices?.[3 * index + corner] ?? 3 * index + corner);
  const corners = vertices.map((vertex) => new Vector3().fromArray(faces.positions, 3 * vertex).add(origin));
  const triangle = new Triangle(corners[0], corners[1], corners[2]);
  // Coarser levels have numbers of their own, which are not those of the value.
  // The faces of a nested relation belong to several values.
  const exact = record.firstShape.kind !== "arel" && (record.finest?.shape.shown ?? 0) >= record.triangles;
  const idOf = (vertex: number): number | null => (exact ? (faces.vertexIds?.[vertex] ?? vertex) : null);
  return {
    face: exact ? (faces.faceIds?.[index] ?? index) : null,
    triangle: {
      corners: corners.map(fromVector3) as [Vec3, Vec3, Vec3],
      ids: vertices.map(idOf) as [number | null, number | null, number | null],
      normal: fromVector3(triangle.getNormal(new Vector3())),
      area: triangle.getArea(),
    },
  };
}
