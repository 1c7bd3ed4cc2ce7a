/**
 * The door of the scene: what the application and the panels may know of it. Everything in `scene/` that is not
 * exported here or by `scene/index.ts` is private.
 *
 * A SceneView draws the geometry of any number of results into one element of the page. Nothing in it is global, so
 * that two views can stand side by side. All coordinates are those of the database, in doubles.
 *
 * A view is made by `createSceneView(element)` (scene/index.ts). It works without WebGL, too: its state can be read and
 * set, only nothing is drawn, and `problem` says why.
 */

import type {
  Box,
  CameraState,
  CellRef,
  Color,
  Hit,
  ScenePatch,
  SceneState,
  StandardView,
  Vec3,
} from "./api_state";

export type * from "./api_state";

// ---------------------------------------------------------------------------------------------------------------
// Results

/** A column of a result that can be drawn. */
export interface ColumnRef {
  readonly result: string;
  readonly column: string;
}

/** A value by which objects are coloured; null is undefined. */
export type AttributeValue = number | string | boolean | null;

/** Parameters of GET /api/results/{id}/shapes. */
export interface ShapeRequest {
  readonly from: number;
  readonly count: number;
  /** Largest number of triangles of one shape; 0 for all. */
  readonly triangles: number;
  /** Called as bytes arrive; `total` is null if the server did not announce it. */
  readonly onBytes?: (received: number, total: number | null) => void;
}

/** What a mesh says of the colours of its vertices or faces, in the order of their numbers. */
export type ElementColors =
  | {
      readonly elements: "vertex" | "face";
      /** Red, green and blue of each, from 0 to 1, as files have them (sRGB). */
      readonly rgb: Float32Array;
    }
  | {
      readonly elements: "face";
      /** The name of the material of each, "" for none. */
      readonly materials: readonly string[];
      /** By name, as far as they are known. */
      readonly colors: Readonly<Record<string, Color>>;
    };

export interface ShapeBatch {
  /** The binary glTF of docs/http-api.md. The view keeps it and draws from it without a copy. */
  readonly bytes: ArrayBuffer;
  /** The row to go on with (header X-Algebra3d-Next), null at the end. */
  readonly next: number | null;
}

/** Where the view gets the geometry of a column from. The application implements it on the HTTP API. */
export interface ShapeSource extends ColumnRef {
  /** What a person calls it: name of an object, or the statement. */
  readonly title: string;
  /** The page shows it by itself; the same thing that is asked for by a person is another one. */
  readonly isPreview?: boolean;
  /** Number of rows. */
  readonly count: number;
  /** The columns by whose values objects may be coloured. */
  readonly attributes: readonly { readonly name: string; readonly type: string }[];
  load(request: ShapeRequest, signal: AbortSignal): Promise<ShapeBatch>;
  /** Values of an attribute for `count` rows. */
  values(
    attribute: string,
    from: number,
    count: number,
    signal: AbortSignal,
  ): Promise<readonly AttributeValue[]>;
  /** Of the mesh of a row; null if it has none. */
  elementColors?(row: number, signal: AbortSignal): Promise<ElementColors | null>;
  /** What the server is doing for this column (GET .../progress), '' if nothing. */
  progress?(signal: AbortSignal): Promise<string>;
}

/** How far the loading of a column is. */
export interface LoadProgress extends ColumnRef {
  /** `coarse` first picture, `fine` better levels of detail, `done`, `failed`, or `stopped` by a person. */
  readonly phase: "coarse" | "fine" | "done" | "failed" | "stopped";
  readonly rowsLoaded: number;
  readonly rows: number;
  readonly bytes: number;
  /** Of the request that is running; null if unknown. */
  readonly fraction: number | null;
  /** For people: "12 of 50 objects", or the server's own text, or the error. */
  readonly text: string;
}

/** What is known of a loaded shape. */
export interface ShapeInfo {
  readonly cell: CellRef;
  readonly kind: string;
  readonly box: Box | null;
  readonly triangles: number;
  /** Triangles of the level of detail that is drawn. */
  readonly shown: number;
  /** Largest distance by which a vertex of this level was moved; 0 if it is exact but for rounding to floats. */
  readonly deviation: number;
  readonly visible: boolean;
  /** By which it is drawn beside its place, in an exploded picture. */
  readonly offset: Vec3;
}

// ---------------------------------------------------------------------------------------------------------------
// Events

export interface VertexMove {
  readonly cell: CellRef;
  /** Number in the value, as by vertices(v). */
  readonly vertex: number;
  readonly from: Vec3;
  readonly to: Vec3;
  /** False while dragging, true when the button was let go. */
  readonly finished: boolean;
}

