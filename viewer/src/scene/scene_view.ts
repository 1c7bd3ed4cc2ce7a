/** The view that the application sees; puts the parts of the scene together. */

import { performAction } from "./actions";
import { Additions } from "./additions";
import type * as api from "./api";
import { normalizedCamera } from "./camera";
import { Canvas } from "./canvas";
import { Coloring } from "./coloring";
import { Contents } from "./contents";
import { Emitter } from "./events";
import { Interaction } from "./interaction";
import { Loader } from "./loader";
import { Owners } from "./owners";
import { Picker } from "./picking";
import { PointerInput } from "./pointer";
import { takeScreenshot } from "./screenshot";
import { cellKey } from "./shape_store";
import type { Column } from "./shape_store";
import { Sight } from "./sight";
import { kDefaultState, patched, stateToJson } from "./state";
import { stateFromJson } from "./state_json";
import { Stage } from "./stage";
import type { Frame, FrameOptions } from "./stage";
import { handleTarget, inOwnPlace, picked, vertexTarget, withoutObjects } from "./tools";
import { fromVector3, toBox3 } from "./vec";

function isArrangedAnew(before: api.DisplayState, now: api.DisplayState): boolean {
  const key = ({ arrangement, explode, sortBy, descending }: api.DisplayState): string =>
    JSON.stringify([arrangement, explode, sortBy, descending]);
  return key(before) !== key(now);
}

/** What the colours of objects, and where they are drawn, depend on. */
const kColoringParts: ReadonlySet<keyof api.SceneState> = new Set([
  "appearance",
  "overrides",
  "display",
  "focus",
]);

export class View implements api.SceneView {
  state: api.SceneState = kDefaultState;
  problem: api.SceneProblem | null = null;
  selection: readonly api.CellRef[] = [];
  readonly emitter = new Emitter<api.SceneEvents>();
  readonly stage: Stage;
  readonly canvas: Canvas;
  private readonly additions: Additions;
  readonly coloring: Coloring;
  private readonly loader: Loader;
  private readonly contents: Contents;
  private readonly picker: Picker;
  private readonly interaction: Interaction;
  private readonly input: PointerInput;
  private coloringStale = false;
  private readonly sight: Sight;
  private readonly owners = new Owners();

  constructor(readonly element: HTMLElement) {
    if (getComputedStyle(element).position === "static") element.style.position = "relative";
    this.stage = new Stage(element);
    this.additions = new Additions(this.stage);
    this.sight = new Sight(this.stage, {
      camera: () => this.state.camera,
      show: (camera, moving) => this.change({ camera }, moving),
      aspect: () => this.stage.projector.aspect,
      points: (box) => this.stage.pointsIn(box),
      isBlind: () => this.canvas.renderer === null,
      farChanged: (count) => this.emitter.emit("far", { count }),
    });
    this.coloring = new Coloring(this.stage.store, () => this.coloringChanged());
    this.loader = new Loader(this.stage.store, {
      progress: (progress) => this.emitter.emit("progress", progress),
      changed: (column, came) => this.shapesCame(column, came),
    });
    this.contents = new Contents(this.stage.store, this.loader, this.coloring);
    const { store, projector } = this.stage;
    const dots = () => this.stage.dots.dots(this.state.camera, projector.size.height);
    this.picker = new Picker(store, projector, dots, () => undefined);
    this.interaction = new Interaction(this.stage, this.picker, this.interactionHost());
    this.canvas = new Canvas(element, {
      begin: (options) => this.begin(options),
      triangles: () => this.stage.store.triangleCounts(),
      problem: (problem) => this.emitter.emit("problem", (this.problem = problem)),
      resized: (size) => (this.stage.projector.size = size),
      viewResized: () => this.sight.resized(),
    });
    element.append(this.stage.overlay.canvas); // above the picture
    this.input = new PointerInput(this.canvas.element, this.interaction);
    if (this.canvas.renderer) void this.stage.warmUp(this.canvas.renderer, this.state);
  }

