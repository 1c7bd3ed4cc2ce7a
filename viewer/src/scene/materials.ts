/** Materials of faces, lines and points. Lines share one material a view, since their colour is that of all. */

import {
  AlwaysStencilFunc,
  BackSide,
  DecrementWrapStencilOp,
  DoubleSide,
  FrontSide,
  IncrementWrapStencilOp,
  LineBasicMaterial,
  MeshBasicMaterial,
  MeshLambertMaterial,
  PointsMaterial,
  ShaderChunk,
  Vector3,
} from "three";
import type { Box3, Material, Plane } from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";

import { kBoundaryColor, kNonManifoldColor, isTransparent } from "./look";
import type { Style } from "./look";

/** Pixels of the picture that is being drawn for one of the canvas; the same for all views, set before each drawing. */
export const kPointScale = { value: 1 };

/** Points are drawn as discs; with `perPoint` each has a size of its own in the attribute `pointSize`. */
export function pointMaterial(perPoint: boolean): PointsMaterial {
  // The renderer multiplies sizes by the pixel ratio; with sizes of their own, the common factor is 1.
  const material = new PointsMaterial({ sizeAttenuation: false, vertexColors: perPoint, size: 1 });
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      "#include <clipping_planes_fragment>",
      "#include <clipping_planes_fragment>\n if (length(gl_PointCoord - 0.5) > 0.5) discard;",
    );
    shader.uniforms["pointScale"] = kPointScale;
    const own = perPoint ? "attribute float pointSize;" : "const float pointSize = 1.0;";
    shader.vertexShader = shader.vertexShader
      .replace("uniform float size;", `uniform float size, pointScale;\n${own}`)
      .replace("gl_PointSize = size;", "gl_PointSize = size * pointSize * pointScale;");
  };
  material.customProgramCacheKey = () => (perPoint ? "discs of sizes" : "discs");
  return material;
}

/**
 * Leaves the place of a fragment out of what vertices pass on to fragments, unless a lamp or flat shading needs it: in
 * software rendering each number that is interpolated costs as much as a lamp.
 */
function passLittle(shader: { fragmentShader: string }): void {
  const chunk = "lights_lambert_pars_fragment";
  const lights = ShaderChunk[chunk].replace(
    "varying vec3 vViewPosition;",
    `#if NUM_POINT_LIGHTS > 0 || defined(FLAT_SHADED)
       varying vec3 vViewPosition;
     #else
       const vec3 vViewPosition = vec3(0.0, 0.0, 1.0);
     #endif`,
  );
  shader.fragmentShader = shader.fragmentShader.replace(`#include <${chunk}>`, lights);
}

/** The normal of a flat face from directions of length about 1: those of tiny and of huge objects leave the floats. */
function takeAnySize(shader: { fragmentShader: string }): void {
  const chunk = "normal_fragment_begin";
  const normals = ShaderChunk[chunk].replace(
    "cross( fdx, fdy )",
    `cross( fdx / max( max( abs( fdx.x ), abs( fdx.y ) ), abs( fdx.z ) ),
            fdy / max( max( abs( fdy.x ), abs( fdy.y ) ), abs( fdy.z ) ) )`,
  );
  shader.fragmentShader = shader.fragmentShader.replace(`#include <${chunk}>`, normals);
}

/** The box over which colours by position go, relative to the local origin. */
export interface PlaceUniforms {
  readonly placeMin: { readonly value: Vector3 };
  readonly placeSize: { readonly value: Vector3 };
}

/** Where the defines say so, colours by position (red, green and blue for x, y and z), and colours without light. */
function takeVariants(shader: { vertexShader: string; fragmentShader: string }): void {
  shader.vertexShader = `#ifdef COLOR_BY_PLACE
       uniform vec3 placeMin, placeSize;
       varying vec3 vPlace;
     #endif
     ${shader.vertexShader}`.replace(
    "#include <begin_vertex>",
    `#include <begin_vertex>
     #ifdef COLOR_BY_PLACE
       vPlace = ((modelMatrix * vec4(position, 1.0)).xyz - placeMin) / placeSize;
     #endif`,
  );
  shader.fragmentShader = `#ifdef COLOR_BY_PLACE
       varying vec3 vPlace;
     #endif
     ${shader.fragmentShader}`
    .replace(
      "#include <color_fragment>",
      `#include <color_fragment>
       #ifdef COLOR_BY_PLACE
         diffuseColor.rgb *= 0.1 + 0.9 * clamp(vPlace, 0.0, 1.0);
       #endif`,
    )
    .replace(
      "#include <opaque_fragment>",
      `#ifdef UNLIT
         outgoingLight = diffuseColor.rgb;
       #endif
       #include <opaque_fragment>`,
    );
}

