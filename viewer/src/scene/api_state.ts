/** The state of a scene view: plain data that can be written to JSON. A part of api.ts. */

export type Vec3 = readonly [number, number, number];

/** Minimum and maximum of x, y and z, as the API writes boxes. */
export type Box = readonly [number, number, number, number, number, number];

/** `#rrggbb`. */
export type Color = string;

/** One cell of a result; rows count from 0. */
export interface CellRef {
  readonly result: string;
  readonly row: number;
  readonly column: string;
}

export type Projection = "perspective" | "orthographic";
export type StandardView = "front" | "back" | "left" | "right" | "top" | "bottom" | "isometric";

export interface CameraState {
  readonly projection: Projection;
  /** The place that is looked at: this point and, where doubles cannot hold it far from the origin, the rest. */
  readonly target: Vec3;
  readonly rest: Vec3;
  /** Unit vector from the target to the eye. */
  readonly direction: Vec3;
  readonly up: Vec3;
  /** Height of what is seen at the target, in coordinate units; both projections keep it. */
  readonly height: number;
}

export type NavigationPreset =
  | "default"
  | "blender"
  | "freecad"
  | "solidworks"
  | "fusion"
  | "onshape"
  | "inventor"
  | "catia"
  | "rhino"
  | "maya"
  | "f3d"
  | "touchpad";

export interface NavigationState {
  readonly preset: NavigationPreset;
  /** Factors; 1 is normal. */
  readonly rotationSpeed: number;
  readonly panSpeed: number;
  readonly zoomSpeed: number;
  readonly invertWheel: boolean;
  /** Zoom towards the point under the pointer. */
  readonly zoomToPointer: boolean;
  /** `turntable` keeps z upright, `trackball` turns freely. */
  readonly orbit: "turntable" | "trackball";
}

/** How the colour of an object is found; an override of the object comes first. */
export type ColorScheme =
  | { readonly by: "one" }
  /** Red, green and blue for x, y and z, over the box of all that is seen; objects have no other colours then. */
  | { readonly by: "position" }
  /** Those that meshes bring along: of their vertices, faces or materials. */
  | { readonly by: "elements" }
  | { readonly by: "gradient"; readonly from: Color; readonly to: Color }
  | { readonly by: "attribute"; readonly attribute: string; readonly palette: PaletteName };

export type PaletteName = "viridis" | "cividis" | "magma" | "coolwarm" | "greys";

export interface Appearance {
  readonly faces: boolean;
  /** Of faces. */
  readonly vertices: boolean;
  readonly edges: "none" | "features" | "all";
  /** `unlit`: in their plain colours, without light. */
  readonly shading: "smooth" | "flat" | "unlit";
  /** 0 invisible to 1 solid. */
  readonly opacity: number;
  readonly color: Color;
  /** null: one that is seen well on faces, or without them on the background. */
  readonly edgeColor: Color | null;
  /** Diameter of points and vertices in pixels. */
  readonly pointSize: number;
  readonly scheme: ColorScheme;
  /** null: the colour of the page's theme. */
  readonly background: Color | null;
}

/** What differs for one object. */
export interface ObjectOverride {
  readonly cell: CellRef;
  readonly color?: Color;
  readonly pointSize?: number;
  readonly opacity?: number;
}

export interface GlobalLight {
  readonly on: boolean;
  readonly color: Color;
  /** 1 is normal. */
  readonly brightness: number;
}

export interface PointLightState extends GlobalLight {
  readonly id: number;
  readonly position: Vec3;
  /** Beyond it the light has no effect; in coordinate units. */
  readonly reach: number;
}

export interface LightsState {
  readonly global: GlobalLight;
  readonly lights: readonly PointLightState[];
  readonly selected: number | null;
  /** Markers are drawn while the panel of lights is open. */
  readonly markers: boolean;
}