  private interactionHost(): ConstructorParameters<typeof Interaction>[2] {
    // eslint-disable-next-line @typescript-eslint/no-this-alias -- the getters below are those of the object
    const view = this;
    return {
      get state() {
        return view.state;
      },
      get selection() {
        return view.selection;
      },
      moveCamera: (camera) => this.moveCamera(camera),
      update: (patch, moving) => this.change(patch, moving ?? false),
      selectByPerson: (cells) => this.setSelection(cells, true),
      opened: (hit) => this.emitter.emit("open", { hit }),
      picked: (hit) => this.change({ tools: picked(this.state.tools, this.own(hit)) }, false),
      hovered: (hit) => this.emitter.emit("hover", { hit: hit && this.own(hit) }),
      sectionRests: () => this.sectionRests(),
      vertexMoved: (move) => this.emitter.emit("vertex", move),
      transformed: (cell, transformation) => this.emitter.emit("transform", { cell, transformation }),
      redraw: (moving) => this.canvas.request(moving),
      held: (down) => this.canvas.hold(down),
    };
  }

  private own(hit: api.Hit): api.Hit {
    return inOwnPlace(hit, this.stage.store.record(hit.cell)?.look?.offset ?? [0, 0, 0]);
  }

  private begin(options: Omit<FrameOptions, "software">): Frame | null {
    this.applyColoring();
    return this.stage.begin(this.canvas, this.state, { ...options, software: this.canvas.software });
  }

  on<K extends keyof api.SceneEvents>(event: K, listener: (data: api.SceneEvents[K]) => void): () => void {
    return this.emitter.on(event, listener);
  }

  // Results -------------------------------------------------------------------------------------------------------

  get results(): readonly api.ShapeSource[] {
    return this.contents.sources;
  }

  get progress(): readonly api.LoadProgress[] {
    return this.contents.progress;
  }

  addResult(source: api.ShapeSource): void {
    if (this.contents.has(source)) this.removeResult(source.result, source.column);
    this.contents.add(source);
  }

  removeResult(result: string, column?: string): void {
    this.contents.remove(result, column);
    const isGone = (cell: api.CellRef): boolean =>
      cell.result === result && (column === undefined || cell.column === column);
    this.setSelection(
      this.selection.filter((cell) => !isGone(cell)),
      false,
    );
    this.update(withoutObjects(this.state, isGone));
    this.contentChanged();
    this.sight.othersAreSeen();
  }

  reloadResult(ref: api.ColumnRef): void {
    this.contents.reload(ref);
  }

  stopLoading(ref: api.ColumnRef): void {
    this.contents.stopLoading(ref);
  }

  resumeLoading(ref: api.ColumnRef): void {
    this.contents.resumeLoading(ref);
  }

  private shapesCame(column: Column, came: "first" | "more" | "finer"): void {
    this.contents.applyFocus(this.state.focus);
    this.contentChanged();
    this.showGrips(true);
    this.sight.came(column, came);
  }

  private contentChanged(): void {
    this.coloringStale = true;
    this.applyColoring();
    this.stage.contentChanged();
    this.canvas.contentChanged();
    this.keepWithObjects();
    this.emitter.emit("shapes", {});
  }

  /** What was placed for other objects is placed anew: a section in the middle, the objects in their own places. */
  private keepWithObjects(): void {
    if (this.owners.take(this.stage.store.visibleColumns())) return;
    this.update({ display: { arrangement: "place", sortBy: "" } });
    const box = this.stage.contentBox;
    if (!this.state.section.on) return;
    this.update({ section: { point: fromVector3(box.getCenter(box.min.clone())), cap: "preview" } });
    this.sectionRests();
  }

  setVisible(what: api.ColumnRef & { readonly row?: number }, visible: boolean): void {
    if (!this.contents.has(what)) return;
    const { row } = what;
    if (row !== undefined) {
      this.hide({ ...what, row }, !visible);
      return;
    }
    if (this.contents.isVisible(what) === visible) return;
    const appeared = this.contents.setVisible(what, visible);
    this.visibilityChanged();
    if (appeared) this.sight.bringIn(appeared);
  }

