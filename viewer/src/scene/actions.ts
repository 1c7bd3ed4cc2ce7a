/** What the actions of shortcuts.ts do; the group "Application" is handed on as events. */

import type { Appearance, ColorScheme, DisplayState, FocusState, SceneView, StandardView, Tool } from "./api";
import { orbit, pan, zoom } from "./camera";
import type { View } from "./scene_view";
import { kShortcuts } from "./shortcuts";
import { facingEye } from "./section";
import { kDefaultState } from "./state";
import { normalized } from "./vec";

type Action = (view: View) => void;

const look =
  (side: StandardView): Action =>
  (view) =>
    view.look(side);
const turn =
  (axis: "roll" | "up" | "side", degrees: number): Action =>
  (view) =>
    view.turn(axis, degrees);
const orbitBy =
  (sideways: number, upwards: number): Action =>
  (view) =>
    view.update({ camera: orbit(view.state.camera, sideways, upwards, view.state.navigation.orbit) });
const panBy =
  (right: number, up: number): Action =>
  (view) =>
    view.update({ camera: pan(view.state.camera, right, up) });
const zoomBy =
  (factor: number): Action =>
  (view) =>
    view.update({ camera: zoom(view.state.camera, factor) });
const toggle =
  (name: "axes" | "grid" | "boxes" | "scaleBar" | "legend" | "boundary" | "nonManifold"): Action =>
  (view) =>
    view.update({ display: { [name]: !view.state.display[name] } });

const kTurn = Math.PI / 24;

const kActions: Readonly<Record<string, Action>> = {
  "view.front": look("front"),
  "view.back": look("back"),
  "view.left": look("left"),
  "view.right": look("right"),
  "view.top": look("top"),
  "view.bottom": look("bottom"),
  "view.isometric": look("isometric"),
  "turn.up": turn("side", -90),
  "turn.down": turn("side", 90),
  "roll.left": turn("roll", -90),
  "roll.right": turn("roll", 90),
  projection: (view) => {
    const { camera } = view.state;
    const projection = camera.projection === "perspective" ? "orthographic" : "perspective";
    view.update({ camera: { projection } });
  },
  home: (view) => view.home(),
  back: (view) => view.back(),
  fit: (view) => view.fit(),
  "fit.selection": (view) => view.fit(view.selection),
  "orbit.left": orbitBy(-kTurn, 0),
  "orbit.right": orbitBy(kTurn, 0),
  "orbit.up": orbitBy(0, -kTurn),
  "orbit.down": orbitBy(0, kTurn),
  "pan.left": panBy(-0.08, 0),
  "pan.right": panBy(0.08, 0),
  "pan.up": panBy(0, 0.08),
  "pan.down": panBy(0, -0.08),
  "zoom.in": zoomBy(1 / 1.2),
  "zoom.out": zoomBy(1.2),
  trackball: (view) => {
    const orbitStyle = view.state.navigation.orbit === "turntable" ? "trackball" : "turntable";
    view.update({ navigation: { orbit: orbitStyle } });
  },

  edges: (view) => view.update({ appearance: { edges: nextOf(kEdgeModes, view.state.appearance.edges) } }),
  faces: (view) => {
    const faces = !view.state.appearance.faces;
    const { edges: before } = view.state.appearance;
    const edges = !faces && before === "none" ? "features" : before;
    view.update({ appearance: { faces, edges } });
  },
  vertices: (view) => view.update({ appearance: { vertices: !view.state.appearance.vertices } }),
  shading: (view) =>
    view.update({ appearance: { shading: nextOf(kShadings, view.state.appearance.shading) } }),
  axes: toggle("axes"),
  grid: toggle("grid"),
  boxes: toggle("boxes"),
  scale: toggle("scaleBar"),
  legend: toggle("legend"),
  boundary: toggle("boundary"),
  nonmanifold: toggle("nonManifold"),
  coloring: (view) => view.update({ appearance: { scheme: nextScheme(view) } }),
  "opacity.more": (view) => changeOpacity(view, 0.1),
  "opacity.less": (view) => changeOpacity(view, -0.1),
  "light.more": (view) => changeLight(view, 1.15),
  "light.less": (view) => changeLight(view, 1 / 1.15),
  explode: (view) => toggleArrangement(view, "exploded"),
  sheet: (view) => toggleArrangement(view, "grid"),

  hide: (view) => {
    view.update({ focus: { hidden: [...view.state.focus.hidden, ...view.selection] } });
    view.select([]);
  },
  isolate: (view) => focusOn(view, "hidden"),
  ghost: (view) => focusOn(view, "ghosted"),
  "show.all": (view) => {
    view.update({ focus: kDefaultState.focus });
    for (const { source } of view.stage.store.columns) view.setVisible(source, true);
  },
  "select.none": (view) => {
    view.update({ tools: { tool: "select", picks: [] } });
    view.select([]);
  },
  "select.next": (view) => selectBeside(view, 1),
  "select.previous": (view) => selectBeside(view, -1),

  section: (view) => {
    const on = !view.state.section.on;
    const box = view.stage.contentBox;
    const { point, normal } = view.state.section;
    const middle = box.isEmpty() ? point : box.getCenter(box.min.clone()).toArray();
    const towards = facingEye(normal, view.state.camera.direction);
    view.update({ section: on ? { on, point: middle, normal: towards, cap: "preview" } : { on } });
    if (on) view.sectionRests();
  },
  "section.forward": (view) => moveSection(view, 0.02),
  "section.back": (view) => moveSection(view, -0.02),
  measure: (view) => toggleTool(view, "measure"),
  inspect: (view) => toggleTool(view, "inspect"),
};

