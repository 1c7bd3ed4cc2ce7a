/** The operations of the split screen, written as expressions of the query language. */

import type { Transformation } from "../scene/api";
import { subdivisionSchemes } from "./subdivision_schemes";

export const meshTypes = ["volume3d", "surface3d", "mesh3d"] as const;
export type MeshType = (typeof meshTypes)[number];

export const isMeshType = (type: string): type is MeshType => (meshTypes as readonly string[]).includes(type);

type SchemeDescription = (typeof subdivisionSchemes)[number];
export type Scheme = SchemeDescription["name"];
export const schemes: readonly Scheme[] = subdivisionSchemes.map(({ name }) => name);

/** Schemes that have a limit position of vertices. */
export type LimitScheme = Extract<SchemeDescription, { hasLimit: true }>["name"];
export const isLimitScheme = (scheme: Scheme): scheme is LimitScheme => described(scheme).hasLimit;
export const limitSchemes: readonly LimitScheme[] = schemes.filter(isLimitScheme);

/** The variants of a scheme, of which the first is the default; none if there is one only. */
export const variantsOf = (scheme: Scheme): readonly string[] => described(scheme).variants;

function described(scheme: Scheme): SchemeDescription {
  return subdivisionSchemes.find(({ name }) => name === scheme) ?? subdivisionSchemes[0];
}

export const setOperations = ["union", "intersection", "minus", "either"] as const;
export type SetOperation = (typeof setOperations)[number];

/** An expression in `$a`, and `$b` if it takes the mesh of the other side. */
export interface Operation {
  readonly label: string;
  readonly expression: string;
  readonly needsOther: boolean;
}

const needsTriangles = (scheme: Scheme) => described(scheme).takesTrianglesOnly;

/** The last argument for a variant, which the default does not need. */
function variantArgument(scheme: Scheme, variant: string): string {
  return variant === "" || variant === variantsOf(scheme)[0] ? "" : `, "${variant}"`;
}

/** `$a` as a mesh3d; of triangles, or of the polygons that they make. */
function asMesh(type: MeshType, triangles: boolean): string {
  if (type === "mesh3d") return triangles ? "triangulate($a)" : "$a";
  const convert = type === "volume3d" ? "volume2mesh" : "surface2mesh";
  return triangles ? `${convert}($a)` : `${convert}($a, TRUE)`;
}

const asVolume = (name: string, type: MeshType) => (type === "mesh3d" ? `mesh2volume(${name})` : name);

/** One step of a scheme; schemes for any polygons see those that the triangles of a solid make. */
export function subdivision(type: MeshType, scheme: Scheme, variant = ""): Operation {
  const mesh = asMesh(type, needsTriangles(scheme));
  const argument = variantArgument(scheme, variant);
  return {
    label: argument === "" ? `subdivide ${scheme}` : `subdivide ${scheme}, ${variant}`,
    expression: `subdivide(${mesh}, "${scheme}", 1${argument})`,
    needsOther: false,
  };
}

/** The limit surface: the mesh after some steps, with each vertex where the scheme has it in the end. */
export function limit(type: MeshType, scheme: LimitScheme, steps: number, variant = ""): Operation {
  const mesh = asMesh(type, needsTriangles(scheme));
  const argument = variantArgument(scheme, variant);
  const expression = `limitPosition(subdivide(${mesh}, "${scheme}", ${steps}${argument}), "${scheme}"${argument})`;
  return { label: `limit of ${scheme}`, expression, needsOther: false };
}

/** Fewer triangles: a share of them, 0 to 1. */
export function simplification(type: MeshType, share: number): Operation {
  const mesh = type === "mesh3d" ? "triangulate($a)" : "$a";
  return {
    label: `simplify to ${Math.round(share * 100)} %`,
    expression: `simplify(${mesh}, "ratio", ${real(share)})`,
    needsOther: false,
  };
}

export function dual(type: MeshType): Operation {
  return { label: "dual", expression: `dual(${asMesh(type, false)})`, needsOther: false };
}

