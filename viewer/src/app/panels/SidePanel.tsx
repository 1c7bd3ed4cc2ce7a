import { ScenePanels } from "../../scene_panels";
import type { SideTab } from "../../state/layout";
import { useApp } from "../context";
import { Tabs } from "../ui/controls";
import { HistoryList } from "./HistoryList";
import { ObjectList } from "./ObjectList";
import { OperatorList } from "./OperatorList";

const tabs: readonly { readonly id: SideTab; readonly label: string }[] = [
  { id: "objects", label: "Objects" },
  { id: "operators", label: "Operators" },
  { id: "history", label: "History" },
  { id: "view", label: "View" },
];

/** Beside the scene: what can be put into the editor, and the settings and tools of the view. */
export function SidePanel() {
  const { layout } = useApp().store;
  const tab = layout.sideTab.value;
  return (
    <div class="panel side-panel">
      <Tabs
        label="Lists and settings"
        panel="side-tab"
        items={tabs}
        selected={tab}
        onSelect={(id) => (layout.sideTab.value = id)}
      />
      <div
        id="side-tab"
        class="panel-body"
        role="tabpanel"
        aria-label={tabs.find(({ id }) => id === tab)?.label}
      >
        {tab === "objects" && <ObjectList />}
        {tab === "operators" && <OperatorList />}
        {tab === "history" && <HistoryList />}
        <div hidden={tab !== "view"}>
          <ViewSettings />
        </div>
      </div>
    </div>
  );
}

/** The settings and tools of the scene that is used: that of the results, or a side of the split screen. */
function ViewSettings() {
  const { store, workspace } = useApp();
  const model = workspace.keyScene.value;
  if (!model) return null;
  return (
    <section aria-label="Settings of the view">
      {store.mode.value === "compare" && (
        <h2 class="panel-title side-name">Settings of the {workspace.keySide.value} side</h2>
      )}
      <ScenePanels key={model} model={model} />
    </section>
  );
}
