/**
 * The WebGL canvas: making it, losing and restoring its context, and drawing frames only when something changed.
 *
 * What takes long is drawn in parts, each of which the graphics card carries out before it gets the next one, into a
 * picture beside the canvas. The first input ends that, so that it is never waited for.
 */

import { WebGLRenderer } from "three";

import type { SceneProblem } from "./api";
import { Parts } from "./frame_parts";
import { Picture } from "./picture";
import { kFull, Quality } from "./quality";
import type { QualityStep } from "./quality";
import type { Size } from "./projection";
import type { Frame, FrameOptions } from "./stage";
import { takeReserved } from "./uploads";

export const kNoWebgl: SceneProblem = {
  kind: "no_webgl",
  message:
    "This browser does not offer WebGL 2, so the scene cannot be drawn. Tables and queries work as usual.",
  remedy:
    "Switch on hardware acceleration, or software rendering, in the settings of the browser, or use another browser; " +
    "`about:gpu` or `about:support` says why.",
};

const kLost: SceneProblem = {
  kind: "context_lost",
  message: "The graphics card was taken away from this page, so the scene is not drawn at the moment.",
  remedy: "It comes back by itself in most cases; if not, hide some objects or reload the page.",
};

/** After so many milliseconds without movement a frame is drawn in full quality. */
const kRest = 160;
/** The same while a button is held: a slow machine must not draw in full between two movements of the hand. */
const kRestHeld = 1200;

/** Triangles that are drawn at once; the processor takes 10 ms for them, the graphics card of anyone less. */
const kAtOnce = { software: 80_000, hardware: 1_500_000 } as const;
/** More pixels than the canvas has, where each of them is drawn once only. */
const kSoftwareScale = 1.5;
const kMostPixels = 2;
/** What is shown at once of a change after which the picture takes long. */
const kQuick: QualityStep = { scale: 1, edges: true, coarse: true };

export interface CanvasClient {
  /** Begins a frame, of which nothing is drawn yet. */
  begin(options: Omit<FrameOptions, "software">): Frame | null;
  /** Of what is visible, at rest and in coarse levels. */
  triangles(): { readonly fine: number; readonly coarse: number };
  problem(problem: SceneProblem | null): void;
  resized(size: Size): void;
  /** The view itself has another size, not only a picture that is taken of it. */
  viewResized(): void;
}

export class Canvas {
  /** Its attribute `data-drawn` is `full` when the last frame, in full quality, is drawn; before that `changing`. */
  readonly element: HTMLCanvasElement;
  readonly renderer: WebGLRenderer | null;
  /** Drawn by the processor: no hardware is behind it. */
  readonly software: boolean;
  private readonly quality: Quality;
  private readonly observer: ResizeObserver;
  private size: Size = { width: 1, height: 1 };
  /** What the drawing buffer was made for. */
  private applied = "";
  private requested = 0;
  /** Something changed since the last frame. */
  private stale = false;
  /** All that changed since the last frame is what is there, by itself. */
  private contentIsNew = false;
  /** When the last frame was drawn, if the browser has not asked for the next one since. */
  private drawnAt: number | null = null;
  private moving = false;
  private held = false;
  private restTimer: ReturnType<typeof setTimeout> | undefined;
  private lost = false;
  private disposed = false;
  private readonly picture: Picture;
  private readonly parts: Parts | null;
  /** Number of frames that were drawn, for tests. */
  frames = 0;

  constructor(
    private readonly parent: HTMLElement,
    private readonly client: CanvasClient,
  ) {
    this.element = parent.ownerDocument.createElement("canvas");
    Object.assign(this.element.style, {
      display: "block",
      width: "100%",
      height: "100%",
      touchAction: "none",
    });
    parent.append(this.element);
    this.software = isSoftware(parent.ownerDocument);
    this.quality = new Quality(this.software);
    this.picture = new Picture(this.software ? 0 : 4);
    this.renderer = this.makeRenderer();
    this.parts = this.renderer && new Parts(this.renderer, this.software);
    this.element.addEventListener("webglcontextlost", this.onLost);
    this.element.addEventListener("webglcontextrestored", this.onRestored);
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(parent);
    this.resize();
  }

  private makeRenderer(): WebGLRenderer | null {
    try {
      const renderer = new WebGLRenderer({
        canvas: this.element,
        // Without hardware, four samples a pixel cost too much; the frame at rest has a higher resolution instead.
        antialias: !this.software,
        alpha: true,
        stencil: true,
        powerPreference: "high-performance",
      });
      takeReserved(renderer.getContext() as WebGL2RenderingContext);
      renderer.localClippingEnabled = true;
      renderer.autoClear = false;
      renderer.info.autoReset = false;
      // Asking for errors of a shader waits for its compiler; one that fails draws nothing, which the tests see.
      renderer.debug.checkShaderErrors = false;
      return renderer;
    } catch {
      this.client.problem(kNoWebgl);
      return null;
    }
  }

  private readonly onLost = (event: Event): void => {
    event.preventDefault();
    this.lost = true;
    this.parts?.giveUp();
    this.client.problem(kLost);
  };

  private readonly onRestored = (): void => {
    this.lost = false;
    this.client.problem(null);
    this.request();
  };

  private resize(): void {
    const rect = this.parent.getBoundingClientRect();
    const size = { width: Math.max(1, Math.round(rect.width)), height: Math.max(1, Math.round(rect.height)) };
    if (size.width === this.size.width && size.height === this.size.height) return;
    this.size = size;
    this.client.resized(size);
    this.client.viewResized();
    if (this.frames > 0) {
      this.parts?.giveUp();
      this.applySize();
      this.drawQuickly(); // at once, since the new buffer is empty
    }
    this.request();
  }

