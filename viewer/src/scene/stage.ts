/** Everything that is drawn, and the drawing of one frame. */

import { BufferGeometry, Color, Group, LineBasicMaterial, LineSegments, Scene, Vector3 } from "three";
import type { Box3, Camera, WebGLRenderer } from "three";

import type { Appearance, CameraState, SceneState, Vec3 } from "./api";
import type { SheetLabel } from "./arrangement";
import { cornersOf } from "./camera";
import type { Canvas } from "./canvas";
import { Dots } from "./dots";
import { boxLines, drawAxes, drawScaleBar, Grid, setLines } from "./furniture";
import { drawLightMarkers, Lights } from "./lights";
import type { Style } from "./look";
import { drawLabels } from "./markers";
import type { Addition } from "./markers";
import { clip, kPointScale, SharedMaterials } from "./materials";
import { Outline } from "./outline";
import { Overlay } from "./overlay";
import type { Picture } from "./picture";
import { Projector } from "./projection";
import { outlineOf, Section } from "./section";
import { kFull } from "./quality";
import type { QualityStep } from "./quality";
import { ShapeStore } from "./shape_store";
import { kSliceLayer, Slices } from "./slices";
import { kDefaultCamera } from "./state";
import { themeOf } from "./theme";
import { TransformHandle } from "./transform_handle";
import type { SceneTheme } from "./theme";
import { vertexTarget } from "./tools";
import { finishUploads } from "./uploads";
import { isFarOrigin, toVector3 } from "./vec";
import { usualObjects } from "./warm_up";

/** Edges on faces of the usual colours. */
const kEdgesOnFaces = "#0f151c";
const kEdgesOnDark = "#dde3ec";

/** Pixels below which a name is left out. */
const kLeastRoom = 40;
/** About the width of a letter in pixels. */
const kLetter = 7.5;

/** Whether two directions are nearly the same. */
function isAlong(a: Vec3, b: Vec3): boolean {
  return toVector3(a).normalize().dot(toVector3(b).normalize()) > 0.95;
}

/** The end of a name tells it apart from others: its middle gives way. */
function shortened(text: string, pixels: number): string {
  const most = Math.max(3, Math.floor(pixels / kLetter));
  if (text.length <= most) return text;
  const head = Math.ceil((most - 1) / 2);
  return `${text.slice(0, head)}…${text.slice(text.length - (most - 1 - head))}`;
}

export interface FrameOptions {
  /** Drawn by the processor. */
  readonly software: boolean;
  readonly quality: QualityStep;
  readonly backgroundless?: boolean;
  /** Where it is drawn before it is laid over the canvas, with so many pixels for one of it; null: on the canvas. */
  readonly picture?: { readonly place: Picture; readonly scale: number } | null;
}

/** A frame that is being drawn. */
export interface Frame {
  /** Draws all of it. */
  drawAll(): void;
  /** Draws about so many more triangles; true if nothing is left. */
  drawPart(triangles: number): boolean;
  /** Puts what was drawn on the canvas, with the outline of what is selected, labels and all that lies above. */
  finish(): void;
}

export class Stage {
  readonly projector = new Projector();
  readonly materials = new SharedMaterials();
  readonly store = new ShapeStore(this.materials);
  readonly lights = new Lights();
  readonly section = new Section();
  readonly dots = new Dots();
  private readonly outline = new Outline();
  readonly additions = new Map<string, Addition>();
  readonly overlay: Overlay;
  theme: SceneTheme;
  private readonly scene = new Scene();
  readonly handle = new TransformHandle(this.scene, this.store, this.projector);
  /** Of all that has coordinates of the database: they become those relative to the camera's target. */
  private readonly world = new Group();
  private readonly grid = new Grid();
  private readonly boxes = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  private box: Box3;
  private boxesStale = true;
  /** Of objects on a contact sheet. */
  names: readonly SheetLabel[] = [];
  private styleKey = "";
  /** Never drawn. */
  private usual: Group | null = null;

  constructor(private readonly element: HTMLElement) {
    this.overlay = new Overlay(element.ownerDocument, this.projector);
    element.append(this.overlay.canvas);
    this.theme = themeOf(element);
    this.box = this.store.box();
    this.boxes.frustumCulled = false;
    const { points } = this.dots;
    this.world.add(this.store.root, points, this.section.group, this.grid.group, this.boxes);
    this.scene.add(this.lights.group, this.world);
  }

  /** The box of all that is visible, with additions left out. */
  get contentBox(): Box3 {
    return this.box;
  }

  /** Of a contact sheet, the corners of the objects in a box: its plane is not that of an axis, so that boxes are too large. */
  pointsIn(box: Box3): readonly Vector3[] | undefined {
    if (this.names.length === 0) return undefined;
    const around = box.clone().expandByScalar(1e-9 * box.getSize(new Vector3()).length());
    const boxes = [...this.store.visibleRecords()].map((record) => record.box());
    return boxes.filter((own) => around.containsBox(own)).flatMap(cornersOf);
  }

