import type { MeshForm, MeshFormat } from "../api/types";

/** A form of mesh files as an item of a menu. */
export interface Download {
  readonly form: MeshForm;
  /** "STL", "STL (text)". */
  readonly label: string;
  readonly ending: string;
}

/** The forms in which meshes can be downloaded. */
export function downloadsOf(formats: readonly MeshFormat[]): readonly Download[] {
  return formats.flatMap(({ name, endings, forms }) =>
    forms.map((form, place) => ({
      form,
      label: place === 0 ? name : `${name} (${form.binary ? "binary" : "text"})`,
      ending: endings[0] ?? "",
    })),
  );
}

/** The operator that repairs a file of this name; null if it is not a mesh file. */
export function importerOf(formats: readonly MeshFormat[], fileName: string): string | null {
  const name = fileName.toLowerCase();
  return formats.find(({ endings }) => endings.some((ending) => name.endsWith(ending)))?.importer ?? null;
}

/** Formats of geometry that are not read, by the endings of their files. */
const unreadFormats: Readonly<Record<string, string>> = {
  ply: "PLY",
  "3mf": "3MF",
  step: "STEP",
  stp: "STEP",
  iges: "IGES",
  igs: "IGES",
  gltf: "glTF",
  glb: "glTF",
  fbx: "FBX",
  dae: "COLLADA",
  "3ds": "3DS",
  blend: "Blender",
  amf: "AMF",
  wrl: "VRML",
  brep: "BREP",
  ifc: "IFC",
  dxf: "DXF",
  dwg: "DWG",
};

/** The name of the format of a file of geometry that cannot be read; null of every other file. */
export function unreadFormat(fileName: string): string | null {
  const ending = /\.(\w+)$/.exec(fileName.toLowerCase())?.[1] ?? "";
  return Object.hasOwn(unreadFormats, ending) ? (unreadFormats[ending] ?? null) : null;
}

/** The names of the formats for sentences: "STL, OBJ or OFF"; "mesh" as long as they are not known. */
export function listedFormats(formats: readonly MeshFormat[], joint: "or" | "and" = "or"): string {
  const names = formats.map(({ name }) => name);
  const last = names.pop();
  if (last === undefined) return "mesh";
  return names.length === 0 ? last : `${names.join(", ")} ${joint} ${last}`;
}
