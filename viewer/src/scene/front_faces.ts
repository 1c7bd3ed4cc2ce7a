/**
 * The triangles of closed solids that show their fronts, chosen before a frame. The processor compares the eye with the
 * plane of a triangle in a nanosecond; transforming, cutting and culling the triangle in software rendering takes seventy.
 */

import { BufferAttribute, BufferGeometry, DynamicDrawUsage } from "three";
import type { Vector3 } from "three";

import type { IndexArray } from "../glb/shapes";

/** With more triangles the planes and the second index take too much memory; coarser levels are drawn instead. */
const kMostTriangles = 600_000;
/** With fewer triangles nothing is gained. */
const kLeastTriangles = 2_000;

export function isWorthChoosing(triangles: IndexArray): boolean {
  const count = triangles.length / 3;
  return count >= kLeastTriangles && count <= kMostTriangles;
}

/** Triangles whose planes may still be computed before the present frame: it must not wait for all of them. */
export interface PlaneBudget {
  triangles: number;
}

/** In a few milliseconds. */
export const kPlanesPerFrame = 200_000;

/** Where one looks from, in homogeneous coordinates: a point and 1, or a direction towards the eye and 0. */
export type Eye = readonly [number, number, number, 0 | 1];

/** The eye as seen from an object that lies at a place. */
export type EyeFrom = (place: Vector3) => Eye;

export class FrontFaces {
  /** Draws the triangles that were chosen; has the attributes of the whole geometry. */
  readonly geometry = new BufferGeometry();
  /** Of each triangle its normal, times twice the area, and the distance of its plane from the origin, times the same. */
  private readonly planes: Float32Array;
  private readonly chosen: Uint32Array<ArrayBuffer>;
  private readonly index: BufferAttribute;
  private readonly radius: number;
  private last: Eye | null = null;

  constructor(
    whole: BufferGeometry,
    positions: Float32Array,
    private readonly triangles: IndexArray,
  ) {
    this.planes = planesOf(positions, triangles);
    this.radius = positions.reduce((most, part) => Math.max(most, Math.abs(part)), 0);
    this.chosen = new Uint32Array(triangles.length);
    this.index = new BufferAttribute(this.chosen, 1);
    this.index.setUsage(DynamicDrawUsage);
    for (const [name, attribute] of Object.entries(whole.attributes)) {
      this.geometry.setAttribute(name, attribute);
    }
    this.geometry.boundingSphere = whole.boundingSphere;
    this.geometry.setIndex(this.index);
  }

  /** Chooses the triangles whose fronts are seen, and those seen edge-on. Cost: linear. */
  choose(eye: Eye): void {
    if (this.last?.every((part, i) => part === eye[i])) return;
    this.last = eye;
    const count = this.write(eye);
    this.index.clearUpdateRanges();
    this.index.addUpdateRange(0, count);
    this.index.needsUpdate = true;
    this.geometry.setDrawRange(0, count);
  }

  private write([x, y, z, w]: Eye): number {
    const { planes, chosen, triangles, radius } = this;
    const [sx, sy, sz] = [x, y, z].map((part) => kRounding * (Math.abs(part) + w * radius)) as [
      number,
      number,
      number,
    ];
    let count = 0;
    for (let i = 0, at = 0; at < planes.length; i += 3, at += 4) {
      const [nx, ny, nz] = [planes[at]!, planes[at + 1]!, planes[at + 2]!];
      const slack = sx * Math.abs(nx) + sy * Math.abs(ny) + sz * Math.abs(nz);
      if (nx * x + ny * y + nz * z - planes[at + 3]! * w < -slack) continue;
      chosen[count] = triangles[i]!;
      chosen[count + 1] = triangles[i + 1]!;
      chosen[count + 2] = triangles[i + 2]!;
      count += 3;
    }
    return count;
  }

  dispose(): void {
    this.geometry.dispose();
  }
}

/** The planes are rounded by less than this share; triangles that may be seen edge-on are drawn. */
const kRounding = 1e-6;

function planesOf(positions: Float32Array, triangles: IndexArray): Float32Array {
  const planes = new Float32Array((triangles.length / 3) * 4);
  for (let i = 0, at = 0; i < triangles.length; i += 3, at += 4) {
    const [a, b, c] = [3 * triangles[i]!, 3 * triangles[i + 1]!, 3 * triangles[i + 2]!];
    const [x, y, z] = [positions[a]!, positions[a + 1]!, positions[a + 2]!];
    const [ux, uy, uz] = [positions[b]! - x, positions[b + 1]! - y, positions[b + 2]! - z];
    const [vx, vy, vz] = [positions[c]! - x, positions[c + 1]! - y, positions[c + 2]! - z];
    const [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    planes[at] = nx;
    planes[at + 1] = ny;
    planes[at + 2] = nz;
    planes[at + 3] = nx * x + ny * y + nz * z;
  }
  return planes;
}
