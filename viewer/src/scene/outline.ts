/** The outline of the selected objects: they are drawn into a mask, and its border is laid over the picture. */

import {
  Color,
  DoubleSide,
  MeshBasicMaterial,
  NoBlending,
  ShaderMaterial,
  Vector2,
  WebGLRenderTarget,
} from "three";
import type { Box3, Camera, Plane, Scene, WebGLRenderer } from "three";
import { FullScreenQuad } from "three/addons/postprocessing/Pass.js";

import { cornersOf } from "./camera";
import { kSelectionColor } from "./look";
import type { Projector } from "./projection";

/** What is drawn into the mask. */
export const kOutlineLayer = 1;
/** In CSS pixels. */
const kWidth = 2;

const kVertexShader = `varying vec2 vPlace;
void main() {
  vPlace = uv;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

const kFragmentShader = `uniform sampler2D mask;
uniform vec2 reach;
uniform vec3 color;
varying vec2 vPlace;
void main() {
  if (texture2D(mask, vPlace).r > 0.5) discard;
  float found = 0.0;
  for (int i = -1; i <= 1; i++)
    for (int j = -1; j <= 1; j++)
      found = max(found, texture2D(mask, vPlace + reach * vec2(float(i), float(j))).r);
  if (found < 0.5) discard;
  gl_FragColor = vec4(color, 1.0);
  #include <colorspace_fragment>
}`;

export class Outline {
  private mask: WebGLRenderTarget | null = null;
  private readonly flat = new MeshBasicMaterial({ color: 0xffffff, side: DoubleSide, blending: NoBlending });
  private readonly border = new ShaderMaterial({
    uniforms: {
      mask: { value: null },
      reach: { value: new Vector2() },
      color: { value: new Color(kSelectionColor) },
    },
    vertexShader: kVertexShader,
    fragmentShader: kFragmentShader,
    depthTest: false,
    depthWrite: false,
  });
  private readonly quad = new FullScreenQuad(this.border);

  /** Draws the outline of what is on `kOutlineLayer`, which lies in a box. */
  draw(
    renderer: WebGLRenderer,
    scene: Scene,
    camera: Camera,
    options: { readonly projector: Projector; readonly box: Box3; readonly clipping: readonly Plane[] },
  ): void {
    const mask = this.maskFor(renderer);
    const { x, y, width, height } = areaOf(options.box, options.projector);
    if (width <= 0 || height <= 0) return;
    this.flat.clippingPlanes = options.clipping.length > 0 ? [...options.clipping] : null;
    renderer.setScissor(x, y, width, height);
    renderer.setScissorTest(true);
    scene.overrideMaterial = this.flat;
    camera.layers.set(kOutlineLayer);
    const before = renderer.getClearColor(new Color());
    const alpha = renderer.getClearAlpha();
    renderer.setRenderTarget(mask);
    renderer.setClearColor(0x000000, 1);
    renderer.clear(true, true, false);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.setClearColor(before, alpha);
    camera.layers.set(0);
    scene.overrideMaterial = null;
    const { uniforms } = this.border;
    const pixels = kWidth * renderer.getPixelRatio();
    uniforms["mask"]!.value = mask.texture;
    (uniforms["reach"]!.value as Vector2).set(pixels / mask.width, pixels / mask.height);
    this.quad.render(renderer);
    renderer.setScissorTest(false);
  }

  private maskFor(renderer: WebGLRenderer): WebGLRenderTarget {
    const size = renderer.getDrawingBufferSize(new Vector2());
    if (this.mask?.width !== size.x || this.mask.height !== size.y) {
      this.mask?.dispose();
      this.mask = new WebGLRenderTarget(size.x, size.y);
    }
    return this.mask;
  }

  dispose(): void {
    this.mask?.dispose();
    this.flat.dispose();
    this.border.dispose();
    this.quad.dispose();
  }
}

/** The part of the view in which a box is seen, with room for the outline; from below, as scissors take it. */
function areaOf(box: Box3, projector: Projector): { x: number; y: number; width: number; height: number } {
  const { width, height } = projector.size;
  const places = cornersOf(box).map((corner) => projector.project(corner));
  // A corner behind the eye is nowhere in the view: the whole of it is taken.
  if (places.some(({ visible }) => !visible)) return { x: 0, y: 0, width, height };
  const [xs, ys] = [places.map(({ x }) => x), places.map(({ y }) => y)];
  const left = Math.max(0, Math.floor(Math.min(...xs)) - 2 * kWidth);
  const right = Math.min(width, Math.ceil(Math.max(...xs)) + 2 * kWidth);
  const top = Math.max(0, Math.floor(Math.min(...ys)) - 2 * kWidth);
  const bottom = Math.min(height, Math.ceil(Math.max(...ys)) + 2 * kWidth);
  return { x: left, y: height - bottom, width: right - left, height: bottom - top };
}
