/**
 * The canvas above the picture: axes, scale, labels, handles, markers of lights. It is drawn with each frame, in CSS
 * pixels, and becomes part of screenshots.
 */

import type { Vec3 } from "./api";
import type { Projector, ScreenPoint } from "./projection";

export interface TextStyle {
  readonly color: string;
  readonly align?: CanvasTextAlign;
  /** Behind the text, for labels on objects. */
  readonly plate?: string;
  readonly bold?: boolean;
}

export class Overlay {
  readonly canvas: HTMLCanvasElement;
  private readonly context: CanvasRenderingContext2D | null;
  private drawn = false;

  constructor(
    private readonly document: Document,
    private readonly projector: Projector,
  ) {
    this.canvas = this.document.createElement("canvas");
    this.canvas.setAttribute("aria-hidden", "true");
    Object.assign(this.canvas.style, { position: "absolute", inset: "0", pointerEvents: "none" });
    this.context = this.canvas.getContext("2d");
  }

  begin(pixelRatio: number): void {
    this.drawn = false;
    const { width, height } = this.projector.size;
    const [w, h] = [Math.round(width * pixelRatio), Math.round(height * pixelRatio)];
    if (this.canvas.width !== w || this.canvas.height !== h) {
      this.canvas.width = w;
      this.canvas.height = h;
      this.canvas.style.width = `${width}px`;
      this.canvas.style.height = `${height}px`;
    }
    this.context?.setTransform(pixelRatio, 0, 0, pixelRatio, 0, 0);
    this.context?.clearRect(0, 0, width, height);
  }

  /** An empty canvas is hidden: browsers may keep showing what was there if it is only cleared. */
  end(): void {
    this.canvas.style.visibility = this.drawn ? "" : "hidden";
  }

  line(from: readonly [number, number], to: readonly [number, number], color: string, width = 1.5): void {
    const context = this.context;
    if (!context) return;
    this.drawn = true;
    context.strokeStyle = color;
    context.lineWidth = width;
    context.lineCap = "round";
    context.beginPath();
    context.moveTo(...from);
    context.lineTo(...to);
    context.stroke();
  }

  /** Between two places of the scene; nothing if one lies behind the eye. */
  segment(from: Vec3, to: Vec3, color: string, width = 1.5): void {
    const [a, b] = [this.projector.project(from), this.projector.project(to)];
    if (a.visible && b.visible) this.line([a.x, a.y], [b.x, b.y], color, width);
  }

  disc(x: number, y: number, radius: number, fill: string, border?: string): void {
    const context = this.context;
    if (!context) return;
    this.drawn = true;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fillStyle = fill;
    context.fill();
    if (!border) return;
    context.strokeStyle = border;
    context.lineWidth = 1.5;
    context.stroke();
  }

  text(text: string, x: number, y: number, style: TextStyle): void {
    const context = this.context;
    if (!context) return;
    this.drawn = true;
    context.font = `${style.bold ? "600 " : ""}12px system-ui, sans-serif`;
    context.textAlign = style.align ?? "center";
    context.textBaseline = "middle";
    if (style.plate) {
      const width = context.measureText(text).width + 12;
      const left = style.align === "left" ? x - 6 : style.align === "right" ? x - width + 6 : x - width / 2;
      context.fillStyle = style.plate;
      context.beginPath();
      context.roundRect(left, y - 10, width, 20, 5);
      context.fill();
    }
    context.fillStyle = style.color;
    context.fillText(text, x, y);
  }

  /** Text beside a place of the scene. */
  label(text: string, at: Vec3, style: TextStyle): ScreenPoint {
    const place = this.projector.project(at);
    if (place.visible) this.text(text, place.x, place.y - 14, style);
    return place;
  }
}
