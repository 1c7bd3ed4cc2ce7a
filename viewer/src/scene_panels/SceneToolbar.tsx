import type { RefObject } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";

import { kShortcuts } from "../scene";
import type { SceneView } from "../scene";
import { useSceneEvents } from "./hooks";
import { SceneIcon } from "./icons";
import type { SceneIconName } from "./icons";

/** The most frequent actions, with their shortcuts as tooltips. */
export function SceneToolbar({ view }: { view: SceneView }) {
  useSceneEvents(view, "state");
  const { camera, section, display, appearance, tools } = view.state;
  const orthographic = camera.projection === "orthographic";
  const bar = useRef<HTMLDivElement>(null);
  const more = useMoreBeside(bar);
  return (
    <div class="tools-place">
      <div
        ref={bar}
        class="scene-tools"
        role="toolbar"
        aria-label="View"
        data-more={more.join(" ")}
        data-testid="scene-tools"
      >
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
        <Tool view={view} action="measure" icon="measure" pressed={tools.tool === "measure"} />
        <Tool view={view} action="inspect" icon="inspect" pressed={tools.tool === "inspect"} />
        <Tool view={view} action="screenshot" icon="camera" />
        <Tool view={view} action="shortcuts" icon="keys" />
      </div>
      {more.map((side) => (
        <button
          key={side}
          type="button"
          class={`btn icon tools-arrow ${side}`}
          tabIndex={-1}
          aria-hidden="true"
          title="More tools"
          onClick={() => bar.current?.scrollBy({ left: side === "left" ? -160 : 160, behavior: "smooth" })}
        >
          {side === "left" ? "‹" : "›"}
        </button>
      ))}
    </div>
  );
}

type Edge = "left" | "right";

/** At which ends of an element that scrolls sideways something is out of sight. */
function useMoreBeside(bar: RefObject<HTMLElement | null>): readonly Edge[] {
  const [edges, setEdges] = useState<readonly Edge[]>([]);
  useEffect(() => {
    const element = bar.current;
    if (!element) return;
    const look = (): void => {
      const hidden = element.scrollWidth - element.clientWidth - element.scrollLeft;
      const found: Edge[] = [];
      if (element.scrollLeft > 2) found.push("left");
      if (hidden > 2) found.push("right");
      setEdges((before) => (before.join() === found.join() ? before : found));
    };
    const observer = new ResizeObserver(look);
    observer.observe(element);
    element.addEventListener("scroll", look);
    look();
    return () => {
      observer.disconnect();
      element.removeEventListener("scroll", look);
    };
  }, []);
  return edges;
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