/** What was done to an object by its handle. */
export type Transformation =
  | { readonly mode: "translate"; readonly by: Vec3 }
  | { readonly mode: "rotate"; readonly about: Vec3; readonly axis: Vec3; readonly degrees: number }
  | { readonly mode: "scale"; readonly about: Vec3; readonly factors: Vec3 };

/** What keeps the view from drawing. */
export interface SceneProblem {
  readonly kind: "no_webgl" | "context_lost" | "out_of_memory";
  readonly message: string;
  readonly remedy: string;
}

export type SceneAction = string;

export interface SceneEvents {
  /** Any part of the state changed; `parts` says which. */
  state: { readonly parts: readonly (keyof SceneState)[] };
  /** The selection changed; `byPerson` if by a click in the view and not by select(). */
  selection: { readonly cells: readonly CellRef[]; readonly byPerson: boolean };
  /** A double click on an object: show its properties. */
  open: { readonly hit: Hit };
  /** The pointer is over a point, or over nothing. */
  hover: { readonly hit: Hit | null };
  /** The section plane rests at a new place: ask the database for the exact cut. */
  section: { readonly point: Vec3; readonly normal: Vec3 };
  /** The shapes or their levels of detail changed. */
  shapes: Record<string, never>;
  progress: LoadProgress;
  /** See SceneView.farCount. */
  far: { readonly count: number };
  vertex: VertexMove;
  /** The handle of an object was let go; the object is drawn there until another one takes its place or `resetDrag`. */
  transform: { readonly cell: CellRef; readonly transformation: Transformation };
  /** null when it is over. */
  problem: SceneProblem | null;
  /** A keyboard shortcut that the application has to carry out, see `shortcuts.ts`. */
  action: SceneAction;
}

// ---------------------------------------------------------------------------------------------------------------
// The view

export interface OverlayStyle {
  readonly color: Color;
  readonly edgeColor?: Color;
  readonly opacity?: number;
  readonly edges?: boolean;
  /** Drawn over everything else. */
  readonly onTop?: boolean;
}

/** Points and segments highlighted in the scene, such as defects of a file or a measured distance. */
export interface Markers {
  readonly points?: readonly Vec3[];
  readonly segments?: readonly (readonly [Vec3, Vec3])[];
  readonly triangles?: readonly (readonly [Vec3, Vec3, Vec3])[];
  readonly labels?: readonly { readonly at: Vec3; readonly text: string }[];
  /** Drawn with thin lines, and hidden by what lies before them. */
  readonly boxes?: readonly Box[];
  readonly color: Color;
  readonly size?: number;
}

export interface ScreenshotOptions {
  readonly transparent?: boolean;
  /** In pixels; those of the view if not given. */
  readonly width?: number;
  readonly height?: number;
}

/** Legend of the colours by an attribute. */
export type Legend =
  | {
      readonly kind: "numbers";
      readonly attribute: string;
      readonly min: number;
      readonly max: number;
      readonly stops: readonly Color[];
      readonly undefinedCount: number;
    }
  | {
      readonly kind: "categories";
      readonly attribute: string;
      readonly entries: readonly { readonly label: string; readonly color: Color; readonly count: number }[];
      readonly others: number;
    };

export interface SceneView {
  /** The element that was given; the canvas and the labels are its children. */
  readonly element: HTMLElement;
  readonly problem: SceneProblem | null;

  /** Calls `listener` at each event; returns a function that ends this. */
  on<K extends keyof SceneEvents>(event: K, listener: (data: SceneEvents[K]) => void): () => void;

  // Results
  /** Shows a column: coarse first, then finer. The first one that is added brings the standard view. */
  addResult(source: ShapeSource): void;
  /** Removes one column of a result, or all of them, and frees their memory. */
  removeResult(result: string, column?: string): void;
  /** Reads the shapes again, as after a change of the value; the old ones are drawn until then. */
  reloadResult(column: ColumnRef): void;
  readonly results: readonly ShapeSource[];
  /** Loads no more of a column; what is there stays. */
  stopLoading(column: ColumnRef): void;
  /** Goes on where `stopLoading` ended. */
  resumeLoading(column: ColumnRef): void;
  /** Shows or hides a result (without row) or an object. */
  setVisible(what: ColumnRef & { readonly row?: number }, visible: boolean): void;
  isVisible(what: ColumnRef & { readonly row?: number }): boolean;
  shapes(column?: ColumnRef): readonly ShapeInfo[];
  shape(cell: CellRef): ShapeInfo | null;
  /** What a person calls an object: the first text of its row, else the number of the row. */
  nameOf(cell: CellRef): string;
  /** The attributes of all results by which objects can be coloured. */
  readonly attributes: readonly { readonly name: string; readonly type: string }[];
  /** How far each column is loaded. */
  readonly progress: readonly LoadProgress[];

