/** Files that describe the materials of OBJ files (MTL). */

import { isColor, type MaterialColors } from "./element_colors";

export interface MaterialFile {
  /** By name, `#rrggbb`: the diffuse colours (Kd). */
  readonly colors: MaterialColors;
  /** Of materials that have a picture as their colour (map_Kd). */
  readonly textures: number;
}

/** What a file of materials says of colours. Lines that say nothing of them, or cannot be read, are left out. */
export function readMaterialFile(text: string): MaterialFile {
  const colors: Record<string, string> = {};
  let name: string | null = null;
  let textures = 0;
  for (const line of text.split(/\r\n|\r|\n/)) {
    const [, keyword = "", rest = ""] = /^\s*(\S+)\s*(.*?)\s*$/.exec(line) ?? [];
    if (keyword === "newmtl") name = rest;
    if (name === null) continue;
    if (keyword === "Kd") {
      const color = colorOf(rest.split(/\s+/).map(Number));
      if (isColor(color)) colors[name] = color;
    }
    if (keyword === "map_Kd") textures++;
  }
  return { colors, textures };
}

/** Of three numbers from 0 to 1; of one that holds for all three. "" of anything else. */
function colorOf([r = NaN, g = r, b = r]: readonly number[]): string {
  if (![r, g, b].every(Number.isFinite)) return "";
  const hex = (part: number) =>
    Math.round(255 * Math.min(1, Math.max(0, part)))
      .toString(16)
      .padStart(2, "0");
  return `#${hex(r)}${hex(g)}${hex(b)}`;
}
