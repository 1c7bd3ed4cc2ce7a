/**
 * A picture beside the canvas, with as many pixels as it is to have: what is drawn into it is not seen until it is laid
 * over the canvas. So the canvas keeps its size, which the browser changes at the price of waiting for all that is drawn.
 */

import { NoBlending, ShaderMaterial, SRGBColorSpace, Vector2, WebGLRenderTarget } from "three";
import type { WebGLRenderer } from "three";
import { FullScreenQuad } from "three/addons/postprocessing/Pass.js";

const kVertexShader = `uniform vec2 share;
varying vec2 vPlace;
void main() {
  vPlace = uv * share;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

const kFragmentShader = `uniform sampler2D picture;
varying vec2 vPlace;
void main() {
  gl_FragColor = texture2D(picture, vPlace);
}`;

export class Picture {
  private target: WebGLRenderTarget | null = null;
  private readonly cover = new ShaderMaterial({
    uniforms: { picture: { value: null }, share: { value: new Vector2(1, 1) } },
    vertexShader: kVertexShader,
    fragmentShader: kFragmentShader,
    depthTest: false,
    depthWrite: false,
    blending: NoBlending,
  });
  private readonly quad = new FullScreenQuad(this.cover);

  /** With `samples` a pixel, as the canvas has them itself where there is hardware. */
  constructor(private readonly samples: number) {}

  /** Makes room for a picture of this size; larger ones are kept, and used in part. */
  begin(width: number, height: number): void {
    const fits = this.target && width <= this.target.width && height <= this.target.height;
    if (!fits) {
      this.target?.dispose();
      this.target = makeTarget(width, height, this.samples);
    }
    const target = this.target!;
    target.viewport.set(0, 0, width, height);
    target.scissor.set(0, 0, width, height);
    target.scissorTest = true;
    (this.cover.uniforms["share"]!.value as Vector2).set(width / target.width, height / target.height);
  }

  /** What is drawn from now on is drawn into it. */
  use(renderer: WebGLRenderer): void {
    renderer.setRenderTarget(this.target);
  }

  /** Lays it over the canvas, into which is drawn from now on. */
  show(renderer: WebGLRenderer): void {
    renderer.setRenderTarget(null);
    this.cover.uniforms["picture"]!.value = this.target!.texture;
    this.quad.render(renderer);
  }

  dispose(): void {
    this.target?.dispose();
    this.cover.dispose();
    this.quad.dispose();
  }
}

function makeTarget(width: number, height: number, samples: number): WebGLRenderTarget {
  const target = new WebGLRenderTarget(width, height, { stencilBuffer: true, samples });
  // As for the canvas, colours are written as they are shown: the renderer does so for targets of this kind.
  (target as WebGLRenderTarget & { isXRRenderTarget: boolean }).isXRRenderTarget = true;
  target.texture.colorSpace = SRGBColorSpace;
  target.texture.internalFormat = "RGBA8";
  return target;
}
