import type { LeftTab } from "../../state/layout";
import { useApp } from "../context";
import { EditorPane } from "../editor/EditorPane";
import { Splitter } from "../ui/Splitter";
import { Tabs } from "../ui/controls";
import { HistoryList } from "./HistoryList";
import { ObjectList } from "./ObjectList";
import { OperatorList } from "./OperatorList";

const tabs: readonly { readonly id: LeftTab; readonly label: string }[] = [
  { id: "objects", label: "Objects" },
  { id: "operators", label: "Operators" },
  { id: "history", label: "History" },
];

/** The editor, and below it what can be put into it. */
export function LeftPanel() {
  const { layout } = useApp().store;
  const tab = layout.leftTab.value;
  return (
    <div class="panel left-panel">
      <div class="editor-place" style={{ height: `${layout.editorHeight.value}px` }}>
        <EditorPane />
      </div>
      <Splitter size={layout.editorHeight} direction="vertical" min={120} label="Height of the editor" />
      <Tabs label="Lists" items={tabs} selected={tab} onSelect={(id) => (layout.leftTab.value = id)} />
      <div class="panel-body" role="tabpanel" aria-label={tabs.find(({ id }) => id === tab)?.label}>
        {tab === "objects" && <ObjectList />}
        {tab === "operators" && <OperatorList />}
        {tab === "history" && <HistoryList />}
      </div>
    </div>
  );
}
