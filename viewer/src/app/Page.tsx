import { useEffect } from "preact/hooks";
import { CompareView } from "./compare/CompareView";
import { AppContext, KeeperContext, type App } from "./context";
import { ConnectionBanner } from "./messages/ConnectionBanner";
import { LinkDialog } from "./messages/LinkDialog";
import { NameDialog } from "./messages/NameDialog";
import { NoticeList } from "./messages/NoticeList";
import { TokenDialog } from "./messages/TokenDialog";
import { LeftPanel } from "./panels/LeftPanel";
import { RightPanel } from "./panels/RightPanel";
import { ResultsPanel } from "./results/ResultsPanel";
import { SceneKeys } from "../scene_panels";
import { SceneHost } from "./SceneHost";
import { SheetTabs } from "./SheetTabs";
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
          <TopBar />
          <ConnectionBanner />
          <div class="page-body">
            <div
              class="left-place"
              hidden={!layout.leftOpen.value}
              style={{ width: `${layout.leftWidth.value}px` }}
            >
              <LeftPanel />
            </div>
            {layout.leftOpen.value && (
              <Splitter
                size={layout.leftWidth}
                direction="horizontal"
                min={240}
                label="Width of the left panel"
              />
            )}
            <main class="centre">
              <div class="scene-place" hidden={compare}>
                <SceneHost />
              </div>
              {compare && <CompareView />}
              {layout.bottomOpen.value && !compare && (
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
                hidden={!layout.bottomOpen.value || compare}
                style={{ height: `${layout.bottomHeight.value}px` }}
              >
                <ResultsPanel />
              </div>
            </main>
            {layout.rightOpen.value && (
              <Splitter
                size={layout.rightWidth}
                direction="horizontal"
                reverse
                min={220}
                label="Width of the right panel"
              />
            )}
            <div
              class="right-place"
              hidden={!layout.rightOpen.value}
              style={{ width: `${layout.rightWidth.value}px` }}
            >
              <RightPanel />
            </div>
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
