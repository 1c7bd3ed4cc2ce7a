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
import { Picker } from "./picking";
import { PointerInput } from "./pointer";
import type { QualityStep } from "./quality";
import { takeScreenshot } from "./screenshot";
import type { Column } from "./shape_store";
import { Sight } from "./sight";
import { kDefaultState, patched, stateToJson } from "./state";
import { stateFromJson } from "./state_json";
import { Stage } from "./stage";
import { toBox3 } from "./vec";

export class View implements api.SceneView {
  state: api.SceneState = kDefaultState;
  problem: api.SceneProblem | null = null;
  selection: readonly api.CellRef[] = [];
  readonly snap = { vertices: true, edges: true };
  private currentTool: api.Tool = "select";
  private target: api.SceneView["vertexTarget"] = null;
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

  constructor(readonly element: HTMLElement) {
    if (getComputedStyle(element).position === "static") element.style.position = "relative";
    this.stage = new Stage(element);
    this.additions = new Additions(this.stage);
    this.sight = new Sight(this.stage, {
      camera: () => this.state.camera,
      show: (camera, moving) => this.change({ camera }, moving),
      aspect: () => this.stage.projector.aspect,
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
      draw: (quality) => this.draw(quality),
      triangles: () => this.stage.store.triangleCounts(),
      problem: (problem) => this.emitter.emit("problem", (this.problem = problem)),
      resized: (size) => (this.stage.projector.size = size),
      viewResized: () => this.sight.resized(),
    });
    element.append(this.stage.overlay.canvas); // above the picture
    this.input = new PointerInput(this.canvas.element, this.interaction);
  }

  private interactionHost(): ConstructorParameters<typeof Interaction>[2] {
    // eslint-disable-next-line @typescript-eslint/no-this-alias -- the getters below are those of the object
    const view = this;
    return {
      get state() {
        return view.state;
      },
      get tool() {
        return view.tool;
      },
      get snap() {
        return view.snap;
      },
      get vertexTarget() {
        return view.vertexTarget;
      },
      get selection() {
        return view.selection;
      },
      moveCamera: (camera) => this.moveCamera(camera),
      update: (patch, moving) => this.change(patch, moving ?? false),
      selectByPerson: (cells) => this.setSelection(cells, true),
      opened: (hit) => this.emitter.emit("open", { hit }),
      picked: (hit) => this.emitter.emit("pick", { hit, tool: this.tool }),
      hovered: (hit) => this.emitter.emit("hover", { hit }),
      sectionRests: () => this.sectionRests(),
      vertexMoved: (move) => this.emitter.emit("vertex", move),
      transformed: (cell, transformation) => this.emitter.emit("transform", { cell, transformation }),
      redraw: (moving) => this.canvas.request(moving),
      held: (down) => this.canvas.hold(down),
    };
  }

  private draw(quality: QualityStep): void {
    this.applyColoring();
    this.stage.draw(this.canvas, this.state, { software: this.canvas.software, quality, tool: this.tool });
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
    const left = this.selection.filter((cell) => this.stage.store.record(cell));
    if (left.length !== this.selection.length) this.setSelection(left, false);
    this.contentChanged();
    this.sight.othersAreSeen();
  }

  reloadResult(ref: api.ColumnRef): void {
    this.contents.reload(ref);
  }

  private shapesCame(column: Column, came: "first" | "more" | "finer"): void {
    this.contentChanged();
    if (this.currentTool === "vertex") this.showGrips(true);
    this.sight.came(column, came);
  }

  private contentChanged(): void {
    this.coloringStale = true;
    this.applyColoring();
    this.stage.contentChanged();
    this.canvas.contentChanged();
    this.emitter.emit("shapes", {});
  }

  setVisible(what: api.ColumnRef & { readonly row?: number }, visible: boolean): void {
    if (!this.contents.has(what)) return;
    const appeared = this.contents.setVisible(what, visible);
    this.visibilityChanged();
    if (appeared) this.sight.bringIn(appeared);
  }

  /** After `hidden` of records was changed. */
  visibilityChanged(): void {
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

  select(cells: readonly api.CellRef[], options: { readonly fit?: boolean } = {}): void {
    this.setSelection(cells, false);
    if (options.fit) this.fit(cells);
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
  }

  get legend(): api.Legend | null {
    this.applyColoring();
    return this.coloring.legend;
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
    if (parts.some((part) => part === "appearance" || part === "overrides" || part === "display")) {
      this.coloringStale = true;
    }
    if (before.display.explode !== state.display.explode) {
      this.applyColoring();
      this.stage.contentChanged();
    }
    this.canvas.request(moving);
    this.emitter.emit("state", { parts });
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

  get farCount(): number {
    return this.sight.farCount;
  }

  home(): void {
    this.look("isometric");
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

  get tool(): api.Tool {
    return this.currentTool;
  }

  set tool(tool: api.Tool) {
    if (tool === this.currentTool) return;
    this.currentTool = tool;
    this.showGrips(tool === "vertex");
    this.canvas.element.style.cursor = tool === "select" ? "" : "crosshair";
    this.canvas.request();
    this.emitter.emit("tool", { tool });
  }

  get vertexTarget(): api.SceneView["vertexTarget"] {
    return this.target;
  }

  set vertexTarget(target: api.SceneView["vertexTarget"]) {
    this.showGrips(false);
    this.target = target;
    this.showGrips(this.currentTool === "vertex");
  }

  get transformTarget(): api.SceneView["transformTarget"] {
    return this.stage.handle.target;
  }

  set transformTarget(target: api.SceneView["transformTarget"]) {
    this.stage.handle.target = target;
    this.canvas.request();
  }

  /** The vertices that can be dragged. */
  private showGrips(show: boolean): void {
    const record = this.target && this.stage.store.record(this.target.cell);
    record?.finest?.body.showGrips(show);
    this.canvas.request();
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
