import { BufferAttribute, BufferGeometry, Mesh, MeshBasicMaterial, PerspectiveCamera, Scene } from "three";
import type { Camera, WebGLRenderer } from "three";
import { expect, test } from "vitest";

import { kSliceLayer, Slices } from "../../../src/scene/slices";

/** Of so many triangles, at a distance before the camera. */
function mesh(name: string, triangles: number, distance: number): Mesh<BufferGeometry, MeshBasicMaterial> {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(9), 3));
  geometry.setIndex(new BufferAttribute(new Uint16Array(3 * triangles), 1));
  const object = new Mesh(geometry, new MeshBasicMaterial());
  object.name = name;
  object.position.z = -distance;
  return object;
}

/** A renderer that notes what it was asked to draw. */
function recorder(): { renderer: WebGLRenderer; drawn: string[][] } {
  const drawn: string[][] = [];
  const render = (scene: Scene, camera: Camera): void => {
    const seen: string[] = [];
    scene.traverseVisible((object) => {
      if (!(object instanceof Mesh) || !object.layers.test(camera.layers)) return;
      const { start, count } = (object.geometry as BufferGeometry).drawRange;
      seen.push(`${object.name} ${start / 3}+${count / 3}`);
    });
    drawn.push(seen);
  };
  return { renderer: { render } as unknown as WebGLRenderer, drawn };
}

function drawAll(slices: Slices, renderer: WebGLRenderer, budget: number): number {
  let parts = 1;
  while (!slices.draw(renderer, budget)) parts++;
  return parts;
}

test("a scene is drawn from near to far in parts of a limited size, and what is seen through last", () => {
  const scene = new Scene();
  const glass = mesh("glass", 2000, 1);
  glass.material.transparent = true;
  scene.add(glass, mesh("far", 5000, 9), mesh("near", 1000, 2));
  const { renderer, drawn } = recorder();
  // Uploads are paid for once.
  drawAll(new Slices(scene, new PerspectiveCamera()), renderer, 1e9);
  drawn.length = 0;
  expect(drawAll(new Slices(scene, new PerspectiveCamera()), renderer, 3000)).toBe(3);
  expect(drawn).toEqual([["far 0+2000", "near 0+1000"], ["far 2000+3000"], ["glass 0+2000"]]);
  scene.traverse((object) => {
    expect(object.layers.isEnabled(kSliceLayer)).toBe(false);
    if (object instanceof Mesh) expect((object.geometry as BufferGeometry).drawRange.count).toBe(Infinity);
  });
});

test("what leaves the scene while it is drawn is left out", () => {
  const scene = new Scene();
  const [first, second, third] = [mesh("1", 100, 1), mesh("2", 100, 2), mesh("3", 100, 3)];
  scene.add(first, second, third);
  const { renderer, drawn } = recorder();
  const slices = new Slices(scene, new PerspectiveCamera());
  expect(slices.draw(renderer, 50)).toBe(false);
  scene.remove(second);
  third.visible = false;
  drawAll(slices, renderer, 1000);
  expect(drawn.flat().every((name) => name.startsWith("1 "))).toBe(true);
});
