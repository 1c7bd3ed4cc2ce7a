/** The pictures of the README, which scripts/draw-viewer-pictures copies from the artifacts. */

import { afterAll, beforeAll, beforeEach, expect, test } from "vitest";
import type { Page } from "playwright-core";

import { ready, run, stillScene } from "./support/actions";
import { Browser, takePicture } from "./support/browser";
import { field, openSettings, press } from "./support/scene";
import { Server } from "./support/server";

const kPlace = "makePoint3D(80 * (.Elem mod 6), 80 * (.Elem div 6), 0)";
const kBelow = "makePoint3D(80 * (.Elem mod 6), 80 * (.Elem div 6), -1)";

let server: Server;
let browser: Browser;
let page: Page;

beforeAll(async () => {
  server = await Server.start([
    `let Flanges = intstream(0, 23) transformstream extend[Solid: (createCylinder(${kPlace}, 14 + .Elem, 6, 64) union createCylinder(${kPlace}, 10, 12 + 2 * .Elem, 64)) minus createCylinder(${kBelow}, 6, 80, 48)] extend[Volume: volume(.Solid)] consume`,
    "let Body = createCylinder(makePoint3D(0, 0, 0), 30, 8, 96) union createCylinder(makePoint3D(0, 0, 0), 18, 40, 96) union createSphere(makePoint3D(0, 0, 40), 18, 64)",
    "let Hole = createCylinder(makePoint3D(24, 0, -1), 3, 10, 48)",
    "let Holes = intstream(0, 5) transformstream extend[H: Hole rotate[makePoint3D(0, 0, 0), makeVector3D(0, 0, 1), 60.0 * .Elem]] aggregateB[H; fun(a: volume3d, b: volume3d) a union b; Hole]",
    "let Housing = (Body minus createSphere(makePoint3D(0, 0, 40), 13, 64)) minus createCylinder(makePoint3D(0, 0, -1), 9, 34, 64) minus Holes",
  ]);
  browser = await Browser.start({ theme: "light", width: 1280, height: 800 });
});

afterAll(async () => {
  await browser.end();
  await server.remove();
});

beforeEach(async () => {
  page = await browser.open(server.url);
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.evaluate(() => localStorage.clear());
  await page.reload();
  await ready(page);
});

test("a relation, its table and its solids, coloured by a number", async () => {
  await run(page, "query Flanges feed sortby[Volume] consume");
  await stillScene(page);
  await openSettings(page);
  await field(page, "appearance", "Colouring").selectOption("attribute");
  await field(page, "appearance", "Attribute").selectOption("Volume");
  await page.getByRole("button", { name: "Settings of the view" }).click();
  await press(page, "9");
  expect((await stillScene(page)).colors()).toBeGreaterThan(50);
  await takePicture(page, "viewer-parts");
});

test("the exact section of a solid", async () => {
  await run(page, "query Housing");
  await press(page, "9");
  await press(page, "c");
  await page.getByTestId("section-panel").getByRole("button", { name: "Y", exact: true }).click();
  await page.getByTestId("cut-area").waitFor();
  expect((await stillScene(page)).colors()).toBeGreaterThan(50);
  await takePicture(page, "viewer-section");
});