  private applySize(): void {
    const { renderer, size } = this;
    const ratio = this.deviceRatio();
    const applied = `${size.width} ${size.height} ${ratio}`;
    if (!renderer || applied === this.applied) return;
    this.applied = applied;
    // Not setPixelRatio, which changes the size of the buffer as well.
    renderer.setDrawingBufferSize(size.width, size.height, ratio);
  }

  /** Pixels of the canvas for one of the page. */
  private deviceRatio(): number {
    return Math.min(kMostPixels, globalThis.devicePixelRatio || 1);
  }

  /** Asks for a frame; `moving` if more will follow soon, so that it may be coarser. */
  request(moving = false): void {
    if (moving) {
      if (!this.moving) {
        this.quality.begin(this.client.triangles());
        this.drawnAt = null;
      }
      this.moving = true;
      this.restLater();
    }
    this.parts?.giveUp();
    this.stale = true;
    this.element.dataset["drawn"] = "changing";
    this.awaitFrame();
  }

  private awaitFrame(): void {
    if (this.requested || this.disposed) return;
    this.requested = requestAnimationFrame(this.onFrame);
  }

  private restLater(): void {
    clearTimeout(this.restTimer);
    this.restTimer = setTimeout(this.rest, this.held ? kRestHeld : kRest);
  }

  /** A button is held, so that the movement may go on after a pause. */
  hold(held: boolean): void {
    this.held = held;
    if (this.moving) this.restLater();
  }

  /** Shapes came, or went: a picture that is being drawn is finished first, since more of them may come soon. */
  contentChanged(): void {
    this.quality.reset();
    this.contentIsNew = true;
    this.stale = true;
    this.element.dataset["drawn"] = "changing";
    if (!this.parts?.isDrawing) this.awaitFrame();
  }

  private readonly rest = (): void => {
    this.moving = false;
    this.request();
  };

  private readonly onFrame = (time: number): void => {
    this.requested = 0;
    // The browser asks late if drawing took long; the time between two movements of the hand does not count.
    if (this.drawnAt !== null) this.quality.observe(time - this.drawnAt);
    this.drawnAt = null;
    if (!this.stale) return;
    this.drawNow();
    if (!this.moving) return;
    this.drawnAt = time;
    this.awaitFrame();
  };

  private drawNow(): void {
    this.stale = false;
    if (!this.renderer || this.lost || this.disposed) return;
    this.applySize();
    if (this.moving) this.drawQuickly();
    else this.drawAtRest();
    this.contentIsNew = false;
  }

  /** As finely as frames of a movement are drawn. */
  private drawQuickly(): void {
    const { step } = this.quality;
    this.drawAtOnce(this.deviceRatio() * step.scale, step);
  }

  private drawAtRest(): void {
    const ratio = this.software
      ? Math.min(kMostPixels, this.deviceRatio() * kSoftwareScale)
      : this.deviceRatio();
    const { fine, coarse } = this.client.triangles();
    const most = this.software ? kAtOnce.software : kAtOnce.hardware;
    if (fine <= most || !this.parts) {
      this.drawAtOnce(ratio, kFull);
      this.completed();
      return;
    }
    // What a person changed is seen at once, if not finely.
    if (!this.contentIsNew && coarse < fine / 2) this.drawAtOnce(this.deviceRatio(), kQuick);
    const frame = this.client.begin({ quality: kFull, picture: this.pictureOf(ratio) });
    if (!frame) return;
    this.frames++;
    this.parts.draw(frame, () => {
      frame.finish();
      this.completed();
    });
  }

  private completed(): void {
    if (this.stale) this.awaitFrame();
    else this.element.dataset["drawn"] = "full";
  }

  private drawAtOnce(ratio: number, quality: QualityStep): void {
    this.frames++;
    const picture = ratio === this.deviceRatio() ? null : this.pictureOf(ratio);
    const frame = this.client.begin({ quality, picture });
    frame?.drawAll();
    frame?.finish();
  }

  private pictureOf(ratio: number): NonNullable<FrameOptions["picture"]> {
    const { width, height } = this.size;
    this.picture.begin(Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio)));
    return { place: this.picture, scale: ratio / this.deviceRatio() };
  }

  /** Draws at a size and gives the picture to `take` before the browser clears it; then draws as before. */
  capture<T>(size: Size, take: (canvas: HTMLCanvasElement) => T): T | null {
    const { renderer } = this;
    if (!renderer || this.lost) return null;
    this.parts?.giveUp();
    const before = this.size;
    this.client.resized(size);
    this.applied = "";
    renderer.setDrawingBufferSize(size.width, size.height, this.software ? kMostPixels : this.deviceRatio());
    this.drawAtOnce(this.deviceRatio(), kFull);
    const result = take(this.element);
    this.client.resized(before);
    this.applySize();
    this.drawQuickly();
    this.request();
    return result;
  }

  dispose(): void {
    this.disposed = true;
    cancelAnimationFrame(this.requested);
    clearTimeout(this.restTimer);
    this.parts?.giveUp();
    this.picture.dispose();
    this.observer.disconnect();
    this.element.removeEventListener("webglcontextlost", this.onLost);
    this.element.removeEventListener("webglcontextrestored", this.onRestored);
    this.renderer?.dispose();
    this.renderer?.forceContextLoss();
    this.element.remove();
  }
}

/** Whether WebGL is drawn by the processor. */
function isSoftware(document: Document): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  if (!context) return false;
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = String(context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER));
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
