/** The statements that ask the database for cuts and measures of what was pointed at. Coordinates are written in full. */

import type { CellRef, Hit, Parameter, Vec3 } from "./api";
import { normalized } from "./vec";

export interface Question {
  readonly statement: string;
  readonly parameters: Readonly<Record<string, Parameter>>;
}

function numbers(v: Vec3): string {
  return v.map(String).join(", ");
}

function pointText(v: Vec3): string {
  return `makePoint3D(${numbers(v)})`;
}

function vectorText(v: Vec3): string {
  return `makeVector3D(${numbers(v)})`;
}

// Sections -----------------------------------------------------------------------------------------------------

export interface CutPlane {
  readonly point: Vec3;
  readonly normal: Vec3;
}

/** The part of the plane inside the solid, as a surface. */
export function sectionOf(cell: CellRef, { point, normal }: CutPlane): Question {
  return {
    statement: `query section($v, makePlane3D(${pointText(point)}, ${vectorText(normal)}))`,
    parameters: { v: cell },
  };
}

export function sectionAreaOf(cell: CellRef, { point, normal }: CutPlane): Question {
  return {
    statement: `query area(section($v, makePlane3D(${pointText(point)}, ${vectorText(normal)})))`,
    parameters: { v: cell },
  };
}

/** Whether the cut along this plane is turned into the horizontal exactly: its normal is along an axis. */
export function isRegionExact(normal: Vec3): boolean {
  return normalized(normal).filter((part) => Math.abs(part) === 1).length === 1;
}

/** The directions of space that become the axes x and y of the region. */
export function regionAxes(normal: Vec3): readonly [Vec3, Vec3] {
  const n = normalized(normal);
  const sine = Math.hypot(n[0], n[1]);
  if (sine === 0) return n[2] > 0 ? [kX, kY] : [kX, [0, -1, 0]];
  // The inverse of the turn about n x z that takes n to z, by Rodrigues' formula.
  const axis: Vec3 = [n[1] / sine, -n[0] / sine, 0];
  const back = (vector: Vec3): Vec3 => {
    const along = vector[0] * axis[0] + vector[1] * axis[1];
    const across = [axis[1] * vector[2], -axis[0] * vector[2], axis[0] * vector[1] - axis[1] * vector[0]];
    return [0, 1, 2].map(
      (i) => vector[i]! * n[2] - across[i]! * sine + axis[i]! * along * (1 - n[2]) + 0,
    ) as unknown as Vec3;
  };
  return [back(kX), back(kY)];
}

const kX: Vec3 = [1, 0, 0];
const kY: Vec3 = [0, 1, 0];

/**
 * The cut as a region: the solid is turned about the point until the normal points upwards, and sliced at the height of
 * the point. Exact for normals along an axis; other angles are within 2^-50 rad.
 */
export function regionOf(cell: CellRef, { point, normal }: CutPlane): Question {
  const n = normalized(normal);
  const sine = Math.hypot(n[0], n[1]);
  const height = String(point[2]);
  const parameters = { v: cell };
  if (sine === 0 && n[2] > 0) return { statement: `query slice($v, ${height})`, parameters };
  // The axis is n x z; for a normal straight down any horizontal axis will do.
  const axis: Vec3 = sine === 0 ? [1, 0, 0] : [n[1] + 0, 0 - n[0], 0];
  const degrees = n[2] === 0 ? 90 : sine === 0 ? 180 : (Math.atan2(sine, n[2]) * 180) / Math.PI;
  return {
    statement: `query slice($v rotate[${pointText(point)}, ${vectorText(axis)}, ${degrees}], ${height})`,
    parameters,
  };
}

// Measures -----------------------------------------------------------------------------------------------------

/** A place as an expression: exact for a vertex whose number is known, else its rounded coordinates. */
function placeText(
  hit: Hit,
  name: string,
): { text: string; parameters: Question["parameters"]; exact: boolean } {
  if (hit.snap === "vertex" && hit.vertex !== null) {
    return {
      text: `(vertices($${name}) filter[.Id = ${hit.vertex}] extract[Position])`,
      parameters: { [name]: hit.cell },
      exact: true,
    };
  }
  return { text: pointText(hit.point), parameters: {}, exact: false };
}

/** Whether a measure of these places is one of the value, and not of rounded points of the picture. */
export function arePlacesExact(hits: readonly Hit[]): boolean {
  return hits.every((hit) => hit.snap === "vertex" && hit.vertex !== null);
}

export function distanceOf(from: Hit, to: Hit): Question {
  const [a, b] = [placeText(from, "a"), placeText(to, "b")];
  return {
    statement: `query distance(${a.text}, ${b.text})`,
    parameters: { ...a.parameters, ...b.parameters },
  };
}

/** The angle at `corner` between the directions to the other two, in degrees. */
export function angleOf(from: Hit, corner: Hit, to: Hit): Question {
  const [a, b, c] = [placeText(from, "a"), placeText(corner, "b"), placeText(to, "c")];
  const u = `makeVector3D(${b.text}, ${a.text})`;
  const v = `makeVector3D(${b.text}, ${c.text})`;
  return {
    statement: `query rad2deg(atan2(length(cross(${u}, ${v})), dot(${u}, ${v})))`,
    parameters: { ...a.parameters, ...b.parameters, ...c.parameters },
  };
}

function faceText(hit: Hit, name: string, attribute: string): string {
  return `(faces($${name}) filter[.Id = ${hit.face ?? -1}] extract[${attribute}])`;
}

/** The angle between the normals of two faces, in degrees. */
export function faceAngleOf(first: Hit, second: Hit): Question {
  const [u, v] = [faceText(first, "a", "Normal"), faceText(second, "b", "Normal")];
  return {
    statement: `query rad2deg(atan2(length(cross(${u}, ${v})), dot(${u}, ${v})))`,
    parameters: { a: first.cell, b: second.cell },
  };
}

export function faceAreaOf(hit: Hit): Question {
  return { statement: `query ${faceText(hit, "a", "Area").slice(1, -1)}`, parameters: { a: hit.cell } };
}

export function objectDistanceOf(a: CellRef, b: CellRef): Question {
  return { statement: "query distance($a, $b)", parameters: { a, b } };
}

export function areaOf(a: CellRef): Question {
  return { statement: "query area($a)", parameters: { a } };
}

export function volumeOf(a: CellRef): Question {
  return { statement: "query volume($a)", parameters: { a } };
}

export function componentsOf(v: CellRef): Question {
  return { statement: "query components($v) namedtransformstream[Part] consume", parameters: { v } };
}