  /** Whether a part of a box is in the view. */
  isInSight(box: Box3, camera: CameraState): boolean {
    if (box.isEmpty()) return false;
    const { width, height } = this.projector.size;
    this.projector.camera(camera, box);
    const places = [box.getCenter(new Vector3()), ...cornersOf(box)].map((corner) =>
      this.projector.project(corner),
    );
    const before = places.filter(({ visible }) => visible);
    const outside = (beyond: (place: { x: number; y: number }) => boolean): boolean => before.every(beyond);
    return !(
      outside(({ x }) => x < 0) ||
      outside(({ x }) => x > width) ||
      outside(({ y }) => y < 0) ||
      outside(({ y }) => y > height)
    );
  }

  /** Shapes came, went, or were moved, shown or hidden. */
  contentChanged(): void {
    this.box = this.store.box();
    this.boxesStale = true;
    this.dots.setRecords(this.store.visibleRecords());
  }

  themeChanged(): void {
    this.theme = themeOf(this.element);
    this.boxesStale = true;
  }

  addAddition(name: string, addition: Addition): void {
    this.additions.set(name, addition);
    this.world.add(addition.group);
  }

  /** Has the shaders of usual objects compiled, beside the page where the browser does that. */
  async warmUp(renderer: WebGLRenderer, state: SceneState): Promise<void> {
    const camera = this.prepare(state, { software: false, quality: kFull });
    this.usual = usualObjects(this.materials, this.styleOf(state));
    await renderer.compileAsync(this.usual, camera, this.scene);
    // Else they are asked for at the first picture, which waits for all that is drawn meanwhile.
    for (const program of renderer.info.programs ?? []) program.getUniforms();
  }

  /** Draws a frame at once. */
  draw(canvas: Canvas, state: SceneState, options: FrameOptions): void {
    const frame = this.begin(canvas, state, options);
    frame?.drawAll();
    frame?.finish();
  }

  /** Begins a frame. No other one may be begun before it is finished, unless it is given up. */
  begin(canvas: Canvas, state: SceneState, options: FrameOptions): Frame | null {
    const { renderer } = canvas;
    if (!renderer) return null;
    const { theme, scene } = this;
    const camera = this.prepare(state, options);
    const { place, scale } = options.picture ?? { place: null, scale: 1 };
    const background = new Color(state.appearance.background ?? theme.background);
    const enter = (): void => {
      kPointScale.value = scale;
      if (place) place.use(renderer);
      else renderer.setRenderTarget(null);
    };
    enter();
    renderer.setClearColor(background, options.backgroundless ? 0 : 1);
    renderer.info.reset();
    renderer.clear(true, true, true);
    let slices: Slices | null = null;
    return {
      drawAll: () => {
        enter();
        if (!options.quality.coarse) finishUploads(); // what is drawn for the first time may be large
        renderer.render(scene, camera);
      },
      drawPart: (triangles) => {
        // The projector's camera may be used for other views before the next part.
        slices ??= new Slices(scene, camera.clone());
        enter();
        const isComplete = slices.draw(renderer, triangles);
        renderer.setRenderTarget(null);
        return isComplete;
      },
      finish: () => {
        kPointScale.value = 1;
        place?.show(renderer);
        this.drawAbove(renderer, state, camera);
      },
    };
  }

  /** Brings everything into the state that is to be drawn. */
  private prepare(state: SceneState, { software, quality }: FrameOptions): Camera {
    const { projector } = this;
    this.applyStyle(state);
    this.store.setCoarse(quality.coarse);
    this.materials.edges.visible = quality.edges || !state.appearance.faces;
    this.lights.update(state.lights, state.camera);
    this.lights.group.traverse((light) => light.layers.enable(kSliceLayer));
    this.section.update(state.section, this.box, this.edgeColor(state.appearance));
    this.updateFurniture(state);
    const camera = projector.camera(state.camera, this.depthBox(state));
    this.world.position.copy(projector.origin).negate();
    this.store.update(state.camera, software ? projector.eyeFrom : null);
    this.dots.update(state.camera, projector.size.height);
    this.handle.update(camera);
    this.materials.setPlace(this.box, projector.origin);
    return camera;
  }

  private drawAbove(renderer: WebGLRenderer, state: SceneState, camera: Camera): void {
    const { projector } = this;
    const selected = this.store.selectedBox();
    if (!selected.isEmpty() && state.appearance.faces) {
      const clipping = this.section.clipping(state.section, projector.origin);
      this.outline.draw(renderer, this.scene, camera, { projector, box: selected, clipping });
    }
    this.overlay.begin(Math.max(1, globalThis.devicePixelRatio || 1));
    this.drawOverlay(state);
    this.overlay.end();
  }

