/** Colours of objects: palettes, gradients, and scales over the values of an attribute. */

import type { AttributeValue, Color, Legend, PaletteName } from "./api";

type Rgb = readonly [number, number, number];

export function parseColor(color: Color): Rgb {
  const value = Number.parseInt(color.slice(1), 16);
  return [(value >> 16) & 255, (value >> 8) & 255, value & 255];
}

export function formatColor([r, g, b]: Rgb): Color {
  const hex = (value: number): string =>
    Math.min(255, Math.max(0, Math.round(value)))
      .toString(16)
      .padStart(2, "0");
  return `#${hex(r)}${hex(g)}${hex(b)}`;
}

export function isColor(text: unknown): text is Color {
  return typeof text === "string" && /^#[0-9a-f]{6}$/i.test(text);
}

/** Between two colours, for `part` from 0 to 1. */
export function mix(from: Color, to: Color, part: number): Color {
  const [a, b] = [parseColor(from), parseColor(to)];
  const at = (i: 0 | 1 | 2): number => a[i] + (b[i] - a[i]) * part;
  return formatColor([at(0), at(1), at(2)]);
}

/** Sources of the first four: matplotlib's colour maps viridis, cividis, magma and coolwarm at equal steps. */
const kPalettes: Readonly<Record<PaletteName, readonly Color[]>> = {
  viridis: [
    "#440154",
    "#472d7b",
    "#3b528b",
    "#2c728e",
    "#21918c",
    "#28ae80",
    "#5ec962",
    "#addc30",
    "#fde725",
  ],
  cividis: [
    "#00224e",
    "#123570",
    "#3b496c",
    "#575d6d",
    "#707173",
    "#8a8678",
    "#a59c74",
    "#c3b369",
    "#fee838",
  ],
  magma: ["#000004", "#1c1044", "#4f127b", "#812581", "#b5367a", "#e55064", "#fb8761", "#fec287", "#fcfdbf"],
  coolwarm: [
    "#3b4cc0",
    "#6282ea",
    "#8db0fe",
    "#b8d0f9",
    "#dddddd",
    "#f5c4ad",
    "#f49a7b",
    "#de604d",
    "#b40426",
  ],
  greys: ["#2b2b2b", "#e8e8e8"],
};

export const kPaletteNames = Object.keys(kPalettes) as PaletteName[];

export function paletteStops(name: PaletteName): readonly Color[] {
  return kPalettes[name];
}

/** The colour of a palette at `part` from 0 to 1. */
export function paletteColor(name: PaletteName, part: number): Color {
  const stops = kPalettes[name];
  const place = Math.min(1, Math.max(0, part)) * (stops.length - 1);
  const index = Math.min(stops.length - 2, Math.floor(place));
  return mix(stops[index]!, stops[index + 1]!, place - index);
}

/**
 * Twelve colours that are distinguished also by most people with colour vision deficiencies, then the same lighter and
 * darker. Source of the first eight: Okabe and Ito, Color universal design, 2008 (black replaced by grey).
 */
const kCategories: readonly Color[] = [
  "#0072b2",
  "#e69f00",
  "#009e73",
  "#d55e00",
  "#56b4e9",
  "#cc79a7",
  "#f0e442",
  "#7f7f7f",
  "#8c564b",
  "#7b4fb5",
  "#a6c34c",
  "#17869b",
];

export function categoryColor(index: number): Color {
  const base = kCategories[index % kCategories.length]!;
  const round = Math.floor(index / kCategories.length);
  if (round === 0) return base;
  return round % 2 === 1 ? mix(base, "#ffffff", 0.45) : mix(base, "#000000", 0.4);
}

/** More categories than this share one colour, "others". */
const kMaxCategories = 36;
export const kOtherColor: Color = "#b8b8b8";
export const kUndefinedColor: Color = "#d9d9d9";

/** A legend, and the colour of each value that it explains. */
export interface ColorScale {
  readonly legend: Legend;
  readonly color: (value: AttributeValue) => Color;
}

/** A gradient if all values are numbers (or undefined), else a colour for each different value, the most frequent first. */
export function scaleOf(
  attribute: string,
  palette: PaletteName,
  values: readonly AttributeValue[],
): ColorScale {
  const defined = values.filter((value) => value !== null);
  const numbers = defined.filter((value) => typeof value === "number" && Number.isFinite(value)) as number[];
  if (numbers.length > 0 && numbers.length === defined.length) {
    return numberScale(attribute, palette, numbers, values.length - numbers.length);
  }
  return categoryScale(attribute, values);
}

function numberScale(
  attribute: string,
  palette: PaletteName,
  numbers: readonly number[],
  missing: number,
): ColorScale {
  let [min, max] = [Infinity, -Infinity];
  for (const value of numbers) {
    min = Math.min(min, value);
    max = Math.max(max, value);
  }
  const color = (value: AttributeValue): Color => {
    if (typeof value !== "number") return kUndefinedColor;
    return paletteColor(palette, max > min ? (value - min) / (max - min) : 0.5);
  };
  const stops = paletteStops(palette);
  return { legend: { kind: "numbers", attribute, min, max, stops, undefinedCount: missing }, color };
}

function categoryScale(attribute: string, values: readonly AttributeValue[]): ColorScale {
  const counts = new Map<string, number>();
  let missing = 0;
  for (const value of values) {
    if (value === null) missing++;
    else counts.set(label(value), (counts.get(label(value)) ?? 0) + 1);
  }
  const sorted = [...counts].sort((a, b) => b[1] - a[1] || a[0].localeCompare(b[0], "en", { numeric: true }));
  const shown = sorted.slice(0, kMaxCategories);
  const colors = new Map(shown.map(([name], index) => [name, categoryColor(index)]));
  const entries = shown.map(([name, count]) => ({ label: name, color: colors.get(name)!, count }));
  if (missing > 0) entries.push({ label: "undefined", color: kUndefinedColor, count: missing });
  const others = sorted.slice(kMaxCategories).reduce((sum, [, count]) => sum + count, 0);
  const color = (value: AttributeValue): Color =>
    value === null ? kUndefinedColor : (colors.get(label(value)) ?? kOtherColor);
  return { legend: { kind: "categories", attribute, entries, others }, color };
}

function label(value: number | string | boolean): string {
  if (typeof value === "boolean") return value ? "TRUE" : "FALSE";
  return String(value);
}