export function setOperation(operation: SetOperation, type: MeshType, other: MeshType): Operation {
  const a = asVolume("$a", type);
  const b = asVolume("$b", other);
  const expressions: Readonly<Record<SetOperation, string>> = {
    union: `(${a}) union (${b})`,
    intersection: `intersection(${a}, ${b})`,
    minus: `(${a}) minus (${b})`,
    // What is in one of them only.
    either: `symmetricDifference(${a}, ${b})`,
  };
  const label = operation === "either" ? "symmetric difference" : operation;
  return { label: `${label} with the other side`, expression: expressions[operation], needsOther: true };
}

/** Faces of more than three corners become triangles; a mesh of a solid or surface consists of triangles. */
export function triangulation(type: MeshType): Operation {
  return { label: "triangulate", expression: asMesh(type, true), needsOther: false };
}

type Triple = readonly [number, number, number];
const constant = (type: "point3d" | "vector3d", numbers: Triple) =>
  `[const ${type} value (${numbers.map(coordinate).join(" ")})]`;

/** An affine map of a mesh of any type. */
export function transformation(map: Transformation): Operation {
  const made = (label: string, call: string) => ({ label, expression: `$a ${call}`, needsOther: false });
  switch (map.mode) {
    case "translate":
      return made("move", `translate[${constant("vector3d", map.by)}]`);
    case "scale":
      return made(
        "scale",
        `scaleDir[${constant("point3d", map.about)}, ${constant("vector3d", map.factors)}]`,
      );
    case "rotate": {
      const axis = `${constant("point3d", map.about)}, ${constant("vector3d", map.axis)}`;
      return made("turn", `rotate[${axis}, ${real(map.degrees)}]`);
    }
  }
}

export function vertexMove(type: MeshType, vertex: number, to: Triple): Operation {
  const point = constant("point3d", to);
  const mesh = type === "mesh3d" ? "$a" : asMesh(type, true);
  return {
    label: `move vertex ${vertex}`,
    expression: `moveVertex(${mesh}, ${vertex}, ${point})`,
    needsOther: false,
  };
}

const kWords = new Set(
  (
    "query subdivide limitPosition simplify dual triangulate volume2mesh surface2mesh mesh2volume moveVertex " +
    "union intersection minus symmetricDifference translate scaleDir rotate const point3d vector3d value TRUE e"
  ).split(" "),
);

/** Whether a statement can only be one of the operations above, or takes a parameter as it is: it changes nothing. */
export function isWorkbenchStatement(text: string): boolean {
  // Strings are options. Any other, such as one with a quote in it, could hide code from this look.
  const code = text.replace(/"[a-z0-9-]*"/g, "").replace(/\$\w+/g, "");
  const words = code.match(/[A-Za-z_]\w*/g) ?? [];
  return (
    code.startsWith("query ") && /^[\w\s.,()[\]+-]*$/.test(code) && words.every((word) => kWords.has(word))
  );
}

/** A number in the notation of the language, with all its digits. */
function coordinate(value: number): string {
  return Object.is(value, -0) ? "0" : String(value);
}

/** A number that the language takes for a real. */
function real(value: number): string {
  return Number.isInteger(value) ? value.toFixed(1) : coordinate(value);
}

/** Counts of a mesh as one row. */
export function factsStatement(type: MeshType): string {
  const area = type === "mesh3d" ? "faces($a) sum[Area]" : "area($a)";
  const facts = [
    "Vertices: vertices($a) count",
    "Edges: edges($a) count",
    "Faces: faces($a) count",
    "Euler: eulerCharacteristic($a)",
    "Genus: genus($a)",
    "Closed: isClosed($a)",
    "Manifold: isManifold($a)",
    `Area: ${area}`,
  ];
  return `query intstream(1, 1) transformstream projectextend[; ${facts.join(", ")}] consume`;
}

/** The enclosed volume; of a mesh that bounds no solid undefined, with the reason in the diagnostics. */
export const volumeStatement = (type: MeshType) => `query volume(${asVolume("$a", type)})`;
