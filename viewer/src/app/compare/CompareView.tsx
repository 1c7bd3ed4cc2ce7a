import { useSignal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
import { linkCameras } from "../../scene";
import type { SceneView } from "../../scene/api";
import { keepBothInSight } from "./fit_both";
import { useApp } from "../context";
import { CompareSide } from "./CompareSide";

/** Two meshes side by side. */
export function CompareView() {
  const { workbench } = useApp().workspace;
  const loaded = () =>
    [workbench.left, workbench.right].map((side) => side.steps.peek()[0]?.outcome.key ?? 0).join(" ");
  const synchronised = useSignal(true);
  const [left, setLeft] = useState<SceneView | null>(null);
  const [right, setRight] = useState<SceneView | null>(null);
  useEffect(() => {
    if (!left || !right || !synchronised.value) return;
    right.setCamera(left.state.camera, { animate: false });
    const ends = [linkCameras(left, right), keepBothInSight(left, right, loaded)];
    return () => ends.forEach((end) => end());
  }, [left, right, synchronised.value]);
  return (
    <div class="compare" data-testid="compare">
      <CompareSide name="left" onView={setLeft} />
      <div class="compare-middle">
        <label class="check" title="Turn both views together">
          <input
            type="checkbox"
            checked={synchronised.value}
            onChange={(event) => (synchronised.value = event.currentTarget.checked)}
          />
          <span>Same camera</span>
        </label>
      </div>
      <CompareSide name="right" onView={setRight} />
    </div>
  );
}
