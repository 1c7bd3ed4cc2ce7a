import { useEffect } from "preact/hooks";
import { linkCameras } from "../../scene";
import { keepBothInSight } from "./fit_both";
import { useApp } from "../context";
import type { SceneView } from "../../scene/api";
import { chosenOf, type Side } from "../../state/workbench";
import { CompareSide, isDrawn } from "./CompareSide";

/** Two meshes side by side. */
export function CompareView() {
  const { workbench, sideScenes, sameCamera } = useApp().workspace;
  const left = sideScenes.left.value?.view;
  const right = sideScenes.right.value?.view;
  useEffect(() => {
    if (!left || !right || !sameCamera.value) return;
    right.setCamera(left.state.camera, { animate: false });
    const chosen = () =>
      [workbench.left, workbench.right]
        .map((side) => chosenOf(side.steps.peek())?.outcome.key ?? 0)
        .join(" ");
    const drawn = (view: SceneView, side: Side) => {
      const step = side.step.peek();
      return step !== null && isDrawn(view, step);
    };
    const loaded = () => (drawn(left, workbench.left) && drawn(right, workbench.right) ? chosen() : null);
    const ends = [linkCameras(left, right), keepBothInSight(left, right, loaded)];
    return () => ends.forEach((end) => end());
  }, [left, right, sameCamera.value]);
  return (
    <div class="compare" data-testid="compare">
      <div class="compare-head">
        <label class="check" title="Turn both views together">
          <input
            type="checkbox"
            checked={sameCamera.value}
            onChange={(event) => (sameCamera.value = event.currentTarget.checked)}
          />
          <span>Same camera</span>
        </label>
      </div>
      <CompareSide name="left" />
      <div class="compare-middle" />
      <CompareSide name="right" />
    </div>
  );
}
