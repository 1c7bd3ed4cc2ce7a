import { expect, test } from "vitest";

import { run, stillScene } from "./support/actions";
import { takePicture } from "./support/browser";
import type { Picture } from "./support/picture";
import { choose, plainScene, press } from "./support/scene";
import { Session } from "./support/session";

const session = new Session({ statements: [] });

const cube = (size: string) =>
  `query createCube(makePoint3D(0, 0, 0), makePoint3D(${size}, ${size}, ${size}))`;
const isObject = ([red, green, blue]: readonly number[]) => red! + green! + blue! < 700;
const isBlack = ([red, green, blue]: readonly number[]) => red! + green! + blue! < 24;

/** Pixels below the toolbar, from `left` to `right` as shares of the width. */
function pixels(picture: Picture, left = 0, right = 1): (readonly number[])[] {
  const found: (readonly number[])[] = [];
  for (let y = 60; y < picture.height; y++)
    for (let x = Math.round(left * picture.width); x < Math.round(right * picture.width) - 1; x++)
      found.push(picture.at(x, y));
  return found;
}

const objects = (picture: Picture) => pixels(picture).filter(isObject).length;

async function pictureOf(statement: string, name: string): Promise<Picture> {
  const { page } = session;
  await run(page, statement);
  await stillScene(page);
  await plainScene(page);
  const picture = await stillScene(page);
  await takePicture(page, name);
  return picture;
}

test("cubes of any size look the same, smooth and flat", async () => {
  const { page } = session;
  const expected: Picture[] = [];
  for (const size of ["1", "1e20", "1e36", "1e-20", "1e-29"]) {
    const smooth = await pictureOf(cube(size), `extremes-${size}`);
    await choose(page, "appearance", "Shading", "Flat");
    const flat = await stillScene(page);
    await choose(page, "appearance", "Shading", "Smooth");
    if (expected.length === 0) {
      expected.push(smooth, flat);
      expect(objects(smooth)).toBeGreaterThan(0.15 * smooth.width * smooth.height);
      expect(pixels(smooth).filter(isBlack).length).toBeLessThan(100);
    }
    expect(smooth.difference(expected[0]!), `${size}, smooth`).toBeLessThan(0.005);
    expect(flat.difference(expected[1]!), `${size}, flat`).toBeLessThan(0.005);
  }
});

test("what is too small for floats is a dot in the middle", async () => {
  for (const size of ["1e-40", "1e-160"]) {
    const picture = await pictureOf(cube(size), `extremes-${size}`);
    const dot = objects(picture);
    expect(dot).toBeGreaterThan(8);
    expect(dot).toBeLessThan(400);
    expect(isObject(picture.at(picture.width / 2, picture.height / 2))).toBe(true);
  }
});

test("a point far away is looked at from the standard side", async () => {
  const { page } = session;
  const picture = await pictureOf("query makePoint3D(1e17, 1e17, 0)", "extremes-far-point");
  expect(objects(picture)).toBeGreaterThan(8);
  await page.getByLabel("Axes", { exact: true }).setChecked(true);
  const axes = (picture: Picture) => pixels(picture, 0, 0.2);
  const before = axes(await stillScene(page));
  expect(before.filter(isObject).length).toBeGreaterThan(100);
  await press(page, "9");
  const after = axes(await stillScene(page));
  // They would turn if the camera had looked from elsewhere; the last digits of far places are not seen.
  const moved = after.filter((color, i) => color.some((part, k) => Math.abs(part - before[i]![k]!) > 100));
  expect(moved.length).toBeLessThan(20);
});

const row =
  "query intstream(1, 8) transformstream extend[S: createCube(makePoint3D(.Elem * 3, 0, 0), makePoint3D(.Elem * 3 + 2, 2, 2))] project[S] consume";

test("one object far from the others does not make them dots", async () => {
  const { page } = session;
  const alone = await pictureOf(row, "extremes-row");
  const far = row
    .replace("[S: create", "[D: ifthenelse(.Elem = 8, 1000000000, 0)] extend[S: create")
    .replaceAll(".Elem * 3", "(.Elem * 3 + .D)");
  const picture = await pictureOf(far, "extremes-far-object");
  expect(objects(picture)).toBeGreaterThan(0.7 * objects(alone));
  const line = page.getByTestId("scene-far");
  expect(await line.innerText()).toContain("1 object is far from the others.");
  await line.getByRole("button", { name: "Show all" }).click();
  await line.waitFor({ state: "detached" });
  const all = await stillScene(page);
  expect(objects(all)).toBeLessThan(200);
});

test("a new object far away does not take the others out of sight", async () => {
  const { page } = session;
  await run(page, row);
  await stillScene(page);
  await plainScene(page);
  const before = await stillScene(page);
  await page.getByRole("button", { name: "Overlay" }).click();
  await run(page, "query createCube(makePoint3D(1e8, 0, 0), makePoint3D(100000002, 2, 2))");
  await page.getByTestId("scene-far").waitFor();
  expect((await stillScene(page)).difference(before)).toBeLessThan(0.05);
  const eye = page.getByRole("button", { name: /^Show create.* in 3D/ }).first();
  await eye.click();
  await page.getByTestId("scene-far").waitFor({ state: "detached" });
  await eye.click();
  await page.getByTestId("scene-far").waitFor();
  // Taken away, there is nothing far any more.
  await page.getByRole("button", { name: /^Close create/ }).click();
  await page.getByTestId("scene-far").waitFor({ state: "detached" });
});

test("a cube far from the origin looks like one at the origin", async () => {
  const { page } = session;
  const cubeAt = (far: string) => {
    const low = `makePoint3D(${far}, ${far}, 0 - ${far})`;
    return `query createCube(${low}, makePoint3D(${far} + 1, ${far} + 1, 1 - ${far}))`;
  };
  const expected = await pictureOf(cubeAt("0.0"), "extremes-at-0");
  for (const far of ["1e12", "1e15"]) {
    const picture = await pictureOf(cubeAt(far), `extremes-at-${far}`);
    expect(picture.difference(expected), far).toBeLessThan(0.005);
  }
  // The section cuts it where it is, and the pointer finds it.
  await press(page, "c");
  await page.getByTestId("cut-area").waitFor();
  expect(await page.getByTestId("cut-area").innerText()).toBe("1");
  const halved = await stillScene(page);
  await takePicture(page, "extremes-far-section");
  expect(halved.difference(expected)).toBeGreaterThan(0.05);
});

test("two cubes far apart are seen as two dots, which can be picked", async () => {
  const { page } = session;
  const one = "createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1))";
  const other = "createCube(makePoint3D(1e12, 0, 0), makePoint3D(1e12 + 1, 1, 1))";
  const both = `query intstream(0, 1) transformstream extend[S: ifthenelse(.Elem = 0, ${one}, ${other})] project[S] consume`;
  for (const [statement, name] of [
    [both, "rows"],
    [`query ${one} union ${other}`, "one"],
  ] as const) {
    await run(page, statement);
    await stillScene(page);
    await plainScene(page);
    await choose(page, "navigation", "Projection", "Orthographic");
    await press(page, "1");
    await press(page, "f");
    const picture = await stillScene(page);
    await takePicture(page, `extremes-far-apart-${name}`);
    const left = pixels(picture, 0, 0.2).filter(isObject).length;
    const right = pixels(picture, 0.8, 1).filter(isObject).length;
    for (const dot of [left, right]) {
      expect(dot).toBeGreaterThanOrEqual(8);
      expect(dot).toBeLessThan(40);
    }
    expect(pixels(picture, 0.2, 0.8).filter(isObject)).toEqual([]);
  }
});