/** Of faces. */
export function faceMaterial(vertexColors: boolean, place: PlaceUniforms): MeshLambertMaterial {
  const material = new MeshLambertMaterial({
    vertexColors,
    polygonOffset: true,
  });
  bringForward(material, false);
  material.onBeforeCompile = (shader) => {
    passLittle(shader);
    takeAnySize(shader);
    takeVariants(shader);
    Object.assign(shader.uniforms, place);
  };
  return material;
}

/** Faces lie behind edges in the same place, and those that are not selected behind those that are. */
export function bringForward(material: Material, isSelected: boolean): void {
  material.polygonOffsetFactor = material.polygonOffsetUnits = isSelected ? 1 : 2;
}

/** What the shader is compiled with for a style. */
function definesOf({ shading, scheme }: Style["appearance"]): Record<string, string> {
  return {
    ...(shading === "unlit" ? { UNLIT: "" } : {}),
    ...(scheme.by === "position" ? { COLOR_BY_PLACE: "" } : {}),
  };
}

/**
 * Sets what depends on the style; makes the renderer compile anew only if it has to. `closed`: backs are never seen
 * unless the solid is cut open.
 */
export function styleFaces(
  material: MeshLambertMaterial,
  style: Style,
  options: { readonly closed: boolean; readonly hasNormals: boolean; readonly opacity: number },
): void {
  const flat = style.appearance.shading === "flat" || !options.hasNormals;
  const transparent = isTransparent(options.opacity);
  const side = options.closed && style.clipping.length === 0 && !transparent ? FrontSide : DoubleSide;
  const defines = definesOf(style.appearance);
  if (
    material.flatShading !== flat ||
    material.side !== side ||
    material.transparent !== transparent ||
    Object.keys(material.defines ?? {}).join() !== Object.keys(defines).join()
  ) {
    material.needsUpdate = true;
  }
  material.defines = defines;
  material.flatShading = flat;
  material.side = side;
  material.transparent = transparent;
  material.depthWrite = !transparent;
  clip(material, style.clipping);
}

export function clip(material: Material, planes: readonly Plane[]): void {
  const before = material.clippingPlanes?.length ?? 0;
  if (before !== planes.length) material.needsUpdate = true;
  material.clippingPlanes = planes.length > 0 ? [...planes] : null;
}

/** The materials that all objects of a view share. */
export class SharedMaterials {
  readonly edges = new LineBasicMaterial();
  readonly vertices = pointMaterial(false);
  /** Vertices that can be dragged. */
  readonly grips = pointMaterial(false);
  readonly place: PlaceUniforms = {
    placeMin: { value: new Vector3() },
    placeSize: { value: new Vector3(1, 1, 1) },
  };
  readonly boundary = new LineBasicMaterial({ color: kBoundaryColor });
  readonly nonManifold = new LineBasicMaterial({ color: kNonManifoldColor });
  readonly wideBoundary = new LineMaterial({ color: kBoundaryColor, linewidth: 2.5 });
  readonly wideNonManifold = new LineMaterial({ color: kNonManifoldColor, linewidth: 3 });
  /** Count the faces before the cut; see section.ts. */
  readonly stencilBack = stencilMaterial(true);
  readonly stencilFront = stencilMaterial(false);

  apply(style: Style): void {
    this.edges.color.set(style.edgeColor);
    this.edges.transparent = isTransparent(style.appearance.opacity) && style.appearance.faces;
    this.edges.opacity = this.edges.transparent ? Math.max(0.25, style.appearance.opacity) : 1;
    for (const vertices of [this.vertices, this.grips]) vertices.color.set(style.edgeColor);
    this.vertices.size = style.appearance.pointSize;
    this.grips.size = 8;
    for (const material of this.all()) clip(material, style.clipping);
  }

  private all(): Material[] {
    return [
      this.edges,
      this.vertices,
      this.grips,
      this.boundary,
      this.nonManifold,
      this.wideBoundary,
      this.wideNonManifold,
      this.stencilBack,
      this.stencilFront,
    ];
  }

  /** Colours by position go over this box. */
  setPlace(box: Box3, origin: Vector3): void {
    const { placeMin, placeSize } = this.place;
    placeMin.value.copy(box.min).sub(origin);
    box.getSize(placeSize.value);
    const { x, y, z } = placeSize.value;
    placeSize.value.set(x || 1, y || 1, z || 1);
  }

  dispose(): void {
    for (const material of this.all()) material.dispose();
  }
}

function stencilMaterial(back: boolean): MeshBasicMaterial {
  const step = back ? IncrementWrapStencilOp : DecrementWrapStencilOp;
  return new MeshBasicMaterial({
    side: back ? BackSide : FrontSide,
    depthWrite: false,
    depthTest: false,
    colorWrite: false,
    stencilWrite: true,
    stencilFunc: AlwaysStencilFunc,
    stencilFail: step,
    stencilZFail: step,
    stencilZPass: step,
  });
}
