/**
 * Movements of the camera as functions from one CameraState to the next. World z is up.
 *
 * `height` is what is seen at the target from the lower to the upper edge of the view. The distance of the eye follows
 * from it, so that both projections show the target at the same size.
 */

import { Matrix4, Quaternion, Vector3 } from "three";
import type { Box3 } from "three";

import type { CameraState, StandardView, Vec3 } from "./api";
import { fromVector3, toVector3 } from "./vec";

/** Opening angle of the perspective from the lower to the upper edge, in degrees. */
export const kFieldOfView = 30;
const kHalfTangent = Math.tan((kFieldOfView * Math.PI) / 360);

/** Floats of a graphics card have all their digits down to about here. */
const kLeastHeight = 1e-30;
const kLargestHeight = 1e38;

/** Free border around what is fitted, as a factor of its size. */
const kMargin = 1.08;

export interface Basis {
  readonly right: Vector3;
  readonly up: Vector3;
  /** From the target to the eye. */
  readonly back: Vector3;
}

/** The axes of the camera as unit vectors, also where `up` is (nearly) the direction of sight. */
export function basisOf(camera: CameraState): Basis {
  const back = toVector3(camera.position).sub(toVector3(camera.target));
  if (back.lengthSq() === 0) back.set(0, -1, 0);
  back.normalize();
  let right = toVector3(camera.up).cross(back);
  if (right.lengthSq() < 1e-20) right = new Vector3(0, 1, 0).cross(back);
  if (right.lengthSq() < 1e-20) right = new Vector3(1, 0, 0);
  right.normalize();
  return { right, up: back.clone().cross(right).normalize(), back };
}

/** Distance of the eye from the target at which the perspective shows this height. */
export function eyeDistance(height: number): number {
  return height / (2 * kHalfTangent);
}

/** The least that can be seen at a place: with less the eye could not be told from its target in doubles. */
function leastHeight({ x, y, z }: Vector3): number {
  return Math.max(kLeastHeight, 1e-11 * Math.max(Math.abs(x), Math.abs(y), Math.abs(z)));
}

function placed(camera: CameraState, target: Vector3, basis: Basis, wanted: number): CameraState {
  const height = Math.max(wanted, leastHeight(target));
  const position = target.clone().addScaledVector(basis.back, eyeDistance(height));
  return {
    ...camera,
    target: fromVector3(target),
    position: fromVector3(position),
    up: fromVector3(basis.up),
    height,
  };
}

/** The same view with the eye at the distance that its height demands, and `up` at right angles to the sight. */
export function normalizedCamera(camera: CameraState): CameraState {
  const height = Number.isFinite(camera.height) && camera.height > 0 ? camera.height : 1;
  return placed(camera, toVector3(camera.target), basisOf(camera), height);
}

/**
 * Turns the camera about `pivot` (the target if not given) by angles in radians: `sideways` to the right, `upwards`.
 * The turntable keeps the z axis upright and stops at the poles.
 */
export function orbit(
  camera: CameraState,
  sideways: number,
  upwards: number,
  style: "turntable" | "trackball",
  pivot: Vec3 = camera.target,
): CameraState {
  const basis = basisOf(camera);
  const turn = new Quaternion();
  if (style === "turntable") {
    const upright = basis.up.z < -1e-9 ? -1 : 1;
    const elevation = Math.asin(Math.min(1, Math.max(-1, basis.back.z)));
    const limited = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, elevation + upwards * upright)) - elevation;
    turn.setFromAxisAngle(new Vector3(0, 0, upright), -sideways);
    turn.multiply(new Quaternion().setFromAxisAngle(basis.right, -limited * upright));
  } else {
    turn.setFromAxisAngle(basis.up, -sideways);
    turn.multiply(new Quaternion().setFromAxisAngle(basis.right, -upwards));
  }
  return rotated(camera, basis, turn, toVector3(pivot));
}

function rotated(camera: CameraState, basis: Basis, turn: Quaternion, pivot: Vector3): CameraState {
  const moved: Basis = {
    right: basis.right.clone().applyQuaternion(turn),
    up: basis.up.clone().applyQuaternion(turn),
    back: basis.back.clone().applyQuaternion(turn),
  };
  const target = toVector3(camera.target).sub(pivot).applyQuaternion(turn).add(pivot);
  return placed(camera, target, moved, camera.height);
}

/** Turns by degrees about the direction of sight, the upward or the sideways axis of the camera. */
export function turned(camera: CameraState, axis: "roll" | "up" | "side", degrees: number): CameraState {
  const basis = basisOf(camera);
  const direction = axis === "roll" ? basis.back : axis === "up" ? basis.up : basis.right;
  const turn = new Quaternion().setFromAxisAngle(direction, (degrees * Math.PI) / 180);
  return rotated(camera, basis, turn, toVector3(camera.target));
}

