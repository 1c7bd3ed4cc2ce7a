import { describePreset, kNavigationPresets } from "../scene";
import type { DisplayState, NavigationState, SceneView } from "../scene";
import { Check, Choice, NumberField, Section, Segments, Slider } from "./fields";
import { useSceneEvents, useSceneState } from "./hooks";

const kDisplays: readonly { readonly id: keyof DisplayState; readonly title: string }[] = [
  { id: "axes", title: "Axes" },
  { id: "grid", title: "Grid" },
  { id: "scaleBar", title: "Scale bar" },
  { id: "boxes", title: "Bounding boxes" },
  { id: "boundary", title: "Boundary edges (red)" },
  { id: "nonManifold", title: "Non-manifold edges (violet)" },
  { id: "legend", title: "Legend" },
];

export const kArrangements = [
  { id: "place", title: "In place" },
  { id: "grid", title: "Contact sheet" },
  { id: "exploded", title: "Exploded" },
] as const;

/** What is shown besides the objects, and how far they are moved apart. */
export function DisplayPanel({ view }: { view: SceneView }) {
  const { display } = useSceneState(view, "display");
  return (
    <Section title="Display" testId="display-panel" onReset={() => view.reset("display")}>
      {kDisplays.map(({ id, title }) => (
        <Check
          key={id}
          label={title}
          checked={display[id] === true}
          onChange={(on) => view.update({ display: { [id]: on } })}
        />
      ))}
      <ArrangementFields view={view} />
    </Section>
  );
}

/** Where objects are drawn, and in which order on a contact sheet. */
function ArrangementFields({ view }: { view: SceneView }) {
  const { display } = useSceneState(view, "display");
  useSceneEvents(view, "shapes");
  const set = (change: Partial<DisplayState>): void => view.update({ display: change });
  return (
    <>
      <Segments
        label="Objects"
        value={display.arrangement}
        options={kArrangements}
        onChange={(arrangement) => set({ arrangement })}
      />
      {display.arrangement === "exploded" && (
        <Slider
          label="Apart"
          value={display.explode}
          min={0}
          max={3}
          step={0.05}
          format={(value) => `${Math.round(value * 100)} %`}
          onChange={(explode) => set({ explode })}
        />
      )}
      {display.arrangement === "grid" && <SortFields view={view} />}
    </>
  );
}

/** The column by which a contact sheet is sorted. */
export function SortFields({ view }: { view: SceneView }) {
  const { display } = useSceneState(view, "display");
  useSceneEvents(view, "shapes");
  const set = (change: Partial<DisplayState>): void => view.update({ display: change });
  return (
    <div class="row">
      <Choice
        label="Sorted by"
        value={display.sortBy}
        options={[
          { id: "", title: "row" },
          ...view.attributes.map(({ name }) => ({ id: name, title: name })),
        ]}
        onChange={(sortBy) => set({ sortBy })}
      />
      <Check
        label="Largest first"
        checked={display.descending}
        onChange={(descending) => set({ descending })}
      />
    </div>
  );
}

/** Projection, scale, and what the mouse does. */
export function NavigationPanel({ view }: { view: SceneView }) {
  const { navigation, camera } = useSceneState(view, "navigation", "camera");
  const set = (change: Partial<NavigationState>): void => view.update({ navigation: change });
  const speed = (value: number): string => `${value.toFixed(1)}×`;
  // Pixels per coordinate unit at the target.
  const scale = view.element.clientHeight / camera.height;
  return (
    <Section
      title="Camera and mouse"
      open={false}
      testId="navigation-panel"
      onReset={() => view.reset("navigation")}
    >
      <Segments
        label="Projection"
        value={camera.projection}
        options={[
          { id: "perspective", title: "Perspective" },
          { id: "orthographic", title: "Orthographic" },
        ]}
        onChange={(projection) => view.update({ camera: { projection } })}
      />
      <NumberField
        label="Scale (pixels per unit)"
        value={scale}
        min={1e-30}
        onChange={(value) => view.update({ camera: { height: view.element.clientHeight / value } })}
      />
      <div class="row">
        <button type="button" class="btn small" onClick={() => view.fit()}>
          Auto-fit
        </button>
      </div>
      <Choice
        label="Mouse as in"
        value={navigation.preset}
        options={kNavigationPresets}
        onChange={(preset) => set({ preset })}
      />
      <dl class="facts">
        {describePreset(navigation.preset).map(([gesture, motion]) => (
          <>
            <dt>{gesture}</dt>
            <dd>{motion}</dd>
          </>
        ))}
      </dl>
      <Segments
        label="Orbit"
        value={navigation.orbit}
        options={[
          { id: "turntable", title: "Turntable" },
          { id: "trackball", title: "Trackball" },
        ]}
        onChange={(orbit) => set({ orbit })}
      />
      <Check
        label="Zoom towards the pointer"
        checked={navigation.zoomToPointer}
        onChange={(zoomToPointer) => set({ zoomToPointer })}
      />
      <Check
        label="Wheel the other way round"
        checked={navigation.invertWheel}
        onChange={(invertWheel) => set({ invertWheel })}
      />
      {(["rotationSpeed", "panSpeed", "zoomSpeed"] as const).map((name) => (
        <Slider
          key={name}
          label={`${{ rotationSpeed: "Rotation", panSpeed: "Translation", zoomSpeed: "Zoom" }[name]} speed`}
          value={navigation[name]}
          min={0.1}
          max={5}
          step={0.1}
          format={speed}
          onChange={(value) => set({ [name]: value })}
        />
      ))}
    </Section>
  );
}
