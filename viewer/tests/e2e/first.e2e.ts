import { afterAll, beforeAll, expect, test } from "vitest";
import { Browser, takeElement, takePicture } from "./support/browser";
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

test("WebGL lives, and the composed screenshot shows a solid", async () => {
  const page = await browser.open(server.url);
  const living = await page.evaluate(() => {
    const context = document.createElement("canvas").getContext("webgl2");
    return context !== null && !context.isContextLost();
  });
  expect(living).toBe(true);
  await page.getByTestId("objects").getByText("Cube").click();
  await page.getByTestId("result-tab").waitFor();
  await page.waitForTimeout(1500);
  const picture = await takeElement(page, '[data-testid="scene"]', "first-cube");
  expect(picture.colors()).toBeGreaterThan(20);
  await takePicture(page, "first-page");
  expect(browser.errors).toEqual([]);
});
