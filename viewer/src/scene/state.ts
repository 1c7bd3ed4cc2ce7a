/** The state of a view: what a new view has, changes of it, and its way to and from JSON. */

import type { CameraState, SceneState, ScenePatch } from "./api";

export const kDefaultCamera: CameraState = {
  projection: "perspective",
  target: [0, 0, 0],
  rest: [0, 0, 0],
  direction: [1, -1, 1],
  up: [0, 0, 1],
  height: 10,
};

export const kDefaultState: SceneState = {
  camera: kDefaultCamera,
  navigation: {
    preset: "default",
    rotationSpeed: 1,
    panSpeed: 1,
    zoomSpeed: 1,
    invertWheel: false,
    zoomToPointer: true,
    orbit: "turntable",
  },
  appearance: {
    faces: true,
    vertices: false,
    edges: "features",
    shading: "smooth",
    opacity: 1,
    color: "#8fa9c9",
    edgeColor: null,
    pointSize: 5,
    scheme: { by: "one" },
    background: null,
  },
  overrides: [],
  lights: {
    global: { on: true, color: "#ffffff", brightness: 1 },
    lights: [],
    selected: null,
    markers: false,
  },
  section: {
    on: false,
    point: [0, 0, 0],
    normal: [1, 0, 0],
    cap: "preview",
    capColor: "#e0793a",
    plane: true,
  },
  display: {
    axes: true,
    grid: false,
    scaleBar: true,
    boxes: false,
    boundary: true,
    nonManifold: true,
    legend: true,
    arrangement: "place",
    explode: 0.6,
    sortBy: "",
    descending: false,
  },
  index: { name: "", level: 0 },
  tools: {
    tool: "select",
    snapVertices: true,
    snapEdges: true,
    kind: "distance",
    picks: [],
    measures: [],
    inspected: null,
    drag: null,
  },
  focus: { hidden: [], cells: [], others: "hidden" },
};

type Part = keyof SceneState;

/** The state with the changes of a patch, and the parts that it changed. */
export function patched(state: SceneState, patch: ScenePatch): { state: SceneState; parts: Part[] } {
  const next: Record<string, unknown> = { ...state };
  const parts: Part[] = [];
  for (const part of Object.keys(patch) as Part[]) {
    const change = patch[part];
    if (change === undefined) continue;
    const value = part === "overrides" ? change : { ...(state[part] as object), ...(change as object) };
    if (JSON.stringify(value) === JSON.stringify(state[part])) continue;
    next[part] = value;
    parts.push(part);
  }
  return { state: next as unknown as SceneState, parts };
}

const kMomentary: ReadonlySet<string> = new Set(["markers", "selected", "picks", "drag"]);

/** Parts that are written by their fields that differ from those of a new view. */
const kWritten = [
  "navigation",
  "appearance",
  "lights",
  "section",
  "display",
  "index",
  "tools",
  "focus",
] as const;

/** What differs from a new view; lights' markers and other things of the moment are left out. */
export function stateToJson(state: SceneState): Record<string, unknown> {
  const json: Record<string, unknown> = { camera: state.camera };
  for (const part of kWritten) {
    const changes = Object.entries(state[part]).filter(
      ([key, value]) =>
        !kMomentary.has(key) &&
        JSON.stringify(value) !== JSON.stringify(Reflect.get(kDefaultState[part], key)),
    );
    if (changes.length > 0) json[part] = Object.fromEntries(changes);
  }
  if (state.overrides.length > 0) json["overrides"] = state.overrides;
  return json;
}
