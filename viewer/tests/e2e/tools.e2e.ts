import { readFileSync } from "node:fs";
import { beforeEach, expect, test } from "vitest";
import type { Page } from "playwright-core";

import { run, stillScene } from "./support/actions";
import { takeElement, takePicture } from "./support/browser";
import { readPng } from "./support/picture";
import {
  choose,
  clickAt,
  covered,
  drag,
  field,
  halfSide,
  isNear,
  kScene,
  openSettings,
  press,
  sceneSize,
} from "./support/scene";
import { Session } from "./support/session";

const kCut = isNear([224, 121, 58], 20);

const session = new Session({
  statements: [
    "let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))",
    "let Hollow = Cube minus createCube(makePoint3D(0.5, 0.5, 0.5), makePoint3D(1.5, 1.5, 1.5))",
    "let Two = intstream(0, 1) transformstream extend[Solid: createCube(makePoint3D(.Elem * 5, 0, 0), makePoint3D(.Elem * 5 + 2, 2, 2))] consume",
  ],
});

let page: Page;

beforeEach(() => {
  page = session.page;
});

const show = (statement: string) => session.show(statement);

test("the section is exact: its area comes from the database, and its cut is filled", async () => {
  await show("query Hollow");
  await press(page, "c");
  await page.getByTestId("section-panel").getByRole("button", { name: "Y", exact: true }).click();
  // The cut is turned to the eye by itself.
  const area = page.getByTestId("cut-area");
  await expect.poll(() => area.innerText(), { timeout: 20_000 }).toBe("3");
  await field(page, "section", "Show the plane").setChecked(false);
  const picture = await stillScene(page);
  const side = 2 * halfSide(await sceneSize(page));
  // A frame: 3 of 4 square units, less what the toolbar and the area of the section cover.
  expect(picture.count(kCut)).toBeGreaterThan(side * side * 0.75 * 0.8);
  expect(picture.count(kCut)).toBeLessThan(side * side * 0.75 * 1.02);
  await takePicture(page, "section");
});

test("the cut becomes a region", async () => {
  await show("query Hollow");
  await press(page, "c");
  await page.getByTestId("cut-area").waitFor();
  await page.getByRole("button", { name: "As region" }).click();
  const table = page.getByTestId("table");
  await expect.poll(() => table.innerText(), { timeout: 20_000 }).toContain("region");
});

test("the handle of the section plane moves it", async () => {
  await show("query Cube");
  await press(page, "c");
  await page.getByTestId("cut-area").waitFor();
  const before = await field(page, "section", "Position").last().inputValue();
  const { width, height } = await sceneSize(page);
  // The handle lies along x by 0.18 of the diagonal of the box.
  const tip = (2 * Math.sqrt(3) * 0.18 * halfSide({ width, height })) / 1;
  await drag(page, [width / 2 + tip, height / 2], [-60, 0]);
  const after = await field(page, "section", "Position").last().inputValue();
  const moved = Number(before) - Number(after);
  expect(moved).toBeCloseTo(60 / halfSide({ width, height }), 1);
});

test("with Shift the handle tilts the section plane, and the cut is computed anew", async () => {
  await session.show("query Cube");
  await press(page, "c");
  const area = page.getByTestId("cut-area");
  await expect.poll(() => area.innerText(), { timeout: 20_000 }).toBe("4");
  const { width, height } = await sceneSize(page);
  const tip = 2 * Math.sqrt(3) * 0.18 * halfSide({ width, height });
  await drag(page, [width / 2 + tip, height / 2], [0, -tip / 2], { keys: ["Shift"] });
  // The normal leans from x towards z by a half, so that the cut through the middle is longer by the root of 1.25.
  await expect.poll(async () => Number(await area.innerText()), { timeout: 20_000 }).toBeGreaterThan(4.2);
  expect(Math.abs(Number(await area.innerText()) - 4 * Math.sqrt(1.25))).toBeLessThan(0.2);
  await takePicture(page, "section-tilted");
});

