import { hasMeshes, kDefaultState, kPaletteNames } from "../scene";
import type { Appearance, ColorScheme, PaletteName, SceneView } from "../scene";
import { Check, Choice, ColorField, Section, Segments, Slider } from "./fields";
import { useSceneEvents, useSceneState } from "./hooks";

const kStandard = kDefaultState.appearance;
/** What the field shows while the edges have the colour that is seen best. */
const kEdgeColor = "#0f151c";
const percent = (value: number): string => `${Math.round(value * 100)} %`;

/** Faces, edges, points and colours of all objects. */
export function AppearancePanel({ view }: { view: SceneView }) {
  const { appearance } = useSceneState(view, "appearance");
  useSceneEvents(view, "shapes");
  const set = (change: Partial<Appearance>): void => view.update({ appearance: change });
  const resetOf = (name: "color" | "edgeColor" | "background"): (() => void) | undefined =>
    appearance[name] === kStandard[name] ? undefined : () => set({ [name]: kStandard[name] });
  return (
    <Section title="Appearance" testId="appearance-panel" onReset={() => view.reset("appearance")}>
      <Check label="Faces" checked={appearance.faces} onChange={(faces) => set({ faces })} />
      <Check label="Vertices" checked={appearance.vertices} onChange={(vertices) => set({ vertices })} />
      <Segments
        label="Edges"
        value={appearance.edges}
        options={[
          { id: "none", title: "None" },
          { id: "features", title: "Shape" },
          { id: "all", title: "All" },
        ]}
        onChange={(edges) => set({ edges })}
      />
      <Segments
        label="Shading"
        value={appearance.shading}
        options={[
          { id: "smooth", title: "Smooth" },
          { id: "flat", title: "Flat" },
          { id: "unlit", title: "No light" },
        ]}
        onChange={(shading) => set({ shading })}
      />
      <Slider
        label="Opacity"
        value={appearance.opacity}
        min={0}
        max={1}
        step={0.05}
        format={percent}
        onChange={(opacity) => set({ opacity })}
      />
      <Slider
        label="Point size"
        value={appearance.pointSize}
        min={1}
        max={30}
        step={1}
        format={(value) => `${value} px`}
        onChange={(pointSize) => set({ pointSize })}
      />
      <SchemeFields view={view} scheme={appearance.scheme} />
      {appearance.scheme.by === "one" && (
        <ColorField
          label="Object colour"
          value={appearance.color}
          onChange={(color) => set({ color })}
          onReset={resetOf("color")}
        />
      )}
      <ColorField
        label="Edge colour"
        value={appearance.edgeColor ?? kEdgeColor}
        onChange={(edgeColor) => set({ edgeColor })}
        onReset={resetOf("edgeColor")}
      />
      <ColorField
        label="Background colour"
        value={appearance.background ?? backgroundOf(view)}
        onChange={(background) => set({ background })}
        onReset={resetOf("background")}
      />
    </Section>
  );
}

/** The colour of the theme as the field of colours wants it. */
function backgroundOf(view: SceneView): string {
  const text = getComputedStyle(view.element).getPropertyValue("--ground").trim();
  return /^#[0-9a-f]{6}$/i.test(text) ? text : "#ffffff";
}

const kGradient = { by: "gradient", from: "#2b6cb0", to: "#f2b134" } as const;

function SchemeFields({ view, scheme }: { view: SceneView; scheme: ColorScheme }) {
  const set = (next: ColorScheme): void => view.update({ appearance: { scheme: next } });
  const attributes = view.attributes;
  const first = attributes[0];
  const choose = (by: ColorScheme["by"]): void => {
    if (by === "one" || by === "position" || by === "elements") set({ by });
    else if (by === "gradient") set(kGradient);
    else if (first) set({ by, attribute: first.name, palette: "viridis" });
  };
  return (
    <>
      <Choice
        label="Colouring"
        value={scheme.by}
        options={[
          { id: "one", title: "One colour" },
          { id: "position", title: "By position" },
          ...(hasMeshes(view) || scheme.by === "elements"
            ? [{ id: "elements", title: "As in the file" } as const]
            : []),
          { id: "gradient", title: "Gradient over the rows" },
          ...(first ? [{ id: "attribute", title: "By an attribute" } as const] : []),
        ]}
        onChange={choose}
      />
      {scheme.by === "gradient" && (
        <>
          <ColorField label="First row" value={scheme.from} onChange={(from) => set({ ...scheme, from })} />
          <ColorField label="Last row" value={scheme.to} onChange={(to) => set({ ...scheme, to })} />
        </>
      )}
      {scheme.by === "attribute" && (
        <>
          <Choice
            label="Attribute"
            value={scheme.attribute}
            options={attributes.map(({ name, type }) => ({ id: name, title: `${name} (${type})` }))}
            onChange={(attribute) => set({ ...scheme, attribute })}
          />
          <Choice<PaletteName>
            label="Palette"
            value={scheme.palette}
            options={kPaletteNames.map((id) => ({ id, title: id }))}
            onChange={(palette) => set({ ...scheme, palette })}
          />
        </>
      )}
    </>
  );
}
