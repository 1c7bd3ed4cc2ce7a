/** The picture of the view, with axes, scale and labels, as PNG. */

import type { SceneState, ScreenshotOptions } from "./api";
import type { Canvas } from "./canvas";
import type { Overlay } from "./overlay";
import { kFull } from "./quality";
import type { Stage } from "./stage";

/** Errors: rejects if WebGL is missing, or the picture is too large for the browser. */
export function takeScreenshot(
  canvas: Canvas,
  stage: Stage,
  state: SceneState,
  options: ScreenshotOptions,
): Promise<Blob> {
  const size = {
    width: options.width ?? stage.projector.size.width,
    height: options.height ?? stage.projector.size.height,
  };
  const picture = canvas.capture(size, (source) => {
    if (options.transparent)
      stage.draw(canvas, state, {
        software: canvas.software,
        quality: kFull,
        backgroundless: true,
      });
    return compose(source, stage.overlay);
  });
  if (!picture)
    return Promise.reject(new Error("There is no picture: the scene cannot be drawn without WebGL."));
  return new Promise((resolve, reject) => {
    picture.toBlob((blob) => {
      if (blob) resolve(blob);
      else reject(new Error(`A picture of ${picture.width} × ${picture.height} pixels is too large.`));
    }, "image/png");
  });
}

function compose(scene: HTMLCanvasElement, overlay: Overlay): HTMLCanvasElement {
  const picture = scene.ownerDocument.createElement("canvas");
  picture.width = scene.width;
  picture.height = scene.height;
  const context = picture.getContext("2d");
  if (!context) return picture;
  context.drawImage(scene, 0, 0);
  overlay.copyTo(context, scene.width, scene.height);
  return picture;
}
