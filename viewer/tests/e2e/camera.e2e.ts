import { beforeEach, expect, test } from "vitest";
import type { Page } from "playwright-core";

import { run, stillScene } from "./support/actions";
import { takePicture } from "./support/browser";
import type { Picture } from "./support/picture";
import {
  covered,
  drag,
  field,
  frontView,
  halfSide,
  isWhite,
  kScene,
  openSettings,
  plainScene,
  press,
  sceneSize,
} from "./support/scene";
import { Session } from "./support/session";

// A brick: each side has another size.
const session = new Session({
  statements: ["let Brick = createCube(makePoint3D(0, 0, 0), makePoint3D(4, 2, 1))"],
  browser: { touch: true },
  initScript: countDrawCalls,
});

let page: Page;

beforeEach(async () => {
  page = session.page;
  await run(page, "query Brick");
  await stillScene(page);
});

/** Counts what is drawn, in `drawCalls` of the page. */
function countDrawCalls(): void {
  const prototype = WebGL2RenderingContext.prototype;
  // eslint-disable-next-line @typescript-eslint/unbound-method -- called with the context below
  const draw = prototype.drawElements;
  Reflect.set(globalThis, "drawCalls", 0);
  prototype.drawElements = function (...call: Parameters<typeof draw>) {
    Reflect.set(globalThis, "drawCalls", (Reflect.get(globalThis, "drawCalls") as number) + 1);
    draw.apply(this, call);
  };
}

const drawCalls = (): Promise<number> => page.evaluate(() => Reflect.get(globalThis, "drawCalls") as number);

/** Width and height of what is not white, in pixels. */
function extent(picture: Picture): { width: number; height: number; left: number; top: number } {
  let [left, right, top, bottom] = [Infinity, -1, Infinity, -1];
  for (let y = 0; y < picture.height; y += 2) {
    for (let x = 0; x < picture.width; x += 2) {
      if (y < 60 || isWhite(picture.at(x, y))) continue; // the toolbar is above
      [left, right] = [Math.min(left, x), Math.max(right, x)];
      [top, bottom] = [Math.min(top, y), Math.max(bottom, y)];
    }
  }
  return { left, top, width: right - left, height: bottom - top };
}

test("F3D's keys look from the front, right and top, and change the projection", async () => {
  await plainScene(page);
  await frontView(page);
  const ratio = async (): Promise<number> => {
    const { width, height } = extent(await stillScene(page));
    return width / height;
  };
  expect(await ratio()).toBeCloseTo(4, 1);
  await press(page, "3");
  expect(await ratio()).toBeCloseTo(2, 1);
  await press(page, "7");
  expect(await ratio()).toBeCloseTo(2, 1);
  await press(page, "9");
  const isometric = await stillScene(page);
  await press(page, "5");
  expect((await stillScene(page)).difference(isometric)).toBeGreaterThan(0.005);
  await press(page, "4");
  await press(page, "5");
  await press(page, "Enter");
  expect((await stillScene(page)).difference(isometric)).toBeLessThan(0.002);
});

test("the mouse rotates, moves and zooms", async () => {
  await plainScene(page);
  await frontView(page);
  const before = await stillScene(page);
  await drag(page, [500, 400], [90, 0], { button: "right" });
  const moved = extent(await stillScene(page));
  expect(moved.left - extent(before).left).toBeGreaterThan(84);
  expect(moved.left - extent(before).left).toBeLessThan(96);
  await press(page, "1");
  const { width, height } = await sceneSize(page);
  await page.locator(kScene).hover({ position: { x: width / 2, y: height / 2 } });
  await page.mouse.wheel(0, 400);
  const smaller = extent(await stillScene(page));
  expect(smaller.width).toBeLessThan(extent(before).width * 0.7);
  await press(page, "1");
  await drag(page, [500, 400], [120, 60]);
  const turned = extent(await stillScene(page));
  expect(turned.width / turned.height).toBeLessThan(3.5);
});

