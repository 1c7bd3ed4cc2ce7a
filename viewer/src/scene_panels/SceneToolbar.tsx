import { kShortcuts } from "../scene";
import type { SceneView } from "../scene";
import { useSceneEvents } from "./hooks";
import { SceneIcon } from "./icons";
import type { SceneIconName } from "./icons";

/** The most frequent actions, with their shortcuts as tooltips. */
export function SceneToolbar({ view }: { view: SceneView }) {
  useSceneEvents(view, "state", "tool");
  const { camera, section, display, appearance } = view.state;
  const orthographic = camera.projection === "orthographic";
  return (
    <div class="scene-tools" role="toolbar" aria-label="View">
      <Tool view={view} action="home" icon="home" />
      <Tool view={view} action="fit" icon="fit" />
      <Tool view={view} action="view.isometric" icon="isometric" />
      <Tool view={view} action="view.front" icon="front" />
      <Tool view={view} action="view.right" icon="right" />
      <Tool view={view} action="view.top" icon="top" />
      <Tool view={view} action="projection" icon={orthographic ? "orthographic" : "perspective"} />
      <Tool view={view} action="edges" icon="edges" pressed={appearance.edges !== "none"} />
      <Tool view={view} action="grid" icon="grid" pressed={display.grid} />
      <Tool view={view} action="section" icon="section" pressed={section.on} />
      <Tool view={view} action="measure" icon="measure" pressed={view.tool === "measure"} />
      <Tool view={view} action="inspect" icon="inspect" pressed={view.tool === "inspect"} />
      <Tool view={view} action="screenshot" icon="camera" />
      <Tool view={view} action="shortcuts" icon="keys" />
    </div>
  );
}

interface ToolProps {
  readonly view: SceneView;
  readonly action: string;
  readonly icon: SceneIconName;
  readonly pressed?: boolean;
}

function Tool({ view, action, icon, pressed }: ToolProps) {
  const shortcut = kShortcuts.find((known) => known.action === action);
  const title = shortcut?.title ?? action;
  return (
    <button
      type="button"
      class="btn quiet icon"
      title={`${title} (${shortcut?.keys.split(" ")[0] ?? ""})`}
      aria-label={title}
      aria-pressed={pressed}
      onClick={() => view.act(action)}
    >
      <SceneIcon name={icon} />
    </button>
  );
}
