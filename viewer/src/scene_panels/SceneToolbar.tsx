import type { RefObject } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";

import { kShortcuts } from "../scene";
import type { SceneView } from "../scene";
import { useSceneEvents } from "./hooks";
import { SceneIcon } from "./icons";
import type { SceneIconName } from "./icons";
import { useRoving } from "./roving";
import { kArrangements } from "./ViewPanel";

/** The most frequent actions, with their shortcuts as tooltips. */
export function SceneToolbar({ view }: { view: SceneView }) {
  useSceneEvents(view, "state");
  const { camera, section, display, appearance, tools } = view.state;
  const orthographic = camera.projection === "orthographic";
  const bar = useRef<HTMLDivElement>(null);
  const more = useMoreBeside(bar);
  useRoving(bar);
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
        <Tool view={view} action="home" word="Home" icon="home" />
        <Tool view={view} action="back" word="Back" icon="back" />
        <Tool view={view} action="fit" word="Fit" icon="fit" />
        <Tool view={view} action="view.isometric" word="Iso" icon="isometric" />
        <Tool view={view} action="view.front" word="Front" icon="front" />
        <Tool view={view} action="view.right" word="Right" icon="right" />
        <Tool view={view} action="view.top" word="Top" icon="top" />
        <Tool
          view={view}
          action="projection"
          word={orthographic ? "Parallel" : "Persp."}
          icon={orthographic ? "orthographic" : "perspective"}
        />
        <Tool view={view} action="edges" word="Edges" icon="edges" pressed={appearance.edges !== "none"} />
        <Tool view={view} action="grid" word="Grid" icon="grid" pressed={display.grid} />
        <Arrangement view={view} />
        <Tool view={view} action="section" word="Section" icon="section" pressed={section.on} />
        <Tool view={view} action="measure" word="Measure" icon="measure" pressed={tools.tool === "measure"} />
        <Tool view={view} action="inspect" word="Inspect" icon="inspect" pressed={tools.tool === "inspect"} />
        <Tool view={view} action="screenshot" word="Picture" icon="camera" />
        <Tool view={view} action="shortcuts" word="Keys" icon="keys" />
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

/** In place, as a contact sheet, or apart. */
function Arrangement({ view }: { view: SceneView }) {
  const { arrangement } = view.state.display;
  return (
    <div class="btn-group" role="group" aria-label="Where objects stand">
      {kArrangements.map(({ id, title }) => (
        <button
          key={id}
          type="button"
          class="btn small"
          aria-pressed={id === arrangement}
          onClick={() => view.update({ display: { arrangement: id } })}
        >
          {title}
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

/** The name of a button has the word that is seen on it. */
function hasWord(title: string, word: string): boolean {
  return title.toLowerCase().split(/\W+/).includes(word.toLowerCase());
}

interface ToolProps {
  readonly view: SceneView;
  readonly action: string;
  /** Below the icon. */
  readonly word: string;
  readonly icon: SceneIconName;
  readonly pressed?: boolean;
}

function Tool({ view, action, word, icon, pressed }: ToolProps) {
  const shortcut = kShortcuts.find((known) => known.action === action);
  const title = shortcut?.title ?? action;
  return (
    <button
      type="button"
      class="btn quiet tool"
      title={`${title} (${shortcut?.keys.split(" ")[0] ?? ""})`}
      aria-label={hasWord(title, word) ? title : `${word}: ${title}`}
      aria-pressed={pressed}
      onClick={() => view.act(action)}
    >
      <SceneIcon name={icon} />
      <span aria-hidden="true">{word}</span>
    </button>
  );
}
