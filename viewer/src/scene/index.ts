/** The scene as the rest of the viewer sees it. */

import type { SceneView } from "./api";
import { cameraDifference } from "./camera";
import { View } from "./scene_view";

export type * from "./api";
export { kNavigationPresets, describePreset } from "./navigation";
export { kShortcuts, keyName, searchShortcuts, shortcutOf } from "./shortcuts";
export type { Shortcut } from "./shortcuts";

/** A new view in an element, which it fills. Without WebGL it is made, too; then `problem` says why nothing is drawn. */
export function createSceneView(element: HTMLElement): SceneView {
  return new View(element);
}

/** Cameras of several views follow each other; returns a function that ends this. */
export function linkCameras(...views: readonly SceneView[]): () => void {
  let following = false;
  const ends = views.map((view) =>
    view.on("state", ({ parts }) => {
      if (following || !parts.includes("camera")) return;
      following = true;
      for (const other of views) {
        if (other === view || cameraDifference(other.state.camera, view.state.camera) === 0) continue;
        other.setCamera(view.state.camera, { animate: false });
      }
      following = false;
    }),
  );
  return () => ends.forEach((end) => end());
}

export * from "./statements";
export { kMeasures, measureInfo, questionOf } from "./measures";
export { facingEye } from "./section";
export { kDefaultState } from "./state";
export { hasMeshes } from "./actions";
export { kPaletteNames, paletteStops } from "./colors";
export { newLight } from "./lights";
export { overridden } from "./coloring";
