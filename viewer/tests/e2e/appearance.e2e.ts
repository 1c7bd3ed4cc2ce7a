import { beforeEach, expect, test } from "vitest";
import type { Page } from "playwright-core";

import { run, stillScene } from "./support/actions";
import { takePicture } from "./support/browser";
import {
  choose,
  clickAt,
  covered,
  field,
  frontView,
  halfSide,
  isBluish,
  isGreenish,
  isNear,
  isReddish,
  isWhite,
  plainScene,
  press,
  sceneSize,
  setColor,
} from "./support/scene";
import { Session } from "./support/session";

const row =
  'intstream(1, 4) transformstream extend[Name: "part " + tostring(.Elem), Mass: .Elem * 1.5, Solid: createCube(makePoint3D(.Elem * 3, 0, 0), makePoint3D(.Elem * 3 + 2, 2, 2))]';

const session = new Session({
  statements: [
    "let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))",
    "let Ball = createSphere(makePoint3D(0, 0, 0), 1, 16)",
    "let Fine = createSphere(makePoint3D(5, 1, 0), 1, 80)",
    `let Row = ${row} consume`,
    "let Open = [const surface3d value (((0 0 0) (2 0 0) (0 0 2)) ((2 0 0) (2 0 2) (0 0 2)))]",
    // Three triangles at one edge.
    "let Fan = [const mesh3d value (((0 0 0) (0 0 2) (1 0 1) (-1 0 1) (0 1 1)) ((0 1 2) (0 1 3) (0 1 4)))]",
    // Seen from the front: the left half red, the right half blue, each of two triangles.
    'let Painted = [const mesh3d value (((0 0 0) (1 0 0) (2 0 0) (0 0 2) (1 0 2) (2 0 2)) ((0 1 4 3) (1 2 5 4)) ((face "Colour" vector ((1 0 0) (0 0 1)))))]',
    'let Faded = [const mesh3d value (((0 0 0) (2 0 0) (2 0 2) (0 0 2)) ((0 1 2 3)) ((vertex "Colour" vector ((1 0 0) (0 0 1) (0 0 1) (1 0 0)))))]',
    "let Cloud = [const points3d value ((0 0 0) (1 0 0) (0 0 1) (1 0 1) (0.5 0 0.5))]",
  ],
});

let page: Page;

beforeEach(() => {
  page = session.page;
});

const show = (statement: string) => session.show(statement);

test("the context lives, and the picture of a cube is not blank", async () => {
  await run(page, "query Cube");
  await stillScene(page);
  const alive = await page
    .locator("[data-testid=scene] canvas")
    .first()
    .evaluate((canvas) => {
      const context = (canvas as HTMLCanvasElement).getContext("webgl2");
      return context !== null && !context.isContextLost();
    });
  expect(alive).toBe(true);
  expect((await takePicture(page, "scene-cube")).colors()).toBeGreaterThan(20);
});

test("a red cube on white has as many red pixels as its size says", async () => {
  await show("query Cube");
  await setColor(page, "appearance", "Object colour", "#ff0000");
  await choose(page, "appearance", "Edges", "None");
  await press(page, "-"); // so that the toolbar covers nothing
  const picture = await stillScene(page);
  const side = (2 * halfSide(await sceneSize(page))) / 1.2;
  const red = picture.count(isReddish);
  expect(red).toBeGreaterThan(side * side * 0.98);
  expect(red).toBeLessThan(side * side * 1.02);
  expect(picture.count(isWhite)).toBeGreaterThan(picture.width * picture.height - red - 8 * side);
});

