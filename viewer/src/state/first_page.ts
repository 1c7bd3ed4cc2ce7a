/** What a page shows before anything was run: the largest relation with geometry, and statements to begin with. */

import type { DatabaseObject } from "../api/types";
import { attributesOf } from "./types";

/** Rows of a contact sheet. */
const mostRows = 1000;

/** A statement to click. */
export interface Example {
  readonly title: string;
  readonly statement: string;
}

/** The relation with geometry that has the most tuples; null if there is none. */
export function largestRelation(objects: readonly DatabaseObject[]): DatabaseObject | null {
  const relations = objects.filter(
    ({ kind, shape, count }) => kind === "relation" && shape && (count ?? 0) > 0,
  );
  return relations.reduce<DatabaseObject | null>(
    (largest, each) => ((each.count ?? 0) > (largest?.count ?? 0) ? each : largest),
    null,
  );
}

/** The statement that shows a relation, or its beginning if it is large. */
export function sheetStatement({ name, count }: DatabaseObject): string {
  return (count ?? 0) > mostRows ? `query ${name} feed head[${mostRows}] consume` : `query ${name}`;
}

/** Three statements that say something about what is in the database. */
export function examplesOf(objects: readonly DatabaseObject[], readOnly: boolean): readonly Example[] {
  const relation = largestRelation(objects);
  const solid = relation && attributesOf(relation.type)?.find(({ type }) => type === "volume3d")?.name;
  if (relation && solid) return ofRelation(relation.name, solid);
  const volume = objects.find(
    ({ kind, type, hasValue }) => kind === "value" && type === "volume3d" && hasValue,
  );
  if (volume) return ofSolid(volume.name);
  return withoutObjects(readOnly);
}

const ofRelation = (name: string, solid: string): readonly Example[] => [
  {
    title: "The heaviest first",
    statement: `query ${name} feed extend[Volume: volume(.${solid})] sortby[Volume desc] consume`,
  },
  {
    title: "Over 1,000 triangles",
    statement: `query ${name} feed filter[size(.${solid}) > 1000] consume`,
  },
  {
    title: "Volume and area",
    statement: `query ${name} feed projectextend[; Volume: volume(.${solid}), Area: area(.${solid})] consume`,
  },
];

const ofSolid = (name: string): readonly Example[] => [
  { title: `The volume of ${name}`, statement: `query volume(${name})` },
  {
    title: `${name}, turned by 30°`,
    statement: `query ${name} rotate[makePoint3D(0, 0, 0), makeVector3D(0, 0, 1), 30.0]`,
  },
  { title: `${name} as a mesh, subdivided`, statement: `query subdivide(volume2mesh(${name}), "loop", 1)` },
];

const kDrilled =
  "createCube(makePoint3D(0, 0, 0), makePoint3D(4, 4, 2)) minus createCylinder(makePoint3D(2, 2, -1), 1, 4, 48)";

const withoutObjects = (readOnly: boolean): readonly Example[] => [
  readOnly
    ? { title: "A sample: a plate with a hole", statement: `query ${kDrilled}` }
    : { title: "Store a sample: a plate with a hole", statement: `let Sample = ${kDrilled}` },
  { title: "A ball", statement: "query createSphere(makePoint3D(0, 0, 0), 1, 24)" },
  {
    title: "Ten cubes in a row, with their volumes",
    statement:
      "query intstream(1, 10) transformstream extend[Solid: createCube(makePoint3D(3 * .Elem, 0, 0), makePoint3D(3 * .Elem + 2, 2, 0.2 * .Elem))] extend[Volume: volume(.Solid)] consume",
  },
];