interface Gesture {
  readonly button: "left" | "middle" | "right";
  readonly and?: "left" | "middle" | "right";
  readonly keys?: readonly string[];
}

/** How each program rotates and moves, by its manual. */
const presets: readonly (readonly [string, { readonly rotate: Gesture; readonly pan: Gesture }])[] = [
  ["default", { rotate: { button: "left" }, pan: { button: "right" } }],
  ["blender", { rotate: { button: "middle" }, pan: { button: "middle", keys: ["Shift"] } }],
  ["freecad", { rotate: { button: "middle", and: "left" }, pan: { button: "middle" } }],
  ["solidworks", { rotate: { button: "middle" }, pan: { button: "middle", keys: ["Control"] } }],
  ["fusion", { rotate: { button: "middle", keys: ["Shift"] }, pan: { button: "middle" } }],
  ["onshape", { rotate: { button: "right" }, pan: { button: "middle" } }],
  ["inventor", { rotate: { button: "middle", keys: ["Shift"] }, pan: { button: "middle" } }],
  ["catia", { rotate: { button: "middle", and: "left" }, pan: { button: "middle" } }],
  ["rhino", { rotate: { button: "right" }, pan: { button: "right", keys: ["Shift"] } }],
  ["maya", { rotate: { button: "left", keys: ["Alt"] }, pan: { button: "middle", keys: ["Alt"] } }],
  ["f3d", { rotate: { button: "left" }, pan: { button: "middle" } }],
  ["touchpad", { rotate: { button: "left" }, pan: { button: "right" } }],
];

test.each(presets)("the mouse as in %s rotates and moves", async (preset, { rotate, pan }) => {
  await plainScene(page);
  await field(page, "navigation", "Mouse as in").selectOption(preset);
  await frontView(page);
  const before = extent(await stillScene(page));
  await drag(page, [500, 400], [90, 0], pan);
  const moved = extent(await stillScene(page));
  expect(Math.abs(moved.left - before.left - 90)).toBeLessThan(8);
  expect(Math.abs(moved.top - before.top)).toBeLessThan(8);
  await press(page, "1");
  await drag(page, [500, 400], [120, 60], rotate);
  const turned = extent(await stillScene(page));
  expect(turned.width / turned.height).toBeLessThan(before.width / before.height - 0.3);
});

test("in Blender's way the left button does not rotate", async () => {
  await plainScene(page);
  await field(page, "navigation", "Mouse as in").selectOption("blender");
  const before = await stillScene(page);
  await drag(page, [500, 400], [80, 30]);
  expect((await stillScene(page)).difference(before)).toBeLessThan(0.001);
});

test("the scale is set by a number, and fitted", async () => {
  await plainScene(page);
  await frontView(page);
  await field(page, "navigation", "Scale (pixels per unit)").fill("50");
  expect(extent(await stillScene(page)).width).toBeGreaterThan(194);
  expect(extent(await stillScene(page)).width).toBeLessThan(206);
  await page.getByRole("button", { name: "Auto-fit" }).click();
  const { width } = await sceneSize(page);
  expect(extent(await stillScene(page)).width).toBeGreaterThan((width / 1.08) * 0.98);
});

test("one finger rotates, two fingers zoom", async () => {
  await plainScene(page);
  await frontView(page);
  const before = extent(await stillScene(page));
  const box = (await page.locator(kScene).boundingBox())!;
  const touch = await page.context().newCDPSession(page);
  const at = (...places: (readonly [number, number])[]) =>
    places.map(([x, y], id) => ({ x: box.x + x, y: box.y + y, id }));
  await touch.send("Input.dispatchTouchEvent", {
    type: "touchStart",
    touchPoints: at([300, 300], [400, 300]),
  });
  for (let i = 1; i <= 5; i++) {
    const touchPoints = at([300 + 8 * i, 300], [400 - 8 * i, 300]);
    await touch.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints });
  }
  await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  const pinched = extent(await stillScene(page));
  expect(pinched.width).toBeLessThan(before.width * 0.5);
  await touch.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: at([300, 300]) });
  for (let i = 1; i <= 5; i++) {
    await touch.send("Input.dispatchTouchEvent", {
      type: "touchMove",
      touchPoints: at([300 + 20 * i, 300 + 8 * i]),
    });
  }
  await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  const turned = extent(await stillScene(page));
  expect(turned.width / turned.height).toBeLessThan(3.5);
});

