// The two pictures of the README: an assembly coloured by volume, and a mesh beside its limit surface.
import { afterAll, beforeAll, expect, test } from "vitest";
import type { Page } from "playwright-core";
import { ready, run, stillScene } from "./support/actions";
import { Browser, takePicture } from "./support/browser";
import { Server } from "./support/server";

const hole = (x: number, y: number) => `createCylinder(makePoint3D(${x}, ${y}, -1), 3.2, 8, 48)`;
const box = (from: string, to: string) => `createCube(makePoint3D(${from}), makePoint3D(${to}))`;
const bolt = (z: number, size: string) =>
  `createCylinder(makePoint3D(10 + (.Elem mod 2) * 40, 10 + (.Elem div 2) * 20, ${z}), ${size})`;

const statements = [
  `let Plate = (((${box("0, 0, 0", "60, 40, 5")} minus ${hole(10, 10)}) minus ${hole(50, 10)}) minus ${hole(10, 30)}) minus ${hole(50, 30)}`,
  `let Bracket = (${box("18, 12, 5", "42, 28, 8")} union ${box("18, 12, 5", "21, 28, 26")}) minus (createCylinder(makePoint3D(0, 20, 17), 4, 40, 48) rotate[makePoint3D(0, 20, 17), makeVector3D(0, 1, 0), 90])`,
  `let Assembly = intstream(1, 1) transformstream projectextend[; Name: "plate", Solid: Plate] intstream(1, 1) transformstream projectextend[; Name: "bracket", Solid: Bracket] concat intstream(0, 3) transformstream projectextend[; Name: "bolt " + num2string(.Elem + 1), Solid: ${bolt(5, "5.5, 4, 6")} union ${bolt(-12, "3, 17, 48")}] concat consume`,
  `let Cube = ${box("0, 0, 0", "2, 2, 2")}`,
];

let server: Server;
let browser: Browser;
let page: Page;

beforeAll(async () => {
  server = await Server.start(statements);
  browser = await Browser.start({ width: 1360, height: 820 });
  page = await browser.open(server.url);
  await ready(page);
});

afterAll(async () => {
  await browser.end();
  await server.remove();
});

test("an assembly, coloured by the volumes of its parts", async () => {
  await run(
    page,
    "query Assembly feed\n  extend[Volume: volume(.Solid), Area: area(.Solid)]\n  sortby[Volume desc] consume;",
  );
  await page.getByRole("button", { name: "Colour the objects by Volume" }).click();
  const scene = await stillScene(page);
  const picture = await takePicture(page, "readme-parts");
  expect(scene.colors()).toBeGreaterThan(100);
  expect([picture.width, picture.height]).toEqual([1360, 820]);
});

test("a cube after subdivision, beside the limit surface with its control mesh", async () => {
  await page.getByRole("button", { name: "Compare" }).click();
  const left = page.getByTestId("side-left");
  const right = page.getByTestId("side-right");
  await left.getByLabel("Mesh of this side").selectOption("Cube");
  await left.getByTestId("facts").waitFor();
  await left.getByLabel("Scheme").selectOption("catmull-clark");
  await left.getByLabel("Steps").fill("2");
  await left.getByRole("button", { name: "Subdivide" }).click();
  await expect.poll(() => left.locator('[data-fact="Faces"]').innerText(), { timeout: 20_000 }).toBe("96");
  await left.getByRole("button", { name: "Limit beside" }).click();
  await expect
    .poll(() => right.locator('[data-fact="Volume"]').innerText(), { timeout: 20_000 })
    .toMatch(/^2\.6/);
  const scene = await stillScene(page, '[data-testid="side-right"] .scene-canvas');
  await takePicture(page, "readme-compare");
  expect(scene.colors()).toBeGreaterThan(50);
});
