/**
 * Draws a frame in parts. Each is carried out by the graphics card before the next one is sent to it, and is so large
 * that this takes a few hundredths of a second: whatever else is to be drawn waits no longer than that.
 */

import type { WebGLRenderer } from "three";

import type { Frame } from "./stage";

/** Milliseconds of a part. */
const kGoal = 30;
/** Milliseconds between looks whether it is carried out. */
const kLook = 4;
const kFirst = { software: 60_000, hardware: 1_000_000 } as const;
const kLeast = 10_000;
const kMost = 20_000_000;

export class Parts {
  private readonly gl: WebGL2RenderingContext;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private frame: Frame | null = null;
  /** Triangles of the next part. */
  private budget: number;

  constructor(renderer: WebGLRenderer, software: boolean) {
    this.gl = renderer.getContext() as WebGL2RenderingContext;
    this.budget = software ? kFirst.software : kFirst.hardware;
  }

  get isDrawing(): boolean {
    return this.frame !== null;
  }

  /** Draws a frame, and tells when that is done; a frame before it is given up. */
  draw(frame: Frame, done: () => void): void {
    this.giveUp();
    this.frame = frame;
    this.drawNext(frame, done);
  }

  giveUp(): void {
    clearTimeout(this.timer);
    this.frame = null;
  }

  private drawNext(frame: Frame, done: () => void): void {
    const { gl } = this;
    const start = performance.now();
    const isLast = frame.drawPart(this.budget);
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    const look = (): void => {
      const isCarriedOut = !fence || gl.getSyncParameter(fence, gl.SYNC_STATUS) === gl.SIGNALED;
      if (!isCarriedOut && !gl.isContextLost()) {
        this.timer = setTimeout(look, kLook);
        return;
      }
      gl.deleteSync(fence);
      this.adapt(performance.now() - start);
      if (!isLast) {
        this.drawNext(frame, done);
        return;
      }
      this.frame = null;
      done();
    };
    this.timer = setTimeout(look, kLook);
  }

  private adapt(milliseconds: number): void {
    const factor = Math.min(2, Math.max(0.5, kGoal / milliseconds));
    this.budget = Math.min(kMost, Math.max(kLeast, Math.round(this.budget * factor)));
  }
}
