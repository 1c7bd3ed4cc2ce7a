import type { ComponentProps } from "preact";
import { useRef } from "preact/hooks";
import { useRoving } from "../scene_panels";
import { useApp, useKeeper } from "./context";
import { copyLink } from "./link";
import { Icon } from "./ui/Icon";
import { IconButton } from "./ui/controls";
import { openMenu } from "./ui/menu";
import type { Layout } from "../state/layout";
import type { ThemeChoice } from "../state/theme";
import { listedFormats } from "../state/mesh_formats";

const themes: readonly { readonly choice: ThemeChoice; readonly label: string }[] = [
  { choice: "system", label: "Theme of the system" },
  { choice: "dark", label: "Dark theme" },
  { choice: "light", label: "Light theme" },
];

/** A button with an icon, and its name where there is room. */
function NamedButton(props: {
  readonly icon: ComponentProps<typeof Icon>["name"];
  readonly name: string;
  readonly title: string;
  readonly pressed?: boolean;
  readonly onClick: (event: MouseEvent) => void;
}) {
  const { icon, name, title, pressed, onClick } = props;
  return (
    <button
      type="button"
      class="btn quiet"
      title={title}
      aria-label={name}
      aria-pressed={pressed}
      onClick={onClick}
    >
      <Icon name={icon} />
      <span class="wide-only">{name}</span>
    </button>
  );
}

/** Name of the database, state of the connection, and what concerns the whole page. */
export function TopBar() {
  const app = useApp();
  const { store, workspace } = app;
  const keeper = useKeeper();
  const bar = useRef<HTMLDivElement>(null);
  useRoving(bar);
  const { layout, mode, theme } = store;
  const compare = mode.value === "compare";
  return (
    <header class="top-bar">
      <svg class="logo" viewBox="0 0 32 32" aria-hidden="true">
        <path d="M16 2 28 9v14l-12 7L4 23V9z" />
        <path d="M16 16 28 9v14l-12 7z" />
        <path d="M16 16 4 9v14l12 7z" />
      </svg>
      <h1 class="wordmark">algebra3d</h1>
      <ServerState />
      <span class="grow" />
      <div ref={bar} class="top-tools" role="toolbar" aria-label="Page">
        <IconButton
          icon="undo"
          label="Undo (Ctrl+Z)"
          disabled={!keeper.canUndo.value}
          onClick={() => void keeper.undo()}
        />
        <IconButton
          icon="redo"
          label="Redo (Ctrl+Shift+Z)"
          disabled={!keeper.canRedo.value}
          onClick={() => void keeper.redo()}
        />
        <NamedButton
          icon="upload"
          name="Import"
          title={`Import ${listedFormats(store.catalogue.formats.value)} files`}
          onClick={(event) =>
            openMenu(event.currentTarget as HTMLElement, [
              { label: "Files…", run: () => workspace.chooseFiles() },
              { label: "A folder…", run: () => workspace.chooseFolder() },
            ])
          }
        />
        <NamedButton
          icon="split"
          name="Compare"
          title="Two meshes side by side"
          pressed={compare}
          onClick={() => (mode.value = compare ? "explore" : "compare")}
        />
        <NamedButton
          icon="link"
          name="Copy link"
          title="Link that restores this view"
          onClick={() => void copyLink(app)}
        />
        <span class="bar-gap wide-only" />
        <span class="wide-only">
          <IconButton
            icon="database"
            label="Objects and operators"
            pressed={layout.sideOpen.value && layout.sideTab.value !== "view"}
            onClick={() => toggleSide(layout, false)}
          />
          {!compare && (
            <IconButton
              icon="panelBottom"
              label="Results"
              pressed={layout.bottomOpen.value}
              onClick={() => (layout.bottomOpen.value = !layout.bottomOpen.value)}
            />
          )}
          <IconButton
            icon="panelRight"
            label="Settings of the view"
            pressed={layout.sideOpen.value && layout.sideTab.value === "view"}
            onClick={() => toggleSide(layout, true)}
          />
        </span>
        <IconButton
          icon={theme.current.value === "dark" ? "moon" : "sun"}
          label="Theme"
          onClick={(event) =>
            openMenu(
              event.currentTarget as HTMLElement,
              themes.map(({ choice, label }) => ({ label, run: () => void (theme.choice.value = choice) })),
            )
          }
        />
      </div>
    </header>
  );
}

/** Shows the lists or the settings beside the scene; if they are there, they go. */
function toggleSide(layout: Layout, wantsView: boolean): void {
  const isThere = layout.sideOpen.value && (layout.sideTab.value === "view") === wantsView;
  layout.sideOpen.value = !isThere;
  if (!isThere) layout.sideTab.value = wantsView ? "view" : "objects";
}

const stateTexts = {
  connecting: "Connecting",
  online: "Connected",
  gone: "No answer from the server",
  unauthorized: "A token is needed",
} as const;

function ServerState() {
  const { connection } = useApp().store;
  const info = connection.info.value;
  const status = connection.status.value;
  return (
    <span
      class="server-state ellipsis"
      title={info ? `${stateTexts[status]}, algebra3d ${info.version}` : stateTexts[status]}
    >
      <span class={`dot ${status}`} role="img" aria-label={stateTexts[status]} />
      <span class="ellipsis">{info?.database ?? ""}</span>
      {info?.readOnly && <span class="tag">read only</span>}
    </span>
  );
}
