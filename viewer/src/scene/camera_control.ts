/** Brings the camera to where it should be, in a short movement unless the person does not want animations. */

import type { Box3, Vector3 } from "three";

import type { CameraState, StandardView } from "./api";
import { between, cameraDifference, fitted, looking, normalizedCamera, turned } from "./camera";

const kMilliseconds = 350;

export interface CameraHost {
  camera(): CameraState;
  show(camera: CameraState, moving: boolean): void;
  /** Width of the view by its height. */
  aspect(): number;
  /** What is seen within a box, if that is less than all of it. */
  points?(box: Box3): readonly Vector3[] | undefined;
  /** Nothing would be seen of a movement. */
  isBlind(): boolean;
}

export class CameraControl {
  private frame = 0;
  private going: CameraState | null = null;

  constructor(private readonly host: CameraHost) {}

  /** Where the camera is, or is going. */
  get goal(): CameraState {
    return this.going ?? this.host.camera();
  }

  /** The camera that sees all of a box from the present side. */
  seeing(box: Box3): CameraState {
    return this.fitted(this.goal, box);
  }

  private fitted(camera: CameraState, box: Box3): CameraState {
    return fitted(camera, box, this.host.aspect(), this.host.points?.(box));
  }

  fit(box: Box3, animate = true): void {
    this.go(this.seeing(box), animate);
  }

  look(view: StandardView, box: Box3, animate = true): void {
    this.go(this.fitted(looking(this.goal, view), box), animate);
  }

  turn(axis: "roll" | "up" | "side", degrees: number): void {
    this.go(turned(this.goal, axis, degrees));
  }

  go(camera: CameraState, animate = true): void {
    this.stop();
    const to = normalizedCamera(camera);
    const from = this.host.camera();
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const jump = from.projection !== to.projection || cameraDifference(from, to) < 1e-9;
    if (!animate || still || jump || this.host.isBlind()) this.host.show(to, false);
    else this.animate(from, to);
  }

  private animate(from: CameraState, to: CameraState): void {
    this.going = to;
    const begin = performance.now();
    const step = (): void => {
      const part = Math.min(1, (performance.now() - begin) / kMilliseconds);
      if (part < 1) this.frame = requestAnimationFrame(step);
      else this.going = null;
      this.host.show(between(from, to, part * part * (3 - 2 * part)), true);
    };
    this.frame = requestAnimationFrame(step);
  }

  /** Stays where it is. */
  stop(): void {
    cancelAnimationFrame(this.frame);
    this.going = null;
  }

  /** Jumps to the goal: what is changed next is meant to start from there. */
  finish(): void {
    const { going } = this;
    this.stop();
    if (going) this.host.show(going, false);
  }
}
