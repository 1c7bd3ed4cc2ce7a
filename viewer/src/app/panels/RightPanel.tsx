import { ScenePanels } from "../../scene_panels";
import { useApp } from "../context";

/** The settings and tools of the scene that is used: that of the results, or a side of the split screen. */
export function RightPanel() {
  const { store, workspace } = useApp();
  const model = workspace.keyScene.value;
  if (!model) return null;
  const side = store.mode.value === "compare" ? `, ${workspace.keySide.value} side` : "";
  return (
    <aside class="panel right-panel" aria-label="Settings of the view">
      <div class="panel-head">
        <h2 class="panel-title">View{side}</h2>
      </div>
      <div class="panel-body">
        <ScenePanels key={model} model={model} />
      </div>
    </aside>
  );
}