  private applyStyle(state: SceneState): void {
    const style = this.styleOf(state);
    const { on } = state.section;
    const key = JSON.stringify([this.theme, state.appearance, state.display, on, style.stencil]);
    if (key === this.styleKey) return;
    this.styleKey = key;
    this.materials.apply(style);
    this.store.setStyle(style);
    this.dots.setStyle(style);
    clip(this.boxes.material, style.clipping);
  }

  private styleOf(state: SceneState): Style {
    return {
      edgeColor: this.edgeColor(state.appearance),
      appearance: state.appearance,
      display: state.display,
      clipping: this.section.clipping(state.section, toVector3(state.camera.target)),
      stencil: state.section.on && state.section.cap === "preview",
    };
  }

  /** Without faces, edges must be seen on the background. */
  edgeColor({ edgeColor, faces, background }: Appearance): string {
    if (edgeColor !== null) return edgeColor;
    if (faces) return kEdgesOnFaces;
    if (background === null) return this.theme.text;
    return new Color(background).getHSL({ h: 0, s: 0, l: 0 }).l > 0.5 ? kEdgesOnFaces : kEdgesOnDark;
  }

  private updateFurniture(state: SceneState): void {
    this.grid.group.visible = state.display.grid;
    if (state.display.grid) this.grid.update(state.camera, this.box, this.theme);
    this.boxes.visible = state.display.boxes;
    if (state.display.boxes) this.updateBoxes(state.camera);
  }

  private updateBoxes({ target, height }: CameraState): void {
    const origin = toVector3(target);
    if (isFarOrigin(this.boxes.position, origin, height)) this.boxesStale = true;
    if (!this.boxesStale) return;
    this.boxesStale = false;
    const boxes = [...this.store.visibleRecords()].map((record) => record.box());
    setLines(this.boxes, boxLines(boxes, origin), this.theme.accent);
    this.boxes.position.copy(origin);
  }

  /** All that may be seen, so that near and far planes do not cut it off. */
  private depthBox(state: SceneState): Box3 {
    const box = this.box.clone();
    if (!box.isEmpty() && state.display.grid) box.expandByScalar(state.camera.height);
    for (const { group, box: own } of this.additions.values()) if (group.visible) box.union(own);
    return box;
  }

  private drawOverlay(state: SceneState): void {
    const { overlay, projector, theme } = this;
    const { display, camera } = state;
    if (display.grid) this.grid.drawNumbers(overlay, projector, theme);
    if (state.section.on && state.section.plane && !this.box.isEmpty()) this.drawPlane(state);
    for (const { labels } of this.additions.values()) drawLabels(overlay, labels, theme);
    this.drawNames(camera);
    if (state.lights.markers) drawLightMarkers(overlay, projector, state.lights, theme);
    if (display.axes) drawAxes(overlay, camera, projector.size.height);
    if (display.scaleBar) drawScaleBar(overlay, camera, projector, theme);
    if (vertexTarget(state)) this.drawVertexHint();
  }

  /** Names below the cells of a contact sheet, as far as there is room for them. */
  private drawNames(camera: CameraState): void {
    const { overlay, projector, theme } = this;
    const scale = projector.size.height / camera.height;
    if (!isAlong(camera.direction, kDefaultCamera.direction)) return;
    for (const { at, text, width } of this.names) {
      const room = width * scale;
      if (room < kLeastRoom) continue;
      const place = projector.project(at);
      if (place.visible) overlay.text(shortened(text, room), place.x, place.y, { color: theme.text });
    }
  }

  private drawPlane(state: SceneState): void {
    const { overlay, projector, theme } = this;
    const { corners, centre, tip } = outlineOf(state.section, this.box);
    corners.forEach((corner, i) =>
      overlay.segment(corner, corners[(i + 1) % 4]!, state.section.capColor, 1.5),
    );
    overlay.segment(centre, tip, theme.accent, 2.5);
    const handle = projector.project(tip);
    if (handle.visible) overlay.disc(handle.x, handle.y, 7, theme.accent, theme.plate);
  }

  private drawVertexHint(): void {
    const { width } = this.projector.size;
    this.overlay.text("Drag a vertex", width / 2, 20, { color: this.theme.text, plate: this.theme.plate });
  }

  dispose(): void {
    this.handle.dispose();
    this.store.dispose();
    this.dots.dispose();
    this.outline.dispose();
    this.materials.dispose();
    this.lights.dispose();
    this.section.dispose();
    this.grid.dispose();
    this.boxes.geometry.dispose();
    this.boxes.material.dispose();
    this.overlay.canvas.remove();
  }
}
