import { useApp } from "./context";
import { bindScene } from "./scene_bridge";
import { SceneFrame } from "./SceneFrame";
import { ReviewList } from "./uploads/ReviewList";

/** The scene of the results, with its messages. */
export function SceneHost() {
  const app = useApp();
  const { store, workspace } = app;
  const nothing = store.results.list.value.every(({ shown }) => shown.value.size === 0);
  return (
    <div class="scene-host">
      <SceneFrame
        label="3D view"
        testId="scene"
        hint={
          nothing && store.results.list.value.length > 0
            ? "Run a query with solids, surfaces or points, click an object, or drop a mesh file here."
            : null
        }
        bind={(view) => bindScene(view, app)}
        onModel={(model) => (workspace.scene.value = model)}
      >
        <ReviewList />
      </SceneFrame>
    </div>
  );
}
