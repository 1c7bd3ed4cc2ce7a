/**
 * The canvas above the picture: axes, scale, labels, handles, markers of lights. It is drawn with each frame, in CSS
 * pixels, and becomes part of screenshots. It covers only the strip of the view in which something is drawn: where there
 * is no hardware, each pixel that the browser has to lay over the picture counts.
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

/** The strip begins and ends at multiples of so many CSS pixels, so that it seldom changes. */
const kStep = 64;

/** Something that lies between two heights of the view. */
interface Stroke {
  readonly top: number;
  readonly bottom: number;
  draw(context: CanvasRenderingContext2D): void;
}

export class Overlay {
  readonly canvas: HTMLCanvasElement;
  private readonly context: CanvasRenderingContext2D | null;
  private pixelRatio = 1;
  private strokes: Stroke[] = [];
  private strip = { top: 0, height: 0 };

  constructor(
    private readonly document: Document,
    private readonly projector: Projector,
  ) {
    this.canvas = this.document.createElement("canvas");
    this.canvas.setAttribute("aria-hidden", "true");
    Object.assign(this.canvas.style, { position: "absolute", left: "0", top: "0", pointerEvents: "none" });
    this.context = this.canvas.getContext("2d");
  }

  begin(pixelRatio: number): void {
    this.pixelRatio = pixelRatio;
    this.strokes = [];
  }

  /** An empty canvas is hidden: browsers may keep showing what was there if it is only cleared. */
  end(): void {
    this.canvas.style.visibility = this.strokes.length > 0 ? "" : "hidden";
    if (!this.context || this.strokes.length === 0) return;
    this.placeStrip();
    const { width } = this.projector.size;
    const { top, height } = this.strip;
    this.context.setTransform(this.pixelRatio, 0, 0, this.pixelRatio, 0, -top * this.pixelRatio);
    this.context.clearRect(0, top, width, height);
    for (const stroke of this.strokes) stroke.draw(this.context);
  }

  private placeStrip(): void {
    const { width, height } = this.projector.size;
    const first = this.strokes.reduce((least, { top }) => Math.min(least, top), height);
    const last = this.strokes.reduce((most, { bottom }) => Math.max(most, bottom), 0);
    const top = Math.max(0, Math.floor(first / kStep) * kStep);
    const bottom = Math.max(top + 1, Math.min(height, Math.ceil(last / kStep) * kStep));
    this.strip = { top, height: bottom - top };
    const [w, h] = [width, bottom - top].map((size) => Math.round(size * this.pixelRatio)) as [
      number,
      number,
    ];
    if (this.canvas.width !== w || this.canvas.height !== h) {
      this.canvas.width = w;
      this.canvas.height = h;
      this.canvas.style.width = `${width}px`;
      this.canvas.style.height = `${bottom - top}px`;
    }
    this.canvas.style.top = `${top}px`;
  }

  /** Copies what is drawn onto a picture of the view, of any size. */
  copyTo(context: CanvasRenderingContext2D, width: number, height: number): void {
    if (this.strokes.length === 0) return;
    const scale = height / this.projector.size.height;
    context.drawImage(this.canvas, 0, this.strip.top * scale, width, this.strip.height * scale);
  }

  private add(top: number, bottom: number, draw: Stroke["draw"]): void {
    const isInSight = bottom >= 0 && top <= this.projector.size.height;
    if (isInSight) this.strokes.push({ top, bottom, draw });
  }

  line(from: readonly [number, number], to: readonly [number, number], color: string, width = 1.5): void {
    this.add(Math.min(from[1], to[1]) - width, Math.max(from[1], to[1]) + width, (context) => {
      context.strokeStyle = color;
      context.lineWidth = width;
      context.lineCap = "round";
      context.beginPath();
      context.moveTo(...from);
      context.lineTo(...to);
      context.stroke();
    });
  }

  /** Between two places of the scene; nothing if one lies behind the eye. */
  segment(from: Vec3, to: Vec3, color: string, width = 1.5): void {
    const [a, b] = [this.projector.project(from), this.projector.project(to)];
    if (a.visible && b.visible) this.line([a.x, a.y], [b.x, b.y], color, width);
  }

  disc(x: number, y: number, radius: number, fill: string, border?: string): void {
    this.add(y - radius - 1, y + radius + 1, (context) => {
      context.beginPath();
      context.arc(x, y, radius, 0, 2 * Math.PI);
      context.fillStyle = fill;
      context.fill();
      if (!border) return;
      context.strokeStyle = border;
      context.lineWidth = 1.5;
      context.stroke();
    });
  }

  text(text: string, x: number, y: number, style: TextStyle): void {
    this.add(y - 11, y + 11, (context) => {
      context.font = `${style.bold ? "600 " : ""}12px system-ui, sans-serif`;
      context.textAlign = style.align ?? "center";
      context.textBaseline = "middle";
      if (style.plate) drawPlate(context, text, x, y, style);
      context.fillStyle = style.color;
      context.fillText(text, x, y);
    });
  }

  /** Text beside a place of the scene. */
  label(text: string, at: Vec3, style: TextStyle): ScreenPoint {
    const place = this.projector.project(at);
    if (place.visible) this.text(text, place.x, place.y - 14, style);
    return place;
  }
}

function drawPlate(
  context: CanvasRenderingContext2D,
  text: string,
  x: number,
  y: number,
  { align, plate = "" }: TextStyle,
): void {
  const width = context.measureText(text).width + 12;
  const left = align === "left" ? x - 6 : align === "right" ? x - width + 6 : x - width / 2;
  context.fillStyle = plate;
  context.beginPath();
  context.roundRect(left, y - 10, width, 20, 5);
  context.fill();
}
