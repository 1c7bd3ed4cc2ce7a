/** The kinds of measures: how many places each takes, and the question to the database. */

import type { Hit, MeasureKind, MeasureState } from "./api";
import {
  angleOf,
  areaOf,
  arePlacesExact,
  distanceOf,
  faceAngleOf,
  faceAreaOf,
  objectDistanceOf,
  volumeOf,
} from "./statements";
import type { Question } from "./statements";

export interface MeasureInfo {
  readonly id: MeasureKind;
  readonly title: string;
  /** How many clicks it takes. */
  readonly picks: number;
  readonly hint: string;
  readonly unit: string;
  readonly ask: (hits: readonly Hit[]) => Question;
  /** Whether the points are those of the value and not rounded ones of the picture. */
  readonly isExact: (hits: readonly Hit[]) => boolean;
}

const always = (): boolean => true;

export const kMeasures: readonly MeasureInfo[] = [
  {
    id: "distance",
    title: "Distance of two points",
    picks: 2,
    hint: "Click two points.",
    unit: "",
    ask: ([a, b]) => distanceOf(a!, b!),
    isExact: arePlacesExact,
  },
  {
    id: "objects",
    title: "Distance of two objects",
    picks: 2,
    hint: "Click two objects.",
    unit: "",
    ask: ([a, b]) => objectDistanceOf(a!.cell, b!.cell),
    isExact: always,
  },
  {
    id: "angle",
    title: "Angle of three points",
    picks: 3,
    hint: "Click a point, the corner, another point.",
    unit: "°",
    ask: ([a, b, c]) => angleOf(a!, b!, c!),
    isExact: arePlacesExact,
  },
  {
    id: "faceAngle",
    title: "Angle of two faces",
    picks: 2,
    hint: "Click two faces: the angle of their normals.",
    unit: "°",
    ask: ([a, b]) => faceAngleOf(a!, b!),
    isExact: always,
  },
  {
    id: "faceArea",
    title: "Area of a triangle",
    picks: 1,
    hint: "Click a triangle.",
    unit: "",
    ask: ([a]) => faceAreaOf(a!),
    isExact: always,
  },
  {
    id: "area",
    title: "Area of an object",
    picks: 1,
    hint: "Click an object.",
    unit: "",
    ask: ([a]) => areaOf(a!.cell),
    isExact: always,
  },
  {
    id: "volume",
    title: "Volume of an object",
    picks: 1,
    hint: "Click a solid.",
    unit: "",
    ask: ([a]) => volumeOf(a!.cell),
    isExact: always,
  },
];

const kInfos = new Map(kMeasures.map((info) => [info.id, info]));

export function measureInfo(kind: MeasureKind): MeasureInfo {
  return kInfos.get(kind)!;
}

export function questionOf({ kind, hits }: MeasureState): Question {
  return measureInfo(kind).ask(hits);
}
