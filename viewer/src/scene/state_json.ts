/** Reads the state of a view from JSON that may come from anyone, such as a link. */

import type { CellRef, MeasureState, ScenePatch, SceneState } from "./api";
import { isColor, kPaletteNames } from "./colors";
import { kMeasures, measureInfo } from "./measures";
import { kNavigationPresets } from "./navigation";

type Check = (value: unknown) => boolean;

const isBoolean: Check = (value) => typeof value === "boolean";
const isNumber =
  (min: number, max: number): Check =>
  (value) =>
    typeof value === "number" && value >= min && value <= max;
const isCount =
  (max: number): Check =>
  (value) =>
    Number.isInteger(value) && isNumber(0, max)(value);
const isOneOf =
  (...names: readonly unknown[]): Check =>
  (value) =>
    names.includes(value);
const isListOf =
  (check: Check, max: number): Check =>
  (value) =>
    Array.isArray(value) && value.length <= max && value.every(check);
const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const isVec3: Check = (value) =>
  Array.isArray(value) &&
  value.length === 3 &&
  value.every((x) => typeof x === "number" && Number.isFinite(x));
const isDirection: Check = (value) => isVec3(value) && (value as number[]).some((x) => x !== 0);
const kAnyNumber = isNumber(-Number.MAX_VALUE, Number.MAX_VALUE);
const kPositive = isNumber(Number.MIN_VALUE, Number.MAX_VALUE);

const hasFields =
  (fields: Readonly<Record<string, Check>>, optional: Readonly<Record<string, Check>> = {}): Check =>
  (value) =>
    isRecord(value) &&
    Object.entries(fields).every(([key, check]) => check(value[key])) &&
    Object.entries(optional).every(([key, check]) => value[key] === undefined || check(value[key]));

const kLight = { on: isBoolean, color: isColor, brightness: isNumber(0, 100) };

const isScheme: Check = (value) =>
  hasFields({ by: isOneOf("one", "position", "elements") })(value) ||
  hasFields({ by: isOneOf("gradient"), from: isColor, to: isColor })(value) ||
  hasFields({
    by: isOneOf("attribute"),
    attribute: (name) => typeof name === "string",
    palette: isOneOf(...kPaletteNames),
  })(value);

export const isCell = hasFields({
  result: (name) => typeof name === "string",
  row: (row) => Number.isSafeInteger(row) && (row as number) >= 0,
  column: (name) => typeof name === "string",
}) as (value: unknown) => value is CellRef;

const isNullOr =
  (check: Check): Check =>
  (value) =>
    value === null || check(value);
const isTriple =
  (check: Check): Check =>
  (value) =>
    Array.isArray(value) && value.length === 3 && value.every(check);
const kId = isNullOr(isCount(Number.MAX_SAFE_INTEGER));

/** Numbers of vertices and faces become parts of statements. */
const isHit = hasFields({
  cell: isCell,
  point: isVec3,
  snap: isOneOf("vertex", "edge", "face", "point"),
  face: kId,
  vertex: kId,
  triangle: isNullOr(
    hasFields({ corners: isTriple(isVec3), ids: isTriple(kId), normal: isVec3, area: kAnyNumber }),
  ),
  edge: isNullOr((value) => Array.isArray(value) && value.length === 2 && value.every(isVec3)),
  deviation: isNumber(0, Number.MAX_VALUE),
});

const isMeasureKind = isOneOf(...kMeasures.map(({ id }) => id));
const isMeasure: Check = (value) =>
  hasFields({ id: isCount(Number.MAX_SAFE_INTEGER), kind: isMeasureKind, hits: isListOf(isHit, 3) })(value) &&
  measureInfo((value as MeasureState).kind).picks === (value as MeasureState).hits.length;