test("the distance of two vertices is that of the database, exactly", async () => {
  await show("query Cube");
  const half = halfSide(await sceneSize(page));
  await press(page, "m");
  await clickAt(page, -half + 3, half - 3);
  await clickAt(page, half - 3, half - 3);
  const value = page.getByTestId("measure-value");
  await expect.poll(() => value.innerText(), { timeout: 20_000 }).toBe("2");
  const statement = await page.getByTestId("measure").locator("code").innerText();
  expect(statement).toMatch(/^query distance\(\(vertices\(\$a\) filter\[.Id = \d+\] extract\[Position\]\), /);
  await takePicture(page, "measure");
});

test("a point on a face is measured, and said to be rounded", async () => {
  await show("query Cube");
  const half = halfSide(await sceneSize(page));
  await press(page, "m");
  await clickAt(page, -half / 2, 0.1 * half);
  await clickAt(page, half / 2, 0.1 * half);
  const value = page.getByTestId("measure-value");
  await expect.poll(() => value.innerText(), { timeout: 20_000 }).toMatch(/^≈ (1|0\.99|1\.00)/);
});

test("angles, areas, volumes and distances of objects", async () => {
  await show("query Two");
  await press(page, "m");
  const { width } = await sceneSize(page);
  // Two cubes from 0 to 2 and from 5 to 7 of 7 units, in the width of the view.
  const unit = width / 1.08 / 7;
  const place = (x: number): number => (x - 3.5) * unit;
  const what = field(page, "measure", "What");
  const value = page.getByTestId("measure-value").last();
  for (const [kind, places, expected] of [
    ["objects", [1.2, 6.2], "3"],
    ["faceAngle", [1.2, 6.2], "0°"],
    ["faceArea", [1.2], "2"],
    ["area", [1.2], "24"],
    ["volume", [6.2], "8"],
  ] as const) {
    await what.selectOption(kind);
    for (const x of places) await clickAt(page, place(x), 8);
    await expect.poll(() => value.innerText(), { timeout: 20_000 }).toBe(expected);
  }
  await what.selectOption("angle");
  const half = unit;
  await clickAt(page, place(0) + 3, half - 3);
  await clickAt(page, place(2) - 3, half - 3);
  await clickAt(page, place(2) - 3, -half + 3);
  await expect.poll(() => value.innerText(), { timeout: 20_000 }).toBe("90°");
});

test("a triangle and a vertex are inspected", async () => {
  await show("query Cube");
  await press(page, "v");
  await clickAt(page, 40, 60);
  const facts = page.getByTestId("inspected");
  const text = await facts.innerText();
  expect(text).toMatch(/Triangle\s+\d+/);
  expect(text).toMatch(/Area\s+2/);
  expect(text).toMatch(/Normal\s+-?0\s+-1\s+-?0/);
  const half = halfSide(await sceneSize(page));
  await clickAt(page, half - 3, half - 3);
  await expect.poll(() => facts.innerText()).toMatch(/Vertex\s+\d+\s+Place\s+2\s+0\s+0/);
});

test("coordinates under the pointer are shown", async () => {
  await show("query Cube");
  const { width, height } = await sceneSize(page);
  const half = halfSide({ width, height });
  await page.locator(kScene).hover({ position: { x: width / 2 + half / 2, y: height / 2 } });
  const readout = page.getByTestId("pointer-readout");
  await expect.poll(() => readout.innerText()).toMatch(/x 1\.(49|5)\d*\s+y 0\s+z (0\.99|1)/);
  await page.locator(kScene).hover({ position: { x: 5, y: height - 5 } });
  await expect.poll(() => readout.count()).toBe(0);
});

test("lights are switched, added, moved by mouse and fields, and deleted", async () => {
  await show("query Cube");
  await choose(page, "appearance", "Edges", "None");
  const lit = await stillScene(page);
  await field(page, "lights", "Global light").setChecked(false);
  const dark = await stillScene(page);
  const { width, height } = await sceneSize(page);
  const middle = [Math.round(width / 2), Math.round(height / 2)] as const;
  expect(dark.at(...middle).every((part) => part < 20)).toBe(true);
  expect(lit.at(...middle).every((part) => part > 60)).toBe(true);
  const panel = page.getByTestId("lights-panel");
  await panel.getByRole("button", { name: "Add light" }).click();
  await field(page, "lights", "Position X").fill("1");
  await field(page, "lights", "Position Y").fill("-3");
  await field(page, "lights", "Position Z").fill("1");
  await page.evaluate(() => (document.activeElement as HTMLElement).blur());
  const lamp = await stillScene(page);
  expect(lamp.at(middle[0] + 40, middle[1] + 60)[0]).toBeGreaterThan(80);
  // With Ctrl it is dragged from anywhere.
  await drag(page, [60, height - 60], [80, 0], { keys: ["Control"] });
  const x = Number(await field(page, "lights", "Position X").inputValue());
  expect(x).toBeCloseTo(1 + 80 / halfSide({ width, height }), 1);
  await takePicture(page, "lights");
  await panel.getByRole("button", { name: "Delete Light 1" }).click();
  expect(await panel.getByRole("listitem").count()).toBe(0);
});

test("screenshots are pictures, also with a transparent background", async () => {
  await show("query Cube");
  for (const [key, transparent] of [
    ["F12", false],
    ["Control+F12", true],
  ] as const) {
    const [download] = await Promise.all([page.waitForEvent("download"), press(page, key)]);
    const bytes = readFileSync(await download.path());
    expect(download.suggestedFilename()).toMatch(/\.png$/);
    const picture = readPng(bytes);
    const { width, height } = await sceneSize(page);
    expect(picture.width).toBeGreaterThanOrEqual(Math.floor(width));
    expect(picture.height).toBeGreaterThanOrEqual(Math.floor(height));
    expect(picture.colors()).toBeGreaterThan(2);
    // The policy of the page forbids data: addresses, so that the bytes go there as numbers.
    const alpha = await page.evaluate(
      async (numbers) => {
        const image = await createImageBitmap(new Blob([new Uint8Array(numbers)], { type: "image/png" }));
        const context = new OffscreenCanvas(image.width, image.height).getContext("2d")!;
        context.drawImage(image, 0, 0);
        const at = (x: number, y: number): number => context.getImageData(x, y, 1, 1).data[3]!;
        return [at(3, image.height - 3), at(Math.floor(image.width / 2), Math.floor(image.height / 2))];
      },
      [...bytes],
    );
    expect(alpha).toEqual([transparent ? 0 : 255, 255]);
  }
});

test("closing the section shows the whole object again", async () => {
  await show("query Cube");
  const whole = await stillScene(page);
  await takeElement(page, kScene, "section-before");
  await press(page, "c");
  await page.getByTestId("cut-area").waitFor();
  expect(covered(await stillScene(page))).toBeLessThan(covered(whole) * 0.8);
  await press(page, "c");
  const again = await stillScene(page);
  await takeElement(page, kScene, "section-after");
  expect(again.difference(whole)).toBeLessThan(0.001);
});

test("panels are worked by keyboard alone", async () => {
  await run(page, "query Cube");
  await openSettings(page);
  await field(page, "display", "Grid").focus();
  await page.keyboard.press("Space");
  expect(await field(page, "display", "Grid").isChecked()).toBe(true);
  await page.keyboard.press("Tab");
  expect(
    await field(page, "display", "Scale bar").evaluate((element) => element === document.activeElement),
  ).toBe(true);
});