/** Moves what is seen by fractions of the height of the view: to the right and upwards. */
export function pan(camera: CameraState, right: number, upwards: number): CameraState {
  const basis = basisOf(camera);
  const target = toVector3(camera.target)
    .addScaledVector(basis.right, -right * camera.height)
    .addScaledVector(basis.up, -upwards * camera.height);
  return placed(camera, target, basis, camera.height);
}

/** Changes what is seen by a factor (below 1: closer); the place `anchor` stays where it is in the picture. */
export function zoom(camera: CameraState, factor: number, anchor: Vec3 = camera.target): CameraState {
  const least = leastHeight(toVector3(camera.target));
  const height = Math.min(kLargestHeight, Math.max(least, camera.height * factor));
  const target = toVector3(camera.target)
    .sub(toVector3(anchor))
    .multiplyScalar(height / camera.height)
    .add(toVector3(anchor));
  return placed(camera, target, basisOf(camera), height);
}

/** The place in the plane through the target that is seen at (x, y), each from -1 to 1. */
export function placeInTargetPlane(camera: CameraState, x: number, y: number, aspect: number): Vec3 {
  const basis = basisOf(camera);
  return fromVector3(
    toVector3(camera.target)
      .addScaledVector(basis.right, (x * camera.height * aspect) / 2)
      .addScaledVector(basis.up, (y * camera.height) / 2),
  );
}

const kStandardViews: Readonly<Record<StandardView, { back: Vec3; up: Vec3 }>> = {
  front: { back: [0, -1, 0], up: [0, 0, 1] },
  back: { back: [0, 1, 0], up: [0, 0, 1] },
  left: { back: [-1, 0, 0], up: [0, 0, 1] },
  right: { back: [1, 0, 0], up: [0, 0, 1] },
  top: { back: [0, 0, 1], up: [0, 1, 0] },
  bottom: { back: [0, 0, -1], up: [0, -1, 0] },
  isometric: { back: [1, -1, 1], up: [0, 0, 1] },
};

/** The same target and height, seen from a standard side. */
export function looking(camera: CameraState, view: StandardView): CameraState {
  const { back, up } = kStandardViews[view];
  // About the origin: beside a target far away the direction would be lost.
  const basis = basisOf({ ...camera, target: [0, 0, 0], position: back, up });
  return placed(camera, toVector3(camera.target), basis, camera.height);
}

/** The camera, moved without turning so that all of the box is seen. */
export function fitted(camera: CameraState, box: Box3, aspect: number): CameraState {
  if (box.isEmpty()) return camera;
  const basis = basisOf(camera);
  const centre = box.getCenter(new Vector3());
  let height = 0;
  for (const corner of cornersOf(box)) {
    const offset = corner.sub(centre);
    const across = Math.max(
      Math.abs(offset.dot(basis.up)),
      Math.abs(offset.dot(basis.right)) / Math.max(aspect, 1e-6),
    );
    const depth = camera.projection === "perspective" ? offset.dot(basis.back) * kHalfTangent : 0;
    height = Math.max(height, 2 * (across + depth));
  }
  return placed(camera, centre, basis, height > 0 ? height * kMargin : 1);
}

export function cornersOf(box: Box3): Vector3[] {
  const { min, max } = box;
  return [0, 1, 2, 3, 4, 5, 6, 7].map(
    (i) => new Vector3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z),
  );
}

function orientationOf(camera: CameraState): Quaternion {
  const { right, up, back } = basisOf(camera);
  return new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(right, up, back));
}

/** The camera between two others, for `part` from 0 to 1; the height changes by equal factors. */
export function between(from: CameraState, to: CameraState, part: number): CameraState {
  if (part >= 1) return to;
  const turn = orientationOf(from).slerp(orientationOf(to), part);
  const basis: Basis = {
    right: new Vector3(1, 0, 0).applyQuaternion(turn),
    up: new Vector3(0, 1, 0).applyQuaternion(turn),
    back: new Vector3(0, 0, 1).applyQuaternion(turn),
  };
  const target = toVector3(from.target).lerp(toVector3(to.target), part);
  const height = from.height * Math.pow(to.height / from.height, part);
  return placed(to, target, basis, height);
}

/** How far two cameras differ, relative to their height; 0 if they show the same. */
export function cameraDifference(a: CameraState, b: CameraState): number {
  if (a.projection !== b.projection) return 1;
  const scale = Math.max(a.height, b.height);
  const part = (x: Vec3, y: Vec3): number => toVector3(x).distanceTo(toVector3(y)) / scale;
  return (
    part(a.target, b.target) +
    part(a.position, b.position) +
    toVector3(a.up).distanceTo(toVector3(b.up)) +
    Math.abs(a.height - b.height) / scale
  );
}