  // Selection
  readonly selection: readonly CellRef[];
  /** With `reveal` the camera goes to them, unless they are seen well. */
  select(cells: readonly CellRef[], options?: { readonly reveal?: boolean }): void;

  // State
  readonly state: SceneState;
  update(patch: ScenePatch): void;
  /** Takes the parts back to what they are in a new view; a camera means the standard view. */
  reset(...parts: (keyof SceneState)[]): void;
  readonly legend: Legend | null;
  /** Asks for the colours of the elements of meshes again. */
  elementColorsChanged(): void;
  /** What differs from a new view, for permanent links. */
  toJSON(): unknown;
  /** Takes over what toJSON() gave; what is not understood is left out, and listed in the answer. */
  restore(json: unknown): readonly string[];

  // Camera
  /** All that is visible, seen from the present direction; or only `cells`. */
  fit(cells?: readonly CellRef[]): void;
  /** The standard view: isometric, all is seen. */
  home(): void;
  /** The camera before it was last brought elsewhere by a command. */
  back(): void;
  /** Objects so far from the others that the camera did not go back for them by itself, until `fit` shows all. */
  readonly farCount: number;
  look(view: StandardView): void;
  /** Rolls or turns by degrees: about the view direction, the upward or the sideways axis. */
  turn(axis: "roll" | "up" | "side", degrees: number): void;
  /** The camera that sees all of a box from the present direction. */
  cameraSeeing(box: Box): CameraState;
  setCamera(camera: CameraState, options?: { readonly animate?: boolean }): void;

  // Tools
  /** Draws what is dragged by its handle where it was before, as after a transformation that failed. */
  resetDrag(): void;

  // Additions to the picture that do not belong to a result
  setCaps(caps: readonly { readonly cell: CellRef; readonly bytes: ArrayBuffer }[]): void;
  setOverlay(
    name: string,
    overlay: { readonly bytes: ArrayBuffer; readonly style: OverlayStyle } | null,
  ): void;
  setMarkers(name: string, markers: Markers | null): void;

  /** PNG. */
  screenshot(options?: ScreenshotOptions): Promise<Blob>;
  /** Carries out a shortcut or menu entry of `shortcuts.ts`; false if there is none of this name. */
  act(action: SceneAction): boolean;
  /** Takes the colours of the page's theme again; call after data-theme changed. */
  themeChanged(): void;
  /** Frees all memory; the view cannot be used afterwards. */
  dispose(): void;
}

// ---------------------------------------------------------------------------------------------------------------
// What the panels need of the application

/** A parameter `$name` of a statement, as in POST /api/query. */
export type Parameter = CellRef | { readonly type: string; readonly value: number | string };

export interface Answer {
  readonly type: string | null;
  readonly value: unknown;
  readonly diagnostics: readonly string[];
  readonly result: {
    readonly id: string;
    readonly count: number;
    readonly columns: readonly { readonly name: string; readonly type: string; readonly shape: boolean }[];
  } | null;
}

/** An R-tree of the database. */
export interface IndexInfo {
  readonly name: string;
  /** Whose tuples it holds; null for a copy that is not kept up to date. */
  readonly relation: string | null;
}

/** The database, as the panels use it. Methods reject with an Error whose message is for people. */
export interface Database {
  query(
    statement: string,
    parameters: Readonly<Record<string, Parameter>>,
    signal?: AbortSignal,
  ): Promise<Answer>;
  shapes(cell: CellRef, triangles: number, signal?: AbortSignal): Promise<ArrayBuffer>;
  /** Rows of a result, at most 10,000 at once. */
  rows(
    result: string,
    from: number,
    count: number,
    signal?: AbortSignal,
  ): Promise<readonly Readonly<Record<string, unknown>>[]>;
  /** The R-trees that there are now. */
  indexes(): readonly IndexInfo[];
  /** What can be asked about an object by a click. */
  questions(cell: CellRef): readonly { readonly label: string; readonly ask: () => void }[];
  /** Drops a result that is no longer needed. */
  drop(result: string): void;
  /** Shows a statement with its parameters as if it had been run in the editor: as a new result, overlaid. */
  show(statement: string, parameters: Readonly<Record<string, Parameter>>): void;
}
