import type { Layout, Sheet } from "../state/layout";
import { useApp } from "./context";
import { Icon, type IconName } from "./ui/Icon";

const sheets: readonly { readonly id: Sheet; readonly label: string; readonly icon: IconName }[] = [
  { id: "scene", label: "3D", icon: "cube" },
  { id: "query", label: "Query", icon: "code" },
  { id: "results", label: "Results", icon: "table" },
  { id: "view", label: "View", icon: "palette" },
];

/** Lists are shown with the editor, and settings alone. */
function showSheet(layout: Layout, sheet: Sheet): void {
  layout.sheet.value = sheet;
  if (sheet === "view") layout.sideTab.value = "view";
  else if (sheet === "query" && layout.sideTab.value === "view") layout.sideTab.value = "objects";
}

/** On narrow pages: which panel is drawn over the lower half of the scene. */
export function SheetTabs() {
  const { layout } = useApp().store;
  return (
    <nav class="sheet-tabs" aria-label="Panels">
      {sheets.map(({ id, label, icon }) => (
        <button
          key={id}
          type="button"
          aria-current={layout.sheet.value === id ? "page" : undefined}
          onClick={() => showSheet(layout, id)}
        >
          <Icon name={icon} />
          {label}
        </button>
      ))}
    </nav>
  );
}
