/**
 * Movements of the camera as functions from one CameraState to the next. World z is up.
 *
 * `height` is what is seen at the target from the lower to the upper edge of the view. The distance of the eye follows
 * from it, so that both projections show the target at the same size.
 *
 * Places near the target are given relative to it: beside coordinates of 1e15, doubles would lose what is seen of
 * objects of size 1.
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
  const back = toVector3(camera.direction);
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

/** The least that can be seen at a place: doubles distinguish no more than four numbers in it. */
function leastHeight([x, y, z]: Vec3): number {
  return Math.max(kLeastHeight, 2 ** -50 * Math.max(Math.abs(x), Math.abs(y), Math.abs(z)));
}

/** The target moved by a vector, without losing digits of the vector beside those of the target. */
function movedTarget({ target, rest }: CameraState, by: Vector3): Pick<CameraState, "target" | "rest"> {
  const sums = [0, 1, 2].map((axis) => twoSum(target[axis]!, rest[axis]! + by.getComponent(axis)));
  return { target: sums.map(([sum]) => sum) as never, rest: sums.map(([, error]) => error) as never };
}

/** The sum, rounded, and what was lost by rounding, exactly [knuth1997]. */
function twoSum(a: number, b: number): readonly [number, number] {
  const sum = a + b;
  const part = sum - a;
  return [sum, a - (sum - part) + (b - part)];
}

function placed(
  camera: CameraState,
  place: Pick<CameraState, "target" | "rest">,
  basis: Basis,
  wanted: number,
): CameraState {
  return {
    projection: camera.projection,
    target: place.target,
    rest: place.rest,
    direction: fromVector3(basis.back),
    up: fromVector3(basis.up),
    height: Math.max(wanted, leastHeight(place.target)),
  };
}

/** The same view with unit vectors, `up` at right angles to the sight, and a height that can be seen. */
export function normalizedCamera(camera: CameraState): CameraState {
  const height = Number.isFinite(camera.height) && camera.height > 0 ? camera.height : 1;
  return placed(camera, movedTarget(camera, new Vector3()), basisOf(camera), height);
}

/**
 * Turns the camera about its target by angles in radians: `sideways` to the right, `upwards`. The turntable keeps the z
 * axis upright and stops at the poles.
 */
export function orbit(
  camera: CameraState,
  sideways: number,
  upwards: number,
  style: "turntable" | "trackball",
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
  return rotated(camera, basis, turn);
}

function rotated(camera: CameraState, basis: Basis, turn: Quaternion): CameraState {
  const moved: Basis = {
    right: basis.right.clone().applyQuaternion(turn),
    up: basis.up.clone().applyQuaternion(turn),
    back: basis.back.clone().applyQuaternion(turn),
  };
  return placed(camera, camera, moved, camera.height);
}

/** Turns by degrees about the direction of sight, the upward or the sideways axis of the camera. */
export function turned(camera: CameraState, axis: "roll" | "up" | "side", degrees: number): CameraState {
  const basis = basisOf(camera);
  const direction = axis === "roll" ? basis.back : axis === "up" ? basis.up : basis.right;
  const turn = new Quaternion().setFromAxisAngle(direction, (degrees * Math.PI) / 180);
  return rotated(camera, basis, turn);
}

/** Moves what is seen by fractions of the height of the view: to the right and upwards. */
export function pan(camera: CameraState, right: number, upwards: number): CameraState {
  const basis = basisOf(camera);
  const by = new Vector3()
    .addScaledVector(basis.right, -right * camera.height)
    .addScaledVector(basis.up, -upwards * camera.height);
  return placed(camera, movedTarget(camera, by), basis, camera.height);
}

/**
 * Changes what is seen by a factor (below 1: closer); the place `anchor`, relative to the target, stays where it is in
 * the picture.
 */
export function zoom(camera: CameraState, factor: number, anchor: Vec3 = [0, 0, 0]): CameraState {
  const least = leastHeight(camera.target);
  const height = Math.min(kLargestHeight, Math.max(least, camera.height * factor));
  const by = toVector3(anchor).multiplyScalar(1 - height / camera.height);
  return placed(camera, movedTarget(camera, by), basisOf(camera), height);
}

/** The place in the plane through the target that is seen at (x, y), each from -1 to 1; relative to the target. */
export function placeInTargetPlane(camera: CameraState, x: number, y: number, aspect: number): Vec3 {
  const basis = basisOf(camera);
  return fromVector3(
    new Vector3()
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
  return placed(camera, camera, basisOf({ ...camera, direction: back, up }), camera.height);
}

/** The camera, moved without turning so that all of the box is seen; or only the points that are given. */
export function fitted(
  camera: CameraState,
  box: Box3,
  aspect: number,
  points: readonly Vector3[] = cornersOf(box),
): CameraState {
  if (box.isEmpty() || points.length === 0) return camera;
  const basis = basisOf(camera);
  const centre = box.getCenter(new Vector3());
  centre.add(middleAlong(points, centre, basis));
  let height = 0;
  for (const corner of points) {
    const offset = corner.clone().sub(centre);
    const across = Math.max(
      Math.abs(offset.dot(basis.up)),
      Math.abs(offset.dot(basis.right)) / Math.max(aspect, 1e-6),
    );
    const depth = camera.projection === "perspective" ? offset.dot(basis.back) * kHalfTangent : 0;
    height = Math.max(height, 2 * (across + depth));
  }
  const place = { target: fromVector3(centre), rest: [0, 0, 0] } as const;
  return placed(camera, place, basis, height > 0 ? height * kMargin : 1);
}

/** The middle of points as the axes of a camera see them, relative to an origin near them. */
function middleAlong(points: readonly Vector3[], origin: Vector3, { right, up, back }: Basis): Vector3 {
  const middle = new Vector3();
  for (const axis of [right, up, back]) {
    let [low, high] = [Infinity, -Infinity];
    for (const point of points) {
      const along = point.clone().sub(origin).dot(axis);
      low = Math.min(low, along);
      high = Math.max(high, along);
    }
    middle.addScaledVector(axis, (low + high) / 2);
  }
  return middle;
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
  const by = targetDifference(to, from).multiplyScalar(part);
  const height = from.height * Math.pow(to.height / from.height, part);
  return placed(to, movedTarget(from, by), basis, height);
}

function targetDifference(a: CameraState, b: CameraState): Vector3 {
  return toVector3(a.target)
    .sub(toVector3(b.target))
    .add(toVector3(a.rest).sub(toVector3(b.rest)));
}

/** How far two cameras differ, relative to their height; 0 if they show the same. */
export function cameraDifference(a: CameraState, b: CameraState): number {
  if (a.projection !== b.projection) return 1;
  const scale = Math.max(a.height, b.height);
  return (
    targetDifference(a, b).length() / scale +
    toVector3(a.direction).distanceTo(toVector3(b.direction)) +
    toVector3(a.up).distanceTo(toVector3(b.up)) +
    Math.abs(a.height - b.height) / scale
  );
}