test("nothing is drawn while nothing changes", async () => {
  await page.waitForTimeout(800);
  const before = await drawCalls();
  expect(before).toBeGreaterThan(0);
  await page.waitForTimeout(1200);
  expect(await drawCalls()).toBe(before);
  await press(page, "ArrowLeft");
  await expect.poll(drawCalls).toBeGreaterThan(before);
});

test("the cheat sheet lists the shortcuts, is searched, and carries them out", async () => {
  await press(page, "?");
  const sheet = page.getByRole("dialog", { name: "Keyboard shortcuts" });
  await sheet.waitFor();
  await takePicture(page, "cheat-sheet");
  const columnsOfGroups = await sheet
    .locator("section")
    .evaluateAll((groups) =>
      groups.map(
        (group) =>
          new Set([...group.children].flatMap((part) => [...part.getClientRects()].map(({ left }) => left)))
            .size,
      ),
    );
  expect(columnsOfGroups.length).toBeGreaterThan(3);
  expect(new Set(columnsOfGroups)).toEqual(new Set([1])); // a heading is in the column of all its keys
  await sheet.getByRole("searchbox").fill("grid");
  const titles = await sheet.getByRole("listitem").allInnerTexts();
  expect(titles.map((title) => title.split("\n")[0])).toContain("Grid");
  expect(titles.length).toBeLessThan(4);
  await sheet.getByRole("listitem").filter({ hasText: /^Grid/ }).getByRole("button").click();
  await openSettings(page);
  expect(await field(page, "display", "Grid").isChecked()).toBe(true);
});

test("a lost context is told, and the scene comes back", async () => {
  const before = await stillScene(page);
  const canvas = page.locator(`${kScene} canvas`).first();
  await canvas.evaluate((element) => {
    const extension = (element as HTMLCanvasElement)
      .getContext("webgl2")!
      .getExtension("WEBGL_lose_context")!;
    Reflect.set(globalThis, "loser", extension);
    extension.loseContext();
  });
  const problem = page.getByTestId("scene-problem");
  await problem.waitFor();
  expect(await problem.innerText()).toContain("graphics card");
  await page.evaluate(() => (Reflect.get(globalThis, "loser") as WEBGL_lose_context).restoreContext());
  await problem.waitFor({ state: "detached" });
  expect((await stillScene(page)).difference(before)).toBeLessThan(0.01);
  session.browser.errors.length = 0; // three.js reports the loss on the console
});

test("the camera does not move by itself where the person does not want animations", async () => {
  await plainScene(page);
  await frontView(page);
  const before = await drawCalls();
  await press(page, "7");
  await page.waitForTimeout(600);
  // One frame, and not those of an animation: faces and edges of the brick, and the frame at rest.
  expect((await drawCalls()) - before).toBeLessThan(8);
  expect(covered(await stillScene(page))).toBeGreaterThan(1000);
  expect(halfSide(await sceneSize(page))).toBeGreaterThan(100);
  await page.emulateMedia({ reducedMotion: "no-preference" });
  // A slow machine may have time for one frame of an animation only, but not always.
  let most = 0;
  for (let attempt = 0; attempt < 20 && most < 8; attempt++) {
    const start = await drawCalls();
    await press(page, attempt % 2 === 0 ? "1" : "7");
    await page.waitForTimeout(1500);
    most = Math.max(most, (await drawCalls()) - start);
  }
  expect(most).toBeGreaterThanOrEqual(8);
});
