import type { SceneView } from "../scene/api";

/** Replaced by the bar of the scene's panels. */
export function SceneTools({ view }: { view: SceneView }) {
  return (
    <div class="scene-tools" role="toolbar" aria-label="View">
      <button type="button" class="btn quiet" onClick={() => view.home()}>
        Reset view
      </button>
    </div>
  );
}
