import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { createSceneView } from "../scene";
import type { LoadProgress, SceneProblem, SceneView } from "../scene/api";
import { SceneOverlay, SceneToolbar, SectionReadout } from "../scene_panels";
import { ReviewList } from "./uploads/ReviewList";
import { useApp } from "./context";
import { panelDatabase } from "./panel_database";
import { bindScene } from "./scene_bridge";
import { SceneHint, SceneMessages } from "./SceneMessages";

/** The scene of the results, with its messages. */
export function SceneHost() {
  const app = useApp();
  const { store, workspace } = app;
  const place = useRef<HTMLDivElement>(null);
  const database = useMemo(() => panelDatabase(app), [app]);
  useEffect(() => {
    if (!place.current) return;
    const view = createSceneView(place.current);
    const end = bindScene(view, app);
    workspace.scene.value = view;
    return () => {
      workspace.scene.value = null;
      end();
      view.dispose();
    };
  }, []);
  const view = workspace.scene.value;
  const nothing = store.results.list.value.every(({ shown }) => shown.value.size === 0);
  return (
    <section class="scene" aria-label="3D view">
      <div
        ref={place}
        class="scene-canvas"
        tabIndex={0}
        role="application"
        aria-label="3D view; ? lists its keys"
        data-testid="scene"
        onPointerDown={(event) => event.currentTarget.focus({ preventScroll: true })}
      />
      {view && <SceneToolbar view={view} />}
      {view && <SceneOverlay view={view} />}
      {view && (
        <SectionReadout
          view={view}
          database={database}
          onSettings={() => workspace.openSettings("section")}
        />
      )}
      {view && <SceneMessages view={view} />}
      <ReviewList />
      {nothing && view && (
        <SceneHint
          view={view}
          text="Run a query with solids, surfaces or points, click an object, or drop a mesh file here."
        />
      )}
    </section>
  );
}

/** The progress of a scene that is loading, and the reason why it cannot draw. */
export function useSceneReports(view: SceneView): {
  progress: readonly LoadProgress[];
  problem: SceneProblem | null;
} {
  const [progress, setProgress] = useState(view.progress);
  const [problem, setProblem] = useState(view.problem);
  useEffect(() => {
    setProgress(view.progress);
    setProblem(view.problem);
    const ends = [
      view.on("progress", () => setProgress([...view.progress])),
      view.on("shapes", () => setProgress([...view.progress])),
      view.on("problem", setProblem),
    ];
    return () => ends.forEach((end) => end());
  }, [view]);
  return { progress, problem };
}
