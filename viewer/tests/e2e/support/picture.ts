import { inflateSync } from "node:zlib";

export type Rgb = readonly [number, number, number];

/** Pixels of a screenshot. */
export interface Picture {
  readonly width: number;
  readonly height: number;
  at(x: number, y: number): Rgb;
  /** Pixels for which the test is true. */
  count(test: (color: Rgb) => boolean): number;
  /** Number of different colours. */
  colors(): number;
  /** Share of the pixels that differ from those of a picture of the same size by more than a little. */
  difference(other: Picture): number;
}

/** Reads a PNG of 8 bits with or without alpha and without interlacing, as browsers write screenshots. */
export function readPng(bytes: Buffer): Picture {
  const width = bytes.readUInt32BE(16);
  const height = bytes.readUInt32BE(20);
  const [depth, colorType, , , interlaced] = bytes.subarray(24, 29);
  if (depth !== 8 || (colorType !== 2 && colorType !== 6) || interlaced !== 0)
    throw new Error(
      `PNG of depth ${depth ?? 0}, colour type ${colorType ?? 0}: expected 8 and 2 or 6, not interlaced`,
    );
  const channels = colorType === 6 ? 4 : 3;
  const pixels = unfilter(inflateSync(imageData(bytes)), width, height, channels);
  return makePicture(pixels, width, height, channels);
}

function imageData(bytes: Buffer): Buffer {
  const parts: Buffer[] = [];
  for (let at = 8; at < bytes.length;) {
    const length = bytes.readUInt32BE(at);
    if (bytes.toString("latin1", at + 4, at + 8) === "IDAT")
      parts.push(bytes.subarray(at + 8, at + 8 + length));
    at += 12 + length;
  }
  return Buffer.concat(parts);
}

/** Undoes the five filters of PNG. */
function unfilter(data: Buffer, width: number, height: number, channels: number): Uint8Array {
  const stride = width * channels;
  const pixels = new Uint8Array(stride * height);
  for (let y = 0; y < height; y++) {
    const filter = data[y * (stride + 1)] ?? 0;
    for (let x = 0; x < stride; x++) {
      const left = x >= channels ? (pixels[y * stride + x - channels] ?? 0) : 0;
      const up = y > 0 ? (pixels[(y - 1) * stride + x] ?? 0) : 0;
      const corner = x >= channels && y > 0 ? (pixels[(y - 1) * stride + x - channels] ?? 0) : 0;
      const raw = data[y * (stride + 1) + 1 + x] ?? 0;
      const predicted = [0, left, up, (left + up) >> 1, paeth(left, up, corner)][filter] ?? 0;
      pixels[y * stride + x] = raw + predicted;
    }
  }
  return pixels;
}

function paeth(left: number, up: number, corner: number): number {
  const estimate = left + up - corner;
  const [a, b, c] = [Math.abs(estimate - left), Math.abs(estimate - up), Math.abs(estimate - corner)];
  if (a <= b && a <= c) return left;
  return b <= c ? up : corner;
}

function makePicture(pixels: Uint8Array, width: number, height: number, channels: number): Picture {
  const colorAt = (index: number): Rgb => [
    pixels[index * channels] ?? 0,
    pixels[index * channels + 1] ?? 0,
    pixels[index * channels + 2] ?? 0,
  ];
  const size = width * height;
  return {
    width,
    height,
    at: (x, y) => colorAt(Math.round(y) * width + Math.round(x)),
    count: (test) => {
      let found = 0;
      for (let index = 0; index < size; index++) if (test(colorAt(index))) found++;
      return found;
    },
    colors: () => {
      const seen = new Set<number>();
      for (let index = 0; index < size; index++) {
        const [red, green, blue] = colorAt(index);
        seen.add((red << 16) | (green << 8) | blue);
      }
      return seen.size;
    },
    difference: (other) => {
      if (other.width !== width || other.height !== height) return 1;
      let differing = 0;
      for (let y = 0; y < height; y++)
        for (let x = 0; x < width; x++) {
          const [a, b] = [colorAt(y * width + x), other.at(x, y)];
          if (Math.abs(a[0] - b[0]) + Math.abs(a[1] - b[1]) + Math.abs(a[2] - b[2]) > 24) differing++;
        }
      return differing / size;
    },
  };
}

/** Whether a colour is near another one, by the largest difference of its channels. */
export function isNear(color: Rgb, other: Rgb, distance = 24): boolean {
  return color.every((channel, index) => Math.abs(channel - (other[index] ?? 0)) <= distance);
}

/** The topmost and rightmost place of a scene that differs from its ground. */
export function topRight(picture: Picture): { x: number; y: number } {
  const ground = picture.at(4, 4);
  const isObject = (x: number, y: number) =>
    picture.at(x, y).some((part, i) => Math.abs(part - ground[i]!) > 40);
  const { width, height } = picture;
  const rows = Array.from({ length: height - 120 }, (_, i) => i + 60); // without toolbar and axes
  const inside = (y: number) =>
    Array.from({ length: width - 200 }, (_, i) => i + 100).filter((x) => isObject(x, y));
  const y = rows.find((row) => inside(row).length > width / 8) ?? 0;
  return { x: Math.max(...inside(y)), y };
}

/** Whether anything reaches the left or the right side of a scene, between the controls and the scale. */
export function touchesSides(picture: Picture): boolean {
  const rows = Array.from({ length: picture.height - 200 }, (_, i) => i + 120);
  const isGround = (x: number, y: number) =>
    picture.at(x, y).every((part, i) => Math.abs(part - picture.at(4, 4)[i]!) < 12);
  return rows.some((y) => !isGround(1, y) || !isGround(picture.width - 2, y));
}
