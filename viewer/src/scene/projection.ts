/**
 * The camera of three.js for a CameraState, and the way from coordinates to pixels and back, all in doubles.
 *
 * What three.js computes with is relative to the target of the camera, the local origin: coordinates of the database
 * may be so large that the objects would be lost beside them.
 */

import { Matrix4, OrthographicCamera, PerspectiveCamera, Ray, Vector3, Vector4 } from "three";
import type { Box3 } from "three";

import type { CameraState, Vec3 } from "./api";
import { basisOf, cornersOf, eyeDistance, kFieldOfView } from "./camera";
import type { EyeFrom } from "./front_faces";
import { toVector3 } from "./vec";

export interface Size {
  readonly width: number;
  readonly height: number;
}

/** A place on the view in CSS pixels, and its depth (-1 near to 1 far). */
export interface ScreenPoint {
  readonly x: number;
  readonly y: number;
  readonly depth: number;
  /** Before the eye. */
  readonly visible: boolean;
}

/** Without perspective, depths are resolved evenly: beyond so many distances of the eye nothing near would be. */
const kDeepest = 1e4;

/** Distances of the eye from 2^-30 to 2^30 need no care. */
const kLargestExponent = 30;

export class Projector {
  private readonly perspective = new PerspectiveCamera(kFieldOfView);
  private readonly orthographic = new OrthographicCamera();
  private readonly matrix = new Matrix4();
  private state: CameraState | null = null;
  /** The local origin. */
  readonly origin = new Vector3();
  size: Size = { width: 1, height: 1 };

  get aspect(): number {
    return this.size.width / Math.max(1, this.size.height);
  }

  /** The camera for this state, with near and far around the box of all that may be seen. */
  camera(state: CameraState, box: Box3): PerspectiveCamera | OrthographicCamera {
    this.state = state;
    this.origin.copy(toVector3(state.target));
    const basis = basisOf(state);
    const eye = eyeDistance(state.height);
    const position = toVector3(state.rest).addScaledVector(basis.back, eye);
    const { near, far } = depthRange(
      position,
      basis.back,
      box.clone().translate(this.origin.clone().negate()),
      eye,
    );
    const camera = state.projection === "perspective" ? this.perspective : this.orthographic;
    if (camera instanceof PerspectiveCamera) {
      camera.aspect = this.aspect;
      // Far things must not push the near plane over what is looked at.
      camera.near = Math.max(near, Math.min(far * 1e-5, eye * 1e-2), eye * 1e-4);
    } else {
      camera.top = state.height / 2;
      camera.bottom = -camera.top;
      camera.right = camera.top * this.aspect;
      camera.left = -camera.right;
      camera.near = Math.max(near, -kDeepest * eye);
    }
    const end = camera instanceof PerspectiveCamera ? far : Math.min(far, kDeepest * eye);
    camera.far = Math.max(end, camera.near + eye * 1e-3);
    camera.position.copy(position);
    camera.up.copy(basis.up);
    camera.matrix.makeBasis(basis.right, basis.up, basis.back).setPosition(position);
    camera.matrix.decompose(camera.position, camera.quaternion, camera.scale);
    camera.updateProjectionMatrix();
    if (camera instanceof PerspectiveCamera) scaleToUnit(camera, eye);
    camera.updateMatrixWorld(true);
    this.matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    return camera;
  }

  project(point: Vec3 | Vector3): ScreenPoint {
    return this.projectLocal(this.toLocal(point));
  }

  projectLocal({ x, y, z }: Vector3): ScreenPoint {
    const clip = new Vector4(x, y, z, 1).applyMatrix4(this.matrix);
    const w = clip.w === 0 ? 1e-30 : clip.w;
    return {
      x: ((clip.x / w + 1) / 2) * this.size.width,
      y: ((1 - clip.y / w) / 2) * this.size.height,
      depth: clip.z / w,
      visible: clip.w > 0,
    };
  }

  /** Coordinates of the database relative to the local origin. */
  toLocal(point: Vec3 | Vector3): Vector3 {
    return (point instanceof Vector3 ? point.clone() : toVector3(point)).sub(this.origin);
  }

  /** Coordinates of the database, rounded to doubles. */
  toGlobal(local: Vector3): Vector3 {
    return local.clone().add(this.origin);
  }

  /** Places of the view from -1 to 1, y upwards, for a place in CSS pixels. */
  normalized(x: number, y: number): readonly [number, number] {
    return [(2 * x) / this.size.width - 1, 1 - (2 * y) / this.size.height];
  }

  /** The ray through a place in CSS pixels, with a unit direction; local. It begins before all that is seen. */
  ray(x: number, y: number): Ray {
    const state = this.state!;
    const basis = basisOf(state);
    const [nx, ny] = this.normalized(x, y);
    const eye = eyeDistance(state.height);
    const inPlane = toVector3(state.rest)
      .addScaledVector(basis.right, (nx * state.height * this.aspect) / 2)
      .addScaledVector(basis.up, (ny * state.height) / 2);
    if (state.projection === "perspective") {
      const origin = toVector3(state.rest).addScaledVector(basis.back, eye);
      return new Ray(origin, inPlane.sub(origin).normalize());
    }
    const reach = this.orthographic.far - this.orthographic.near + eye;
    return new Ray(inPlane.addScaledVector(basis.back, reach), basis.back.clone().negate());
  }

  /** Where the camera looks from, as seen from a place. */
  readonly eyeFrom: EyeFrom = (place) => {
    const state = this.state!;
    const { back } = basisOf(state);
    if (state.projection === "orthographic") return [back.x, back.y, back.z, 0];
    const eye = toVector3(state.rest).addScaledVector(back, eyeDistance(state.height));
    const { x, y, z } = eye.sub(this.toLocal(place));
    return [x, y, z, 1];
  };

  /** Coordinate units of one CSS pixel at a place. */
  unitsPerPixel(at: Vec3 | Vector3): number {
    return this.unitsPerPixelLocal(this.toLocal(at));
  }

  unitsPerPixelLocal(at: Vector3): number {
    const state = this.state!;
    const whole = state.height / this.size.height;
    if (state.projection === "orthographic") return whole;
    const basis = basisOf(state);
    const eye = eyeDistance(state.height);
    const depth = eye - at.clone().sub(toVector3(state.rest)).dot(basis.back);
    return whole * Math.max(depth / eye, 1e-6);
  }
}

/**
 * Divides the coordinates before the perspective division by a power of two near the distance of the eye, where that is
 * extreme: the picture is the same, but the card interpolates with products of them, which must stay within floats.
 */
function scaleToUnit(camera: PerspectiveCamera, eye: number): void {
  const exponent = Math.round(Math.log2(eye));
  if (Math.abs(exponent) < kLargestExponent) return;
  const factor = 2 ** -exponent;
  camera.projectionMatrix.multiplyScalar(factor);
  camera.projectionMatrixInverse.multiplyScalar(1 / factor);
}

function depthRange(position: Vector3, back: Vector3, box: Box3, eye: number): { near: number; far: number } {
  if (box.isEmpty()) return { near: 0.01 * eye, far: 10 * eye };
  let [near, far] = [Infinity, -Infinity];
  for (const corner of cornersOf(box)) {
    const depth = position.clone().sub(corner).dot(back);
    near = Math.min(near, depth);
    far = Math.max(far, depth);
  }
  const margin = Math.max((far - near) * 0.02, eye * 1e-3);
  return { near: near - margin, far: far + margin };
}
