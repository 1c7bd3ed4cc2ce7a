/** Colours of the vertices or faces of meshes, as their files give them: asked for when they are needed first, and drawn. */

import { BufferAttribute, BufferGeometry, Color, SRGBColorSpace } from "three";
import type { Sphere } from "three";

import type { Primitive, Shape } from "../glb/shapes";
import type { Color as ColorText, ElementColors, Legend } from "./api";
import { categoryColor, formatColor, parseColor } from "./colors";
import { primitiveOf } from "./geometry";
import type { ShapeRecord } from "./shape_store";

/** Of more triangles the colours are not asked for: they come as rows of a table. */
const kMostTriangles = 500_000;

/** Colours of the elements of a mesh, decided. */
export interface DrawnColors {
  readonly elements: "vertex" | "face";
  /** Red, green and blue of each, from 0 to 1 (sRGB). */
  readonly rgb: Float32Array;
  /** For which the colours stand, with the numbers of their faces; none if the file has colours by themselves. */
  readonly materials: readonly {
    readonly label: string;
    readonly color: ColorText;
    readonly count: number;
  }[];
}

interface Entry {
  readonly abort: AbortController;
  /** null: not there yet, or the object has none. */
  colors: DrawnColors | null;
  isKnown: boolean;
}

export class ElementColorCache {
  private readonly known = new Map<ShapeRecord, Entry>();

  constructor(
    /** Colours came. */
    private readonly changed: () => void,
  ) {}

  /** null as long as they are not known, and of an object without any. */
  of(record: ShapeRecord): DrawnColors | null {
    const { source } = record.column;
    if (!source.elementColors || record.firstShape.kind !== "mesh3d" || record.triangles > kMostTriangles)
      return null;
    const known = this.known.get(record);
    if (known) return known.colors;
    const entry: Entry = { abort: new AbortController(), colors: null, isKnown: false };
    this.known.set(record, entry);
    void this.load(record, entry);
    return null;
  }

  private async load(record: ShapeRecord, entry: Entry): Promise<void> {
    const { source } = record.column;
    const told = await source.elementColors?.(record.row, entry.abort.signal).catch(() => null);
    entry.colors = told ? drawnColors(told) : null;
    entry.isKnown = true;
    if (!entry.abort.signal.aborted) this.changed();
  }

  /** The materials of all objects with the numbers of their faces; objects without colours are counted, too. */
  legend(records: Iterable<ShapeRecord>): Legend {
    const entries = new Map<string, { label: string; color: ColorText; count: number }>();
    let without = 0;
    for (const record of records) {
      const entry = this.known.get(record);
      if (!entry || (entry.isKnown && !entry.colors)) without++;
      for (const material of entry?.colors?.materials ?? []) {
        const before = entries.get(material.label)?.count ?? 0;
        entries.set(material.label, { ...material, count: before + material.count });
      }
    }
    const kind = { kind: "categories", attribute: "Colours of the file", others: 0 } as const;
    const none = { label: "objects without", color: "#999999", count: without };
    return { ...kind, entries: [...entries.values(), ...(without > 0 ? [none] : [])] };
  }

  /** Asks anew, as after other colours of materials were read. */
  forget(isForgotten: (record: ShapeRecord) => boolean = () => true): void {
    for (const [record, { abort }] of this.known) {
      if (!isForgotten(record)) continue;
      abort.abort();
      this.known.delete(record);
    }
  }
}

/** Of elements without a material. */
const kNoMaterial: ColorText = "#999999";

/** Materials whose colours are not known get one each, in the order of their names. */
export function drawnColors(told: ElementColors): DrawnColors {
  if ("rgb" in told) return { ...told, materials: [] };
  const counts = new Map<string, number>();
  for (const name of told.materials) counts.set(name, (counts.get(name) ?? 0) + 1);
  const names = [...counts.keys()].filter((name) => name !== "").sort();
  const color = new Map(names.map((name, index) => [name, told.colors[name] ?? categoryColor(index)]));
  const rgb = new Float32Array(3 * told.materials.length);
  told.materials.forEach((name, face) => {
    const parts = parseColor(color.get(name) ?? kNoMaterial);
    rgb.set(
      parts.map((part) => part / 255),
      3 * face,
    );
  });
  const materials = names.map((label) => ({ label, color: color.get(label)!, count: counts.get(label)! }));
  return { elements: "face", rgb, materials };
}

/** The mean of the colours, for objects that are too small and many to be drawn one by one. */
export function meanColor({ rgb }: DrawnColors): ColorText {
  const sum = [0, 0, 0];
  for (let i = 0; i < rgb.length; i++) sum[i % 3]! += rgb[i]!;
  const [r, g, b] = sum.map((part) => (255 * part) / Math.max(1, rgb.length / 3));
  return formatColor([r!, g!, b!]);
}

/** The faces of a shape in the colours of its elements; null of a level that does not know their numbers. */
export function coloredFaces(
  shape: Shape,
  colors: DrawnColors,
  sphere: Sphere | null,
): BufferGeometry | null {
  const faces = primitiveOf(shape, "faces");
  // Coarser levels have vertices and faces of their own.
  if (!faces?.indices || shape.shown < shape.triangles) return null;
  const geometry = new BufferGeometry();
  const corners = cornersOf(faces.indices, faces, colors);
  geometry.setAttribute("position", new BufferAttribute(corners.positions, 3));
  if (corners.normals) geometry.setAttribute("normal", new BufferAttribute(corners.normals, 3, true));
  geometry.setAttribute("color", new BufferAttribute(corners.colors, 3));
  if (sphere) geometry.boundingSphere = sphere;
  return geometry;
}

/** Every corner of every triangle by itself, so that neighbouring faces can have different colours. */
function cornersOf(indices: NonNullable<Primitive["indices"]>, faces: Primitive, colors: DrawnColors) {
  const { positions, normals, faceIds, vertexIds } = faces;
  const to = {
    positions: new Float32Array(3 * indices.length),
    normals: normals && new Int8Array(3 * indices.length),
    colors: new Float32Array(3 * indices.length),
  };
  const color = new Color();
  for (let corner = 0; corner < indices.length; corner++) {
    const vertex = indices[corner]!;
    const triangle = Math.floor(corner / 3);
    const element =
      colors.elements === "face" ? (faceIds?.[triangle] ?? triangle) : (vertexIds?.[vertex] ?? vertex);
    const [r = 1, g = 1, b = 1] = colors.rgb.subarray(3 * element, 3 * element + 3);
    color.setRGB(r, g, b, SRGBColorSpace).toArray(to.colors, 3 * corner);
    for (let axis = 0; axis < 3; axis++) {
      to.positions[3 * corner + axis] = positions[3 * vertex + axis]!;
      if (normals && to.normals)
        to.normals[3 * corner + axis] = normals.array[normals.stride * vertex + axis]!;
    }
  }
  return to;
}