test("faces and edges are drawn together or alone, in their colours", async () => {
  await show("query Cube");
  await setColor(page, "appearance", "Object colour", "#ff0000");
  await setColor(page, "appearance", "Edge colour", "#0000ff");
  const both = await stillScene(page);
  expect(both.count(isReddish)).toBeGreaterThan(10_000);
  expect(both.count(isBluish)).toBeGreaterThan(200);
  await field(page, "appearance", "Faces").setChecked(false);
  const wire = await stillScene(page);
  expect(wire.count(isReddish)).toBe(0);
  expect(wire.count(isBluish)).toBeGreaterThan(200);
  await choose(page, "appearance", "Edges", "All");
  const triangles = await stillScene(page);
  await takePicture(page, "scene-wireframe");
  // The diagonals of the faces.
  expect(covered(triangles) - covered(wire)).toBeGreaterThan(700);
  await field(page, "appearance", "Faces").setChecked(true);
  await choose(page, "appearance", "Edges", "None");
  const solid = await stillScene(page);
  expect(solid.count(isBluish)).toBe(0);
});

test("transparent objects let the background through", async () => {
  await show("query Cube");
  await setColor(page, "appearance", "Object colour", "#ff0000");
  await choose(page, "appearance", "Edges", "None");
  await field(page, "appearance", "Opacity").fill("0.5");
  const { width, height } = await sceneSize(page);
  const [r, g, b] = (await stillScene(page)).at(Math.round(width / 2), Math.round(height / 2));
  expect(r).toBeGreaterThan(150);
  expect(g).toBeGreaterThan(50);
  expect(g).toBeLessThan(200);
  expect(Math.abs(g - b)).toBeLessThan(6);
  await takePicture(page, "scene-transparent");
});

test("a gradient goes from the first to the last row", async () => {
  await show("query Row");
  await field(page, "appearance", "Colouring").selectOption("gradient");
  await setColor(page, "appearance", "First row", "#ff0000");
  await setColor(page, "appearance", "Last row", "#0000ff");
  const picture = await stillScene(page);
  expect(picture.count(isReddish)).toBeGreaterThan(1000);
  expect(picture.count(isBluish)).toBeGreaterThan(1000);
  await takePicture(page, "scene-gradient");
});

test("numbers colour by a palette, texts by different colours, both with a legend", async () => {
  await show("query Row");
  await field(page, "appearance", "Colouring").selectOption("attribute");
  await field(page, "appearance", "Attribute").selectOption("Mass");
  const legend = page.getByTestId("legend");
  await expect.poll(() => legend.innerText()).toMatch(/Mass\s+1.5\s+6/);
  const numbers = await stillScene(page);
  await field(page, "appearance", "Attribute").selectOption("Name");
  await expect.poll(() => legend.innerText()).toContain("part 3");
  const texts = await stillScene(page);
  expect(numbers.difference(texts)).toBeGreaterThan(0.05);
  await takePicture(page, "scene-legend");
  await press(page, "b");
  expect(await legend.count()).toBe(0);
});

test("one object has a colour of its own until it is reset", async () => {
  await show("query Row");
  await setColor(page, "appearance", "Object colour", "#ff0000");
  await choose(page, "appearance", "Edges", "None");
  await clickAt(page, 60, 0);
  await setColor(page, "object", "Colour", "#00ff00");
  await press(page, "Escape");
  const coloured = await stillScene(page);
  expect(coloured.count(isGreenish)).toBeGreaterThan(1000);
  expect(coloured.count(isReddish)).toBeGreaterThan(3 * coloured.count(isGreenish) * 0.9);
  await clickAt(page, 60, 0);
  await page.getByRole("button", { name: "Reset to default" }).click();
  await press(page, "Escape");
  expect((await stillScene(page)).count(isGreenish)).toBe(0);
});

test("the smooth shading of a ball has more colours than the flat one", async () => {
  await show("query Ball");
  await choose(page, "appearance", "Edges", "None");
  const smooth = await stillScene(page);
  await choose(page, "appearance", "Shading", "Flat");
  const flat = await stillScene(page);
  expect(flat.difference(smooth)).toBeGreaterThan(0.02);
  expect(flat.colors()).toBeLessThan(smooth.colors());
});

test("the triangles that are left out, since they show their backs, are not missed", async () => {
  await show("query Fine");
  // In the front view without perspective, then with it, then from another side and nearer.
  for (const keys of [[], ["5"], ["9"], ["9", "+"]]) {
    for (const key of keys) await press(page, key);
    await field(page, "appearance", "Opacity").fill("1");
    const opaque = await stillScene(page);
    expect(covered(opaque)).toBeGreaterThan(20_000);
    // Nearly opaque objects are drawn with all their triangles.
    await field(page, "appearance", "Opacity").fill("0.95");
    expect((await stillScene(page)).difference(opaque)).toBeLessThan(0.003);
  }
});

