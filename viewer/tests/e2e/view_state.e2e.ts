/** What a view belongs to: it is cleared or placed anew with what is shown, and survives a reload, Back and undoing. */

import { expect, test } from "vitest";

import { ready, run, selectedRow, settled, stillScene } from "./support/actions";
import { takePicture } from "./support/browser";
import type { Picture } from "./support/picture";
import { choose, clickAt, field, halfSide, isNear, openSettings, press, sceneSize } from "./support/scene";
import { Session } from "./support/session";

const kCut = isNear([224, 121, 58], 20);

const session = new Session({
  statements: [
    "let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))",
    "let Far = createCube(makePoint3D(100, 0, 0), makePoint3D(104, 4, 4))",
    "let Two = intstream(0, 1) transformstream extend[Solid: createCube(makePoint3D(.Elem * 5, 0, 0), makePoint3D(.Elem * 5 + 2, 2, 2))] consume",
  ],
});

const tool = (name: string) => session.page.getByTestId("scene-tools").getByRole("button", { name });

/** The scene while the editor has not the focus: its keys are told over the scene. */
async function sceneOnly(): Promise<Picture> {
  await session.page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
  return stillScene(session.page);
}

async function reload(): Promise<void> {
  const { page } = session;
  await settled(page);
  await page.reload();
  await ready(page);
  await settled(page);
}

test("a section is placed anew in the middle of other things that are shown, and its cut turns to the eye", async () => {
  const { page } = session;
  await run(page, "query Cube");
  await press(page, "c");
  const readout = page.getByTestId("section-readout");
  await expect.poll(() => readout.innerText()).toContain("Section x = 1");
  await run(page, "query Far");
  await expect.poll(() => readout.innerText(), { timeout: 20_000 }).toMatch(/Section x = 102[\s\S]*area 16/);
  const picture = await stillScene(page);
  await takePicture(page, "state-section-anew");
  expect(picture.count(kCut)).toBeGreaterThan(0.02 * picture.width * picture.height);
  await openSettings(page);
  for (const axis of ["Y", "Z"]) {
    await page.getByTestId("section-panel").getByRole("button", { name: axis, exact: true }).click();
    await expect.poll(() => readout.innerText(), { timeout: 20_000 }).toContain("area 16");
    const cut = await stillScene(page);
    expect(cut.count(kCut)).toBeGreaterThan(0.02 * cut.width * cut.height);
  }
});

test("the same statement run again keeps its section", async () => {
  const { page } = session;
  await run(page, "query Cube");
  await press(page, "c");
  const readout = page.getByTestId("section-readout");
  await expect.poll(() => readout.innerText()).toContain("Section x = 1");
  await press(page, "PageUp");
  await expect.poll(() => readout.innerText()).toContain("Section x = 1.069");
  await run(page, "query Cube");
  await stillScene(page);
  expect(await readout.innerText()).toContain("Section x = 1.069");
});

test("measures and what is inspected go with their object, and come back with it", async () => {
  const { page } = session;
  await session.show("query Cube");
  const half = halfSide(await sceneSize(page));
  await press(page, "m");
  await clickAt(page, -half + 3, half - 3);
  await clickAt(page, half - 3, half - 3);
  await expect.poll(() => page.getByTestId("measure-value").innerText()).toBe("2");
  await press(page, "v");
  await clickAt(page, 40, 60);
  await page.getByTestId("inspected").waitFor();
  await run(page, "query Far");
  await stillScene(page);
  expect(await page.getByTestId("measure").count()).toBe(0);
  expect(await page.getByTestId("inspected").count()).toBe(0);
  const label = ([r, g, b]: readonly number[]) => r! > 200 && g! < 90 && b! > 90;
  expect((await stillScene(page)).count(label)).toBe(0);
  await page.getByTestId("result-tab").first().getByRole("button", { name: "Show Cube in 3D" }).click();
  await page.getByTestId("measure").waitFor();
  await page.getByTestId("result-tab").first().getByRole("button", { name: "Close Cube" }).click();
  await page.getByTestId("measure").waitFor({ state: "detached" });
  expect(await page.getByTestId("inspected").count()).toBe(0);
});

test("with its panel closed, a tool says what to click, what came of it, and how it ends", async () => {
  const { page } = session;
  await run(page, "query Cube");
  await stillScene(page);
  await press(page, "m");
  const readout = page.getByTestId("tool-readout");
  expect(await readout.innerText()).toContain("Click two points.");
  expect(await readout.innerText()).toContain("Esc ends");
  await clickAt(page, 0, 0);
  expect(await readout.innerText()).toContain("1 of 2 clicked");
  await clickAt(page, 40, 20);
  await expect.poll(() => readout.innerText()).toMatch(/Distance of two points: ≈ \d/);
  expect(await readout.locator("code").innerText()).toContain("query distance(");
  await takePicture(page, "state-measuring");
  await press(page, "Escape");
  await readout.waitFor({ state: "detached" });
  expect(await tool("Measure").getAttribute("aria-pressed")).toBe("false");
});