  private hide(cell: api.CellRef, isHidden: boolean): void {
    const key = cellKey(cell);
    const others = this.state.focus.hidden.filter((other) => cellKey(other) !== key);
    this.update({ focus: { hidden: isHidden ? [...others, cell] : others } });
  }

  /** After columns or objects were shown or hidden. */
  private visibilityChanged(): void {
    this.contents.refreshVisibility();
    this.contentChanged();
    this.sight.othersAreSeen();
  }

  isVisible(what: api.ColumnRef & { readonly row?: number }): boolean {
    return this.contents.isVisible(what);
  }

  shapes(ref?: api.ColumnRef): readonly api.ShapeInfo[] {
    return this.contents.shapes(ref);
  }

  shape(cell: api.CellRef): api.ShapeInfo | null {
    return this.contents.shape(cell);
  }

  get attributes(): readonly { readonly name: string; readonly type: string }[] {
    return this.coloring.attributes();
  }

  // Selection -----------------------------------------------------------------------------------------------------

  select(cells: readonly api.CellRef[], options: { readonly reveal?: boolean } = {}): void {
    this.setSelection(cells, false);
    if (options.reveal) this.sight.reveal(cells.flatMap((cell) => this.stage.store.record(cell) ?? []));
  }

  private setSelection(cells: readonly api.CellRef[], byPerson: boolean): void {
    if (JSON.stringify(cells) === JSON.stringify(this.selection)) return;
    this.selection = cells;
    this.coloringChanged();
    this.loader.select(cells);
    this.emitter.emit("selection", { cells, byPerson });
  }

  private coloringChanged(): void {
    this.coloringStale = true;
    this.canvas.request();
    // The legend is a part of the appearance.
    this.emitter.emit("state", { parts: ["appearance"] });
  }

  private applyColoring(): void {
    if (!this.coloringStale) return;
    this.coloringStale = false;
    this.coloring.apply(this.state, this.selection);
    this.stage.names = this.coloring.labels;
  }

  get legend(): api.Legend | null {
    this.applyColoring();
    return this.coloring.legend;
  }

  elementColorsChanged(): void {
    this.coloring.forgetElementColors();
    this.coloringChanged();
  }

  // State ---------------------------------------------------------------------------------------------------------

  update(patch: api.ScenePatch): void {
    if (patch.camera) this.sight.finish();
    this.change(patch, false);
  }

  private change(patch: api.ScenePatch, moving: boolean): void {
    const { state, parts } = patched(this.state, patch);
    if (parts.length === 0) return;
    const before = this.state;
    this.state = parts.includes("camera") ? { ...state, camera: normalizedCamera(state.camera) } : state;
    if (parts.includes("camera")) this.sight.changed();
    if (parts.some((part) => kColoringParts.has(part))) this.coloringStale = true;
    if (parts.includes("tools")) this.toolsChanged(before);
    if (isArrangedAnew(before.display, state.display)) this.arrange();
    if (parts.includes("focus")) {
      this.contents.applyFocus(state.focus);
      this.visibilityChanged();
    }
    this.canvas.request(moving);
    this.emitter.emit("state", { parts });
  }

  /** Draws the objects in other places, and shows them all. */
  private arrange(): void {
    this.applyColoring();
    this.stage.contentChanged();
    this.sight.arranged();
  }

  reset(...parts: (keyof api.SceneState)[]): void {
    for (const part of parts) {
      if (part === "camera") this.home();
      else this.update({ [part]: kDefaultState[part] });
    }
  }

  toJSON(): unknown {
    return stateToJson(this.state);
  }

