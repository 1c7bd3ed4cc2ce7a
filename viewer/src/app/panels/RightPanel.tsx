import { useMemo } from "preact/hooks";
import { ScenePanels } from "../../scene_panels";
import { useApp } from "../context";
import { panelDatabase } from "../panel_database";

/** The settings and tools of the scene of the results. */
export function RightPanel() {
  const app = useApp();
  const view = app.workspace.scene.value;
  const database = useMemo(() => panelDatabase(app), [app]);
  if (!view) return null;
  return (
    <aside class="panel right-panel" aria-label="Settings of the view">
      <div class="panel-head">
        <h2 class="panel-title">View</h2>
      </div>
      <div class="panel-body">
        <ScenePanels view={view} database={database} />
      </div>
    </aside>
  );
}