const kShadings: readonly Appearance["shading"][] = ["smooth", "flat", "unlit"];
const kEdgeModes: readonly Appearance["edges"][] = ["none", "features", "all"];

function nextOf<T>(values: readonly T[], value: T): T {
  return values[(values.indexOf(value) + 1) % values.length]!;
}

/** Whether any object may have colours of its elements. */
export function hasMeshes(view: Pick<SceneView, "shapes">): boolean {
  return view.shapes().some(({ kind, visible }) => visible && kind === "mesh3d");
}

/** One colour, by position, those of the file, gradient, then each attribute. */
function nextScheme(view: View): ColorScheme {
  const schemes: ColorScheme[] = [
    { by: "one" },
    { by: "position" },
    ...(hasMeshes(view) ? [{ by: "elements" } as const] : []),
    { by: "gradient", from: "#2b6cb0", to: "#f2b134" },
    ...view.attributes.map(({ name }) => ({ by: "attribute", attribute: name, palette: "viridis" }) as const),
  ];
  const now = view.state.appearance.scheme;
  const index = schemes.findIndex(
    (scheme) =>
      scheme.by === now.by &&
      (scheme.by !== "attribute" || (now.by === "attribute" && now.attribute === scheme.attribute)),
  );
  return schemes[(index + 1) % schemes.length]!;
}

function changeOpacity(view: View, by: number): void {
  const opacity = Math.round(Math.min(1, Math.max(0, view.state.appearance.opacity + by)) * 10) / 10;
  view.update({ appearance: { opacity } });
}

function changeLight(view: View, factor: number): void {
  const { global } = view.state.lights;
  const brightness = Math.min(10, Math.max(0.05, global.brightness * factor));
  view.update({ lights: { global: { ...global, brightness } } });
}

function toggleArrangement(view: View, arrangement: DisplayState["arrangement"]): void {
  const isThere = view.state.display.arrangement === arrangement;
  view.update({ display: { arrangement: isThere ? "place" : arrangement } });
}

function toggleTool(view: View, tool: Tool): void {
  view.update({ tools: { tool: view.state.tools.tool === tool ? "select" : tool, picks: [] } });
}

/** The others than the selected objects are ghosted or hidden; asked for again, they are as before. */
function focusOn(view: View, others: FocusState["others"]): void {
  const { focus } = view.state;
  const cells = view.selection;
  const again = focus.others === others && JSON.stringify(focus.cells) === JSON.stringify(cells);
  view.update({ focus: { cells: again ? [] : cells, others } });
}

function selectBeside(view: View, step: number): void {
  const records = [...view.stage.store.visibleRecords()];
  if (records.length === 0) return;
  const last = view.selection.at(-1);
  const current = last ? records.findIndex((record) => record === view.stage.store.record(last)) : -1;
  const index = current < 0 ? (step > 0 ? 0 : records.length - 1) : current + step;
  view.select([records[(index + records.length) % records.length]!.cell]);
}

function moveSection(view: View, part: number): void {
  const { section } = view.state;
  if (!section.on) return;
  const box = view.stage.contentBox;
  const step = box.isEmpty() ? part : box.max.distanceTo(box.min) * part;
  const normal = normalized(section.normal);
  const point = [0, 1, 2].map((axis) => section.point[axis]! + normal[axis]! * step) as [
    number,
    number,
    number,
  ];
  view.update({ section: { point, cap: "preview" } });
  view.sectionRests();
}

/** Returns whether there is an action of this name. */
export function performAction(view: View, action: string): boolean {
  const perform = Object.hasOwn(kActions, action) ? kActions[action] : undefined;
  if (perform) {
    perform(view);
    return true;
  }
  if (!kShortcuts.some((shortcut) => shortcut.action === action)) return false;
  view.emitter.emit("action", action);
  return true;
}