test("vertices of faces are drawn, of one object and of many", async () => {
  for (const [statement, vertices] of [
    ["query Cube", 7], // that are seen
    ["query Row", 4 * 7 - 6],
  ] as const) {
    await show(statement);
    await setColor(page, "appearance", "Edge colour", "#0000ff");
    await choose(page, "appearance", "Edges", "None");
    await field(page, "appearance", "Vertices").setChecked(false);
    expect((await stillScene(page)).count(isBluish)).toBe(0);
    await field(page, "appearance", "Point size").fill("10");
    await field(page, "appearance", "Vertices").setChecked(true);
    const drawn = (await stillScene(page)).count(isBluish);
    // Those at the outline are half hidden at most.
    expect(drawn).toBeGreaterThan(vertices * 30);
    expect(drawn).toBeLessThan((vertices + 7) * 90);
  }
});

test("colours by position go from corner to corner, and without light they are the same on all sides", async () => {
  await show("query Cube");
  await choose(page, "appearance", "Edges", "None");
  await field(page, "appearance", "Colouring").selectOption("position");
  await choose(page, "appearance", "Shading", "No light");
  await frontView(page);
  const picture = await stillScene(page);
  await takePicture(page, "scene-by-position");
  const half = 0.9 * halfSide(await sceneSize(page));
  const at = (right: number, up: number) =>
    picture.at(Math.round(picture.width / 2 + right * half), Math.round(picture.height / 2 - up * half));
  // Seen from the front, x goes to the right and z up; y is the least.
  const [lowLeft, lowRight, highLeft] = [at(-1, -1), at(1, -1), at(-1, 1)];
  expect(lowRight[0]).toBeGreaterThan(lowLeft[0] + 100);
  expect(highLeft[2]).toBeGreaterThan(lowLeft[2] + 100);
  expect(Math.abs(highLeft[1] - lowRight[1])).toBeLessThan(10);
});

test("meshes have the colours of their faces and vertices, as files give them", async () => {
  const columnsOf = async (name: string) => {
    await show(`query ${name}`);
    await choose(page, "appearance", "Edges", "None");
    await choose(page, "appearance", "Shading", "No light");
    await field(page, "appearance", "Colouring").selectOption({ label: "As in the file" });
    await page.getByTestId("legend").waitFor();
    const picture = await stillScene(page);
    await takePicture(page, `scene-elements-${name}`);
    const half = halfSide(await sceneSize(page));
    return [-0.9, -0.1, 0.1, 0.9].map((part) =>
      picture.at(Math.round(picture.width / 2 + part * half), Math.round(picture.height / 2)),
    );
  };
  const painted = await columnsOf("Painted");
  expect(painted.map((pixel) => [isReddish(pixel), isBluish(pixel)])).toEqual([
    [true, false],
    [true, false],
    [false, true],
    [false, true],
  ]);
  const faded = await columnsOf("Faded");
  expect([isReddish(faded[0]!), isBluish(faded[3]!)]).toEqual([true, true]);
  const reds = faded.map(([red]) => red);
  expect(reds).toEqual([...reds].sort((a, b) => b - a)); // it changes bit by bit
  expect(reds[1]).toBeGreaterThan(reds[2]!);
});

test("points have the chosen size and colour", async () => {
  await show("query Cloud");
  await press(page, "-"); // so that the toolbar covers no point
  await setColor(page, "appearance", "Object colour", "#ff0000");
  const pixels: number[] = [];
  for (const size of [4, 8, 16]) {
    await field(page, "appearance", "Point size").fill(String(size));
    pixels.push((await stillScene(page)).count(([r, g]) => r > 200 && g < 120));
  }
  pixels.forEach((count, i) => {
    const size = [4, 8, 16][i]!;
    const discs = (diameter: number): number => (5 * Math.PI * diameter ** 2) / 4;
    expect(count).toBeGreaterThan(discs(size - 1));
    expect(count).toBeLessThan(discs(size + 2));
  });
});