const kFields: Readonly<Record<Exclude<keyof SceneState, "overrides">, Readonly<Record<string, Check>>>> = {
  camera: {
    projection: isOneOf("perspective", "orthographic"),
    target: isVec3,
    rest: isVec3,
    direction: isDirection,
    up: isDirection,
    height: kPositive,
  },
  navigation: {
    preset: isOneOf(...kNavigationPresets.map((preset) => preset.id)),
    rotationSpeed: isNumber(0.05, 20),
    panSpeed: isNumber(0.05, 20),
    zoomSpeed: isNumber(0.05, 20),
    invertWheel: isBoolean,
    zoomToPointer: isBoolean,
    orbit: isOneOf("turntable", "trackball"),
  },
  appearance: {
    faces: isBoolean,
    vertices: isBoolean,
    edges: isOneOf("none", "features", "all"),
    shading: isOneOf("smooth", "flat", "unlit"),
    opacity: isNumber(0, 1),
    color: isColor,
    edgeColor: isNullOr(isColor),
    pointSize: isNumber(1, 100),
    scheme: isScheme,
    background: (value) => value === null || isColor(value),
  },
  lights: {
    global: hasFields(kLight),
    lights: isListOf(hasFields({ ...kLight, id: kAnyNumber, position: isVec3, reach: kPositive }), 32),
  },
  section: {
    on: isBoolean,
    point: isVec3,
    normal: isDirection,
    cap: isOneOf("preview", "exact"),
    capColor: isColor,
    plane: isBoolean,
  },
  display: {
    axes: isBoolean,
    grid: isBoolean,
    scaleBar: isBoolean,
    boxes: isBoolean,
    boundary: isBoolean,
    nonManifold: isBoolean,
    legend: isBoolean,
    arrangement: isOneOf("place", "grid", "exploded"),
    explode: isNumber(0, 100),
    sortBy: (name) => typeof name === "string",
    descending: isBoolean,
  },
  tools: {
    tool: isOneOf("select", "measure", "inspect"),
    snapVertices: isBoolean,
    snapEdges: isBoolean,
    kind: isMeasureKind,
    measures: isListOf(isMeasure, 1000),
    inspected: (value) => value === null || isHit(value),
  },
  focus: {
    hidden: isListOf(isCell, 100_000),
    cells: isListOf(isCell, 100_000),
    others: isOneOf("ghosted", "hidden"),
  },
  // The name becomes a part of a statement.
  index: {
    name: (value) => typeof value === "string" && /^(?:[A-Za-z]\w*)?$/.test(value),
    level: isCount(64),
  },
};

const isOverride = hasFields(
  { cell: isCell },
  { color: isColor, pointSize: isNumber(1, 100), opacity: isNumber(0, 1) },
);

/** Links of former versions have the position of the eye in place of its direction. */
function withDirection(camera: unknown): unknown {
  if (!isRecord(camera) || !isVec3(camera["position"]) || !isVec3(camera["target"])) return camera;
  const { position, ...others } = camera as { position: number[]; target: number[] };
  const direction = position.map((part, axis) => part - others.target[axis]!);
  return { direction, rest: [0, 0, 0], ...others };
}

/** Links of former versions explode by a number alone. */
function withArrangement(display: unknown): unknown {
  if (!isRecord(display) || display["arrangement"] !== undefined || !display["explode"]) return display;
  return { ...display, arrangement: "exploded" };
}

/** What links of former versions have otherwise. */
const kFormer: Readonly<Record<string, (given: unknown) => unknown>> = {
  camera: withDirection,
  display: withArrangement,
};

/** The fields that are understood, as a patch, and the names of those that are not. */
export function stateFromJson(json: unknown): { patch: ScenePatch; rejected: string[] } {
  const rejected: string[] = [];
  if (!isRecord(json)) return { patch: {}, rejected: ["the whole view"] };
  const patch: Record<string, unknown> = {};
  for (const [part, given] of Object.entries(json)) {
    const value = Object.hasOwn(kFormer, part) ? kFormer[part]!(given) : given;
    if (part === "overrides") {
      if (isListOf(isOverride, 100_000)(value)) patch[part] = value;
      else rejected.push(part);
      continue;
    }
    const fields = Object.hasOwn(kFields, part) ? kFields[part as keyof typeof kFields] : undefined;
    if (!fields || !isRecord(value)) {
      rejected.push(part);
      continue;
    }
    const accepted = Object.entries(value).filter(([key, field]) => {
      const known = Object.hasOwn(fields, key) && fields[key]!(field);
      if (!known) rejected.push(`${part}.${key}`);
      return known;
    });
    patch[part] = Object.fromEntries(accepted);
  }
  return { patch, rejected };
}
