/** Whether the camera may follow a result whose shapes come one after the other. */

import type { CameraState } from "./api";
import { cameraDifference } from "./camera";

/** A camera that was only rounded on its way still counts as the same one. */
const kSameCamera = 1e-6;

/** Remembers where the camera was put for a result: it follows the later shapes until something else moves it. */
export class CameraFollow {
  private placed: { readonly result: string; readonly camera: CameraState } | null = null;

  /** The camera was put so that it sees what there is of a result. */
  put(result: string, camera: CameraState): void {
    this.placed = { result, camera };
  }

  /** Whether the camera is still where it was put for this result. */
  follows(result: string, camera: CameraState): boolean {
    return this.followed(camera) === result;
  }

  /** The result for which the camera was put where it still is; null if it was moved since. */
  followed(camera: CameraState): string | null {
    const { placed } = this;
    return placed && cameraDifference(placed.camera, camera) < kSameCamera ? placed.result : null;
  }
}