test("boundary edges are red, and can be hidden", async () => {
  await show("query Open");
  const isBoundary = isNear([216, 27, 58], 40);
  expect((await stillScene(page)).count(isBoundary)).toBeGreaterThan(500);
  await field(page, "display", "Boundary edges (red)").setChecked(false);
  expect((await stillScene(page)).count(isBoundary)).toBe(0);
});

test("non-manifold edges are violet, and can be hidden", async () => {
  await show("query Fan");
  const isNonManifold = isNear([177, 0, 214], 40);
  // The edge that three triangles share stands in the middle, as high as the picture.
  const { height } = await sceneSize(page);
  const seen = await stillScene(page);
  await takePicture(page, "appearance-non-manifold");
  expect(seen.count(isNonManifold)).toBeGreaterThan(height * 0.8);
  await field(page, "display", "Non-manifold edges (violet)").setChecked(false);
  expect((await stillScene(page)).count(isNonManifold)).toBe(0);
});

test("background, reset of each colour, reset of all", async () => {
  await show("query Cube");
  const before = await stillScene(page);
  await setColor(page, "appearance", "Background colour", "#00ff00");
  await setColor(page, "appearance", "Object colour", "#ff0000");
  expect((await stillScene(page)).count(isGreenish)).toBeGreaterThan(10_000);
  await page.getByRole("button", { name: "Reset Object colour" }).click();
  expect((await stillScene(page)).count(isReddish)).toBe(0);
  await page.getByRole("button", { name: "Reset Background colour" }).click();
  expect((await stillScene(page)).count(isGreenish)).toBe(0);
  await field(page, "appearance", "Opacity").fill("0.3");
  await page.getByRole("button", { name: "Reset appearance" }).click();
  await setColor(page, "appearance", "Background colour", "#ffffff");
  expect((await stillScene(page)).difference(before)).toBeLessThan(0.001);
});

test("boxes, grid, axes and scale are shown and hidden", async () => {
  await show("query Ball");
  let last = await stillScene(page);
  for (const [name, least] of [
    ["Bounding boxes", 300],
    ["Grid", 2000],
    ["Axes", 100],
    ["Scale bar", 100],
  ] as const) {
    await field(page, "display", name).setChecked(true);
    const next = await stillScene(page);
    expect(covered(next) - covered(last), name).toBeGreaterThan(least);
    last = next;
  }
  await takePicture(page, "scene-grid");
  for (const key of ["g", "Shift+X", "x", "Shift+G"]) await press(page, key);
  const bare = await stillScene(page);
  expect(covered(bare)).toBeLessThan(covered(last) - 2500);
});

test("exploded objects move apart, and stay in the picture", async () => {
  await show("query Row");
  await choose(page, "appearance", "Edges", "None");
  /** The part of the width of all objects that they cover. */
  const share = async (): Promise<number> => {
    const picture = await stillScene(page);
    const columns: number[] = [];
    for (let x = 0; x < picture.width; x++) {
      if (!isWhite(picture.at(x, Math.round(picture.height / 2)))) columns.push(x);
    }
    expect(Math.max(...columns)).toBeLessThan(picture.width - 3);
    return columns.length / (Math.max(...columns) - Math.min(...columns));
  };
  const together = await share();
  await choose(page, "display", "Objects", "Exploded");
  await field(page, "display", "Apart").fill("2");
  expect(await share()).toBeLessThan(together * 0.9);
});

test("several results are overlaid in different colours", async () => {
  await run(page, "query Cube");
  await run(page, "query Ball translate[makeVector3D(5, 0, 1)]");
  await stillScene(page);
  await plainScene(page);
  const overlay = page.getByRole("button", { name: "Overlay" });
  await overlay.click();
  await frontView(page);
  const picture = await stillScene(page);
  expect(picture.colors()).toBeGreaterThan(20);
  await takePicture(page, "scene-overlay");
});
