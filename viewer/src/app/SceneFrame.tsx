import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type { ComponentChildren } from "preact";
import { effect, untracked, type ReadonlySignal } from "@preact/signals";
import { createSceneView, hasMeshes } from "../scene";
import type { SceneView } from "../scene/api";
import {
  SceneModel,
  SceneOverlay,
  SceneReader,
  SceneToolbar,
  SectionReadout,
  ToolReadout,
} from "../scene_panels";
import { useApp } from "./context";
import { panelDatabase } from "./panel_database";
import { SceneHint, SceneMessages } from "./SceneMessages";

interface Props {
  /** The accessible name of the canvas. */
  readonly label: string;
  readonly testId?: string;
  /** Something is on its way that the view does not know of yet. */
  readonly busy?: boolean;
  /** What to do while nothing is shown; null if something is. */
  readonly hint: string | null;
  /** Keeps the view in step with what it shows; returns what ends this. */
  readonly bind: (view: SceneView) => () => void;
  /** Called with the scene when it is there, and with null when it goes. */
  readonly onModel: (model: SceneModel | null) => void;
  /** Whether a failure of this result is told; those of what is no longer wanted are not. */
  readonly told?: (result: string) => boolean;
  readonly onFocus?: () => void;
  readonly children?: ComponentChildren;
}

/** Draws meshes in the colours of materials as soon as these are told. */
function followMaterials(view: SceneView, materials: ReadonlySignal<unknown>): () => void {
  let isFirst = true;
  return effect(() => {
    void materials.value;
    untracked(() => {
      if (!isFirst && hasMeshes(view)) view.update({ appearance: { scheme: { by: "elements" } } });
      if (!isFirst) view.elementColorsChanged();
      isFirst = false;
    });
  });
}

/** A scene with its bar, its readouts and messages: the same for the results and for each side of the split screen. */
export function SceneFrame({ label, testId, busy, hint, bind, onModel, told, onFocus, children }: Props) {
  const app = useApp();
  const place = useRef<HTMLDivElement>(null);
  const database = useMemo(() => panelDatabase(app), [app]);
  const [model, setModel] = useState<SceneModel | null>(null);
  useEffect(() => {
    if (!place.current) return;
    const view = createSceneView(place.current);
    const made = new SceneModel(view, database);
    const end = bind(view);
    const endMaterials = followMaterials(view, app.store.materials);
    setModel(made);
    onModel(made);
    return () => {
      onModel(null);
      end();
      endMaterials();
      made.dispose();
      view.dispose();
    };
  }, []);
  const { openSettings } = app.workspace;
  return (
    <div class="scene-frame">
      <div class="tools-strip">{model && <SceneToolbar view={model.view} />}</div>
      <div class="scene">
        <div
          ref={place}
          class="scene-canvas"
          tabIndex={0}
          role="application"
          aria-busy={busy}
          aria-label={`${label}; ? lists its keys`}
          data-testid={testId}
          onPointerDown={(event) => event.currentTarget.focus({ preventScroll: true })}
          onFocus={onFocus}
        />
        {model && (
          <>
            <div class="scene-top">
              <SectionReadout model={model} onSettings={() => openSettings("section")} />
              <ToolReadout model={model} onSettings={openSettings} />
            </div>
            <SceneOverlay view={model.view} />
            <SceneReader view={model.view} />
            <SceneMessages view={model.view} told={told} />
            {hint !== null && <SceneHint view={model.view} text={hint} />}
          </>
        )}
        {children}
      </div>
    </div>
  );
}