export interface SectionState {
  readonly on: boolean;
  readonly point: Vec3;
  /** Unit vector; what lies on its side is cut away. */
  readonly normal: Vec3;
  /** `preview`: cut filled by the graphics card; `exact`: the surfaces given to setCaps. */
  readonly cap: "preview" | "exact";
  readonly capColor: Color;
  /** Outline of the plane and its handle. */
  readonly plane: boolean;
}

export interface DisplayState {
  readonly axes: boolean;
  readonly grid: boolean;
  readonly scaleBar: boolean;
  readonly boxes: boolean;
  readonly boundary: boolean;
  readonly nonManifold: boolean;
  readonly legend: boolean;
  /** Where objects are drawn: in their places, as a contact sheet, or moved apart. */
  readonly arrangement: "place" | "grid" | "exploded";
  /** How far they are moved apart: 1 by their distance from the common centre. */
  readonly explode: number;
  /** The attribute by whose values the contact sheet is sorted; "" for the order of the rows. */
  readonly sortBy: string;
  readonly descending: boolean;
}

/** The R-tree of the database whose boxes the panel of indexes draws. */
export interface IndexBoxesState {
  /** "" for none. */
  readonly name: string;
  /** From the root, 0, to the leaves. */
  readonly level: number;
}

/** The place under the pointer. */
export interface Hit {
  readonly cell: CellRef;
  readonly point: Vec3;
  /** What the point was snapped to. */
  readonly snap: "vertex" | "edge" | "face" | "point";
  /** Numbers in the value, as by faces(v) and vertices(v); null where the level of detail does not know them. */
  readonly face: number | null;
  readonly vertex: number | null;
  /** The corners of the triangle, or null; `ids` are their numbers in the value. */
  readonly triangle: {
    readonly corners: readonly [Vec3, Vec3, Vec3];
    readonly ids: readonly [number | null, number | null, number | null];
    readonly normal: Vec3;
    readonly area: number;
  } | null;
  /** The ends of the edge to which the point was snapped. */
  readonly edge: readonly [Vec3, Vec3] | null;
  /** The drawn level of detail is a coarser one, so that the point lies up to this far from the value. */
  readonly deviation: number;
}

export type Tool = "select" | "measure" | "inspect" | "drag";

export type TransformMode = "translate" | "rotate" | "scale";

export type MeasureKind = "distance" | "objects" | "angle" | "faceAngle" | "faceArea" | "area" | "volume";

/** A measure between places; its value is asked of the database. */
export interface MeasureState {
  readonly id: number;
  readonly kind: MeasureKind;
  /** As many as the kind needs. */
  readonly hits: readonly Hit[];
}

/** What is dragged while the tool is `drag`: vertices of an object, or the whole object by a handle. */
export interface DragState {
  readonly cell: CellRef;
  readonly how: "normal" | "plane" | TransformMode;
}

export interface ToolsState {
  readonly tool: Tool;
  readonly snapVertices: boolean;
  readonly snapEdges: boolean;
  /** What the next clicks measure. */
  readonly kind: MeasureKind;
  /** Clicked for it so far. */
  readonly picks: readonly Hit[];
  readonly measures: readonly MeasureState[];
  readonly inspected: Hit | null;
  readonly drag: DragState | null;
}

/** Which objects are seen of the columns that are shown. */
export interface FocusState {
  readonly hidden: readonly CellRef[];
  /** Unless it is empty, all other objects are ghosted or hidden. */
  readonly cells: readonly CellRef[];
  readonly others: "ghosted" | "hidden";
}

export interface SceneState {
  readonly camera: CameraState;
  readonly navigation: NavigationState;
  readonly appearance: Appearance;
  readonly overrides: readonly ObjectOverride[];
  readonly lights: LightsState;
  readonly section: SectionState;
  readonly display: DisplayState;
  readonly index: IndexBoxesState;
  readonly tools: ToolsState;
  readonly focus: FocusState;
}

/** A part of the state to be changed; what is left out stays. */
export type ScenePatch = {
  readonly [K in Exclude<keyof SceneState, "overrides">]?: Partial<SceneState[K]>;
} & { readonly overrides?: readonly ObjectOverride[] };