test("a reload keeps camera, colours, section, measures and the selected row, and runs nothing again", async () => {
  const { page } = session;
  await session.show("query Two");
  await choose(page, "appearance", "Edges", "All");
  await page.locator('[data-row="1"] [data-column="Elem"]').click();
  await press(page, "m");
  const { width } = await sceneSize(page); // the middle of the second cube is right of that of the scene
  await clickAt(page, 0.33 * width, 0);
  await clickAt(page, 0.33 * width + 40, 20);
  await expect.poll(() => page.getByTestId("measure-value").innerText()).toMatch(/\d/);
  const measured = await page.getByTestId("measure-value").innerText();
  await press(page, "c");
  const readout = page.getByTestId("section-readout");
  // Between the two.
  await expect.poll(() => readout.innerText()).toMatch(/x = 3.5[\s\S]*meets no solid/);
  await press(page, "ArrowLeft");
  await page.mouse.move(2, 2); // so that no coordinates are shown
  const before = await stillScene(page);
  const statements: string[] = [];
  page.on("request", (request) => {
    if (request.url().endsWith("/api/query")) statements.push(request.postData() ?? "");
  });
  await reload();
  const after = await stillScene(page);
  await takePicture(page, "state-reloaded");
  expect(await selectedRow(page)).toBe(1);
  await expect.poll(() => page.getByTestId("measure-value").innerText()).toBe(measured);
  await expect.poll(async () => (await stillScene(page)).difference(before)).toBeLessThan(0.002);
  expect(after.width).toBe(before.width);
  expect(statements.filter((body) => body.includes("query Two"))).toEqual([]);
});

test("results that the server has dropped are run again after a reload", async () => {
  const { page } = session;
  await session.show("query Cube feed");
  await session.show("query Two");
  const before = await stillScene(page);
  await settled(page);
  for (let count = 0; count < 70; count++) await session.server.run("query Cube");
  await reload();
  await page.getByTestId("result-tab").first().waitFor();
  expect(await page.getByTestId("link-dialog").count()).toBe(0);
  expect((await stillScene(page)).difference(before)).toBeLessThan(0.002);
});

test("Back and Forward go through what was shown", async () => {
  const { page } = session;
  await session.show("query Cube");
  const cube = await sceneOnly();
  await settled(page);
  await run(page, "query Two");
  const two = await sceneOnly();
  await settled(page);
  expect(two.difference(cube)).toBeGreaterThan(0.02);
  await page.goBack();
  await settled(page);
  await expect.poll(async () => (await sceneOnly()).difference(cube)).toBeLessThan(0.002);
  await page.goForward();
  await expect.poll(async () => (await sceneOnly()).difference(two)).toBeLessThan(0.002);
});

test("everything is undone and redone, but the editor has its own", async () => {
  const { page } = session;
  await session.show("query Cube");
  await settled(page);
  const first = await stillScene(page);
  await field(page, "appearance", "Object colour").fill("#ff0000");
  await settled(page);
  await press(page, "9");
  await settled(page);
  await press(page, "c");
  await settled(page);
  const last = await stillScene(page);
  await press(page, "Control+z");
  await page.getByTestId("section-readout").waitFor({ state: "detached" });
  await press(page, "Control+z");
  await press(page, "Control+z");
  await expect.poll(async () => (await stillScene(page)).difference(first)).toBeLessThan(0.002);
  for (let count = 0; count < 3; count++) await press(page, "Control+Shift+z");
  await page.getByTestId("section-readout").waitFor();
  await expect.poll(async () => (await stillScene(page)).difference(last)).toBeLessThan(0.002);
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+A");
  await page.keyboard.insertText("query nothing");
  await page.keyboard.press("Control+z");
  expect(await page.locator(".cm-content").innerText()).not.toContain("nothing");
  expect(await page.getByTestId("section-readout").count()).toBe(1);
});

test("hidden and ghosted objects are part of what is undone", async () => {
  const { page } = session;
  await session.show("query Two");
  const both = await stillScene(page);
  await settled(page);
  const { width } = await sceneSize(page);
  await clickAt(page, -0.35 * width, 0);
  await press(page, "i");
  await settled(page);
  expect((await stillScene(page)).difference(both)).toBeGreaterThan(0.05);
  await press(page, "Control+z");
  await press(page, "Escape");
  await page.mouse.move(2, 2); // so that no coordinates are shown
  await expect.poll(async () => (await stillScene(page)).difference(both)).toBeLessThan(0.002);
});

test("a reload in the moment after a change does not lose it", async () => {
  const { page } = session;
  await session.show("query Cube");
  await settled(page);
  await press(page, "c");
  await page.getByTestId("section-readout").waitFor();
  await page.reload();
  await ready(page);
  await page.getByTestId("section-readout").waitFor();
});
