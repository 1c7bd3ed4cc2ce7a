import { useEffect } from "preact/hooks";
import { CompareView } from "./compare/CompareView";
import { EditorPane } from "./editor/EditorPane";
import { AppContext, KeeperContext, type App } from "./context";
import { ConnectionBanner } from "./messages/ConnectionBanner";
import { LinkDialog } from "./messages/LinkDialog";
import { NameDialog } from "./messages/NameDialog";
import { NoticeList } from "./messages/NoticeList";
import { TokenDialog } from "./messages/TokenDialog";
import { SidePanel } from "./panels/SidePanel";
import { ResultsPanel } from "./results/ResultsPanel";
import { SceneKeys } from "../scene_panels";
import { SceneHost } from "./SceneHost";
import { SheetTabs } from "./SheetTabs";
import { StartPanel } from "./StartPanel";
import { TopBar } from "./TopBar";
import { Tour } from "./Tour";
import { DropTarget } from "./uploads/DropTarget";
import { MenuHost } from "./ui/menu";
import { Splitter } from "./ui/Splitter";
import type { ViewKeeper } from "./view_keeper";

/** The whole page. */
export function Page({ app, keeper }: { app: App; keeper: ViewKeeper }) {
  const { layout, mode } = app.store;
  const compare = mode.value === "compare";
  const hasTable = layout.bottomOpen.value && !compare;
  const view = app.workspace.keyScene.value?.view;
  const actions: Readonly<Record<string, () => unknown>> = {
    undo: () => keeper.undo(),
    redo: () => keeper.redo(),
  };
  useEffect(() => {
    document.title = `${app.store.connection.info.value?.database ?? "algebra3d"} · algebra3d`;
  }, [app.store.connection.info.value]);
  return (
    <AppContext.Provider value={app}>
      <KeeperContext.Provider value={keeper}>
        <div
          class="page"
          data-sheet={layout.sheet.value}
          data-mode={mode.value}
          data-ended={app.store.ended.value}
          data-settled={keeper.settled.value}
        >
          <button type="button" class="btn skip" onClick={goToScene}>
            To the 3D view
          </button>
          <TopBar />
          <ConnectionBanner />
          <div class="page-body">
            <main class="centre">
              <div class="scene-place" hidden={compare}>
                <SceneHost />
              </div>
              {compare && <CompareView />}
              {hasTable && (
                <Splitter
                  size={layout.bottomHeight}
                  direction="vertical"
                  reverse
                  min={96}
                  label="Height of the results"
                />
              )}
              <div
                class="bottom-place"
                style={hasTable ? { height: `${layout.bottomHeight.value}px` } : undefined}
              >
                <EditorPane />
                <div class="table-place" hidden={!hasTable}>
                  <ResultsPanel />
                </div>
                {!compare && <StartPanel />}
              </div>
            </main>
            <aside
              class="side-place"
              aria-label="Lists and settings"
              hidden={!layout.sideOpen.value}
              style={{ width: `${layout.sideWidth.value}px` }}
            >
              <Splitter
                size={layout.sideWidth}
                direction="horizontal"
                reverse
                min={220}
                label="Width of the side panel"
              />
              <SidePanel />
            </aside>
          </div>
          <SheetTabs />
          <NoticeList />
          <DropTarget />
          {view && (
            <SceneKeys
              view={view}
              onAction={(action) => actions[action]?.()}
              onError={(message) => app.store.notices.add("error", message)}
            />
          )}
          <MenuHost />
          <TokenDialog />
          <LinkDialog />
          <Tour />
          <NameDialog />
        </div>
      </KeeperContext.Provider>
    </AppContext.Provider>
  );
}

function goToScene(): void {
  document
    .querySelector<HTMLElement>(".scene-place:not([hidden]) .scene-canvas, .compare .scene-canvas")
    ?.focus();
}
