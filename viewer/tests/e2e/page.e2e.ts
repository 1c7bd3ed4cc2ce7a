/** Small things of the page that were seen to be wrong, each with what is expected. */

import { expect, test } from "vitest";

import { run, settled, stillScene } from "./support/actions";
import { takePicture } from "./support/browser";
import { boxOf } from "./support/actions";
import { choose, field, isNear, kScene, openSettings, press } from "./support/scene";
import { Session } from "./support/session";

const session = new Session({
  browser: { width: 1280, height: 720 },
  statements: [
    "let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))",
    'let Row = intstream(1, 40) transformstream extend[File: "parts/of/the/machine/part" + num2string(.Elem) + ".stl", Solid: createCube(makePoint3D(3 * .Elem, 0, 0), makePoint3D(3 * .Elem + 2, 2, 2))] consume',
    "let Pair = (createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))) union (createCube(makePoint3D(9, 0, 0), makePoint3D(11, 2, 2)))",
  ],
});

test("with everything open, the scene has half of a page of 1280 by 720", async () => {
  const { page } = session;
  await run(page, "query Row");
  await openSettings(page);
  const { width, height } = await boxOf(page, kScene);
  expect(width * height).toBeGreaterThanOrEqual(0.5 * 1280 * 720);
  expect(await page.locator(".table-row").first().isVisible()).toBe(true);
  await takePicture(page, "page-everything");
});

test("no part of the page scrolls away when a tool opens its settings", async () => {
  const { page } = session;
  await run(page, "query Cube");
  await stillScene(page);
  await press(page, "c");
  await page.getByTestId("section-readout").getByRole("button").click();
  await press(page, "m");
  await page.getByRole("button", { name: "All measures" }).click();
  await page.getByTestId("measure-panel").getByLabel("What").waitFor();
  const scrolled = await page.evaluate(() =>
    [document.scrollingElement!, document.querySelector("#app")!, document.querySelector(".page")!].map(
      (element) => element.scrollTop,
    ),
  );
  expect(scrolled).toEqual([0, 0, 0]);
  // Nothing reaches over the page, so that nothing can scroll it.
  expect(await page.evaluate(() => document.body.scrollHeight - innerHeight)).toBe(0);
  expect((await boxOf(page, ".top-bar")).y).toBe(0);
});

test("the field of the background shows the colour of the theme, also after it has changed", async () => {
  const { page } = session;
  await openSettings(page);
  const background = field(page, "appearance", "Background colour");
  const light = await background.inputValue();
  await page.emulateMedia({ colorScheme: "dark", reducedMotion: "reduce" });
  await expect.poll(() => background.inputValue()).not.toBe(light);
});

test("choosing a row leaves its surroundings in sight, and a key leads back to the view before", async () => {
  const { page } = session;
  await session.show("query Row");
  const before = await stillScene(page);
  for (let count = 0; count < 14; count++) await press(page, "+");
  await page.locator('[data-row="1"] [data-column="Elem"]').click();
  await page.mouse.move(2, 2);
  const near = await stillScene(page);
  await takePicture(page, "page-row");
  const outline = near.count(([r, g, b]) => r > 230 && g > 130 && g < 190 && b < 60);
  expect(outline).toBeGreaterThan(50);
  const object = near.count(([, , b]) => b < 235);
  expect(object).toBeLessThan(0.5 * near.width * near.height);
  await press(page, "Escape");
  await press(page, "Home");
  await expect.poll(async () => (await stillScene(page)).difference(before)).toBeLessThan(0.005);
  await press(page, "9");
  expect((await stillScene(page)).difference(before)).toBeGreaterThan(0.001);
  await press(page, "Backspace");
  await expect.poll(async () => (await stillScene(page)).difference(before)).toBeLessThan(0.005);
});

test("components stay in the picture when they are moved apart, and nothing is told of what was divided", async () => {
  const { page } = session;
  await session.show("query Pair");
  await press(page, "n");
  await page.getByRole("button", { name: "Split into components" }).click();
  await expect.poll(() => page.getByTestId("table").getAttribute("aria-rowcount")).toBe("3");
  expect(await page.getByTestId("object-panel").innerText()).toContain("Click an object");
  await stillScene(page);
  await press(page, "d");
  const picture = await stillScene(page);
  await takePicture(page, "page-components");
  const isObject = ([r, g, b]: readonly number[]) => r! < 200 && g! < 230 && b! < 240;
  expect(picture.count(isObject)).toBeGreaterThan(1000);
  const edge = Array.from({ length: picture.height }, (_, y) => [
    picture.at(2, y),
    picture.at(picture.width - 3, y),
  ]);
  expect(edge.flat().some(isObject)).toBe(false);
});

test("of files in one folder the table shows what tells them apart, and all columns are seen", async () => {
  const { page } = session;
  await run(page, "query Row");
  const cell = page.locator('[data-row="0"] [data-column="File"]');
  expect(await cell.innerText()).toMatch(/^…\/\s*part1\.stl$/);
  const [table, solid] = [
    await boxOf(page, '[data-testid="table"]'),
    await boxOf(page, '[data-row="0"] [data-column="Solid"]'),
  ];
  expect(solid.x + solid.width).toBeLessThanOrEqual(table.x + table.width + 1);
});

test("the times of explain are in sight", async () => {
  const { page } = session;
  await run(page, "explain query Row feed filter[volume(.Solid) > 3.0] extend[A: area(.Solid)] count");
  const [table, last] = [
    await boxOf(page, '[data-testid="table"]'),
    await boxOf(page, '.column-head[title^="Milliseconds"]'),
  ];
  expect(last.x + last.width).toBeLessThanOrEqual(table.x + table.width + 1);
});

test("a legend of many names is in the order of numbers, and says what grey is", async () => {
  const { page } = session;
  await run(page, "query Row");
  await page.getByRole("button", { name: "Colour the objects by File" }).click();
  const legend = page.getByTestId("legend");
  await expect.poll(() => legend.innerText()).toMatch(/part1\.stl[\s\S]*part2\.stl[\s\S]*part3\.stl/);
  expect(await legend.innerText()).toMatch(/grey: \d+ with other values/);
  const blue = isNear([31, 119, 180], 60);
  expect((await stillScene(page)).count(blue)).toBeGreaterThan(0);
});

test("the list of operators is completed with words for what stands in them", async () => {
  const { page } = session;
  await page.locator(".cm-content").click();
  await page.keyboard.type("query Row feed filt");
  const entry = page.locator(".cm-tooltip-autocomplete li", { hasText: "filter" }).first();
  await entry.waitFor();
  expect(await entry.innerText()).not.toContain("STREAMELEM");
  expect(await page.locator(".cm-completionIcon").count()).toBe(0);
});

test("grid numbers say of which axis they are", async () => {
  const { page } = session;
  await session.show("query Cube");
  await choose(page, "appearance", "Edges", "None");
  await field(page, "display", "Grid").setChecked(true);
  await stillScene(page);
  await takePicture(page, "page-grid");
  await settled(page);
});
