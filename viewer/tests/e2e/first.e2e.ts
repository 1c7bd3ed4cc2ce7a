import { afterAll, beforeAll, expect, test } from "vitest";
import { clickMiddle, expectNoErrors, ready, stillScene } from "./support/actions";
import { Browser, takePicture } from "./support/browser";
import { isNear } from "./support/picture";
import { Server } from "./support/server";

let server: Server;
let browser: Browser;

beforeAll(async () => {
  server = await Server.start(["let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))"]);
  browser = await Browser.start();
});

afterAll(async () => {
  await browser.end();
  await server.remove();
});

test("WebGL lives", async () => {
  const page = await browser.open(server.url);
  const living = await page.evaluate(() => {
    const context = document.createElement("canvas").getContext("webgl2");
    return context !== null && !context.isContextLost();
  });
  expect(living).toBe(true);
});

test("the composed screenshot shows the object that was clicked", async () => {
  const page = await browser.open(server.url);
  await ready(page);
  const empty = await stillScene(page);
  await page.getByTestId("objects").getByText("Cube").click();
  await page.getByTestId("result-tab").waitFor();
  const picture = await stillScene(page);
  await takePicture(page, "first-page");
  expect(picture.colors()).toBeGreaterThan(10);
  expect(picture.difference(empty)).toBeGreaterThan(0.1);
  const ground = picture.at(4, 4);
  expect(isNear(picture.at(picture.width / 2, picture.height / 2), ground)).toBe(false);
  expect(isNear(picture.at(picture.width - 5, 4), ground)).toBe(true);
  expectNoErrors(browser.errors);
});

test("from above, a cube in parallel projection is a square", async () => {
  const page = await browser.open(server.url);
  await ready(page);
  await page.getByTestId("objects").getByText("Cube").click();
  await stillScene(page);
  // A click gives the scene the keyboard; Escape takes the selection away again.
  await clickMiddle(page);
  for (const key of ["Escape", "7", "5", "Home"]) await page.keyboard.press(key);
  const picture = await stillScene(page);
  await takePicture(page, "first-top");
  const { width, height } = picture;
  const ground = picture.at(4, 4);
  const isGround = (x: number, y: number) => isNear(picture.at(x, y), ground, 12);
  // From a point outwards to the ground; beyond it lie other things, such as the toolbar.
  const reach = (x: number, dx: number, dy: number) => {
    let steps = 0;
    while (steps < height / 2 && !isGround(x + dx * steps, height / 2 + dy * steps)) steps++;
    return steps;
  };
  const wide = reach(width / 2, 1, 0) + reach(width / 2, -1, 0);
  // Beside the coordinates that are shown below the middle.
  const high = reach(width / 2 + 165, 0, 1) + reach(width / 2 + 165, 0, -1);
  expect(wide).toBeGreaterThan(100);
  expect(Math.abs(wide - high)).toBeLessThan(6);
});