  restore(json: unknown): readonly string[] {
    const { patch, rejected } = stateFromJson(json);
    const { camera, overrides, ...rest } = { ...kDefaultState, ...patch };
    this.owners.forget();
    for (const [part, value] of Object.entries(rest)) {
      const whole = { ...Reflect.get(kDefaultState, part), ...value } as unknown;
      this.update({ [part]: whole });
    }
    this.update({ overrides });
    if (patch.camera) {
      this.update({ camera });
      this.sight.restored();
    }
    return rejected;
  }

  // Camera --------------------------------------------------------------------------------------------------------

  private moveCamera(camera: api.CameraState): void {
    this.sight.movedByPerson();
    this.change({ camera }, true);
  }

  fit(cells?: readonly api.CellRef[]): void {
    this.sight.fit(cells?.flatMap((cell) => this.stage.store.record(cell) ?? []));
  }

  nameOf(cell: api.CellRef): string {
    return this.coloring.nameOf(cell);
  }

  get farCount(): number {
    return this.sight.farCount;
  }

  home(): void {
    this.look("isometric");
  }

  back(): void {
    this.sight.back();
  }

  look(view: api.StandardView): void {
    this.sight.look(view);
  }

  turn(axis: "roll" | "up" | "side", degrees: number): void {
    this.sight.turn(axis, degrees);
  }

  cameraSeeing(box: api.Box): api.CameraState {
    return this.sight.seeing(toBox3(box));
  }

  setCamera(camera: api.CameraState, options: { readonly animate?: boolean } = {}): void {
    this.sight.go(camera, options.animate ?? true);
  }

  // Tools and additions -------------------------------------------------------------------------------------------

  private toolsChanged(before: api.SceneState): void {
    const { tool } = this.state.tools;
    this.canvas.element.style.cursor = tool === "select" ? "" : "crosshair";
    const [old, now] = [vertexTarget(before), vertexTarget(this.state)];
    if (JSON.stringify(old) !== JSON.stringify(now)) {
      if (old) this.stage.store.record(old.cell)?.finest?.body.showGrips(false);
      this.showGrips(true);
    }
    const handle = handleTarget(this.state);
    if (JSON.stringify(handle) !== JSON.stringify(this.stage.handle.target))
      this.stage.handle.target = handle;
  }

  resetDrag(): void {
    this.stage.handle.target = handleTarget(this.state);
    this.canvas.request();
  }

  /** The vertices that can be dragged. */
  private showGrips(show: boolean): void {
    const target = vertexTarget(this.state);
    const record = target && this.stage.store.record(target.cell);
    record?.finest?.body.showGrips(show);
  }

  /** The section plane was let go: the exact cut can be asked for. */
  sectionRests(): void {
    this.canvas.request();
    const { point, normal } = this.state.section;
    this.emitter.emit("section", { point, normal });
  }

  setCaps(caps: readonly { readonly cell: api.CellRef; readonly bytes: ArrayBuffer }[]): void {
    this.additions.setCaps(caps);
    this.canvas.request();
  }

  setOverlay(
    name: string,
    overlay: { readonly bytes: ArrayBuffer; readonly style: api.OverlayStyle } | null,
  ): void {
    this.additions.setOverlay(name, overlay);
    this.canvas.request();
  }

  setMarkers(name: string, markers: api.Markers | null): void {
    this.additions.setMarkers(name, markers);
    this.canvas.request();
  }

  screenshot(options: api.ScreenshotOptions = {}): Promise<Blob> {
    this.applyColoring();
    return takeScreenshot(this.canvas, this.stage, this.state, options);
  }

  act(action: api.SceneAction): boolean {
    return performAction(this, action);
  }

  themeChanged(): void {
    this.stage.themeChanged();
    this.canvas.request();
    // Colours that are not chosen are those of the theme.
    this.emitter.emit("state", { parts: ["appearance"] });
  }

  dispose(): void {
    this.sight.stop();
    this.loader.stopAll();
    this.additions.clear();
    this.input.dispose();
    this.interaction.dispose();
    this.picker.dispose();
    this.stage.dispose();
    this.canvas.dispose();
    this.emitter.clear();
  }
}
