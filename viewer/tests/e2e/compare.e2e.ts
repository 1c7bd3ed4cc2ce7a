import { beforeEach, expect, test } from "vitest";
import type { Page, Route } from "playwright-core";
import { boxOf, copiedLink, expectNoErrors, settled, stillScene } from "./support/actions";
import { Browser, takePicture } from "./support/browser";
import { CompareSession, sceneOf } from "./support/compare";
import { touchesSides } from "./support/picture";

const session = new CompareSession();
const { side, load, press, expectSteps, expectFact } = session;
let page: Page;

beforeEach(() => {
  page = session.page;
});

test("two meshes stand side by side with their statistics", async () => {
  await load("left", "Cube");
  await load("right", "Ball");
  await expectFact("left", "Vertices", "8");
  await expectFact("left", "Edges", "18");
  await expectFact("left", "Faces", "12");
  await expectFact("left", "Genus", "0");
  await expectFact("left", "Closed", "yes");
  await expectFact("left", "Area", "24");
  await expectFact("left", "Volume", "8");
  await expectFact("right", "Faces", "528");
  const left = await stillScene(page, sceneOf("left"));
  const right = await stillScene(page, sceneOf("right"));
  await takePicture(page, "compare-two");
  expect(left.colors()).toBeGreaterThan(10);
  expect(right.colors()).toBeGreaterThan(10);
  for (const picture of [left, right]) expect(touchesSides(picture)).toBe(false);
});

test("on a small page the rows of operations leave the scenes their room", async () => {
  await load("left", "Cube");
  await load("right", "Ball");
  const usual = page.viewportSize()!;
  await page.setViewportSize({ width: 1280, height: 720 });
  for (const name of ["left", "right"] as const)
    await expect.poll(async () => (await boxOf(page, sceneOf(name))).height).toBeGreaterThan(300);
  await page.setViewportSize(usual);
});

test.each([
  ["loop", "48"],
  ["catmull-clark", "24"],
  ["doo-sabin", "26"],
  ["butterfly", "48"],
  ["modified-butterfly", "48"],
])("the scheme %s makes %s faces of a cube", async (scheme, faces) => {
  await load("left", "Cube");
  await side("left").getByLabel("Scheme").selectOption(scheme);
  await press("left", "Subdivide");
  await expectFact("left", "Faces", faces);
});

test("steps are undone and redone, and the result is saved", async () => {
  await load("left", "Cube");
  const before = await stillScene(page, sceneOf("left"));
  await side("left").getByLabel("Scheme").selectOption("catmull-clark");
  await side("left").getByLabel("Steps", { exact: true }).fill("3");
  await press("left", "Subdivide");
  await expectFact("left", "Faces", "384");
  const after = await stillScene(page, sceneOf("left"));
  expect(after.difference(before)).toBeGreaterThan(0.02);
  await press("left", "Undo");
  await expectFact("left", "Faces", "96");
  await press("left", "Undo");
  await press("left", "Undo");
  await expectFact("left", "Faces", "12");
  expect(await side("left").getByRole("button", { name: "Undo" }).isDisabled()).toBe(true);
  await press("left", "Redo");
  await expectFact("left", "Faces", "24");
  await press("left", "Save as a new object");
  await side("left").getByLabel("Name of the new object").fill("Round");
  await press("left", "Save");
  await page.getByTestId("objects").getByText("Round").waitFor();
  expect(await session.server.run("query size(Round)")).toMatchObject({ value: 24 });
});

test("another mesh for a side is fitted", async () => {
  await session.server.run("let Hall = createCube(makePoint3D(0, 0, 0), makePoint3D(100, 100, 100))");
  await page.getByRole("button", { name: "Read the list again" }).click();
  await load("left", "Hall");
  await stillScene(page, sceneOf("left"));
  await load("left", "Cube");
  await expectFact("left", "Volume", "8");
  const fitted = await stillScene(page, sceneOf("left"));
  await takePicture(page, "compare-another");
  // With the camera of the hall it would be a dot.
  const faces = fitted.count(([red, , blue]) => blue > red + 30 && blue > 100);
  expect(faces).toBeGreaterThan(0.15 * fitted.width * fitted.height);
});

test("the number of steps is a whole number from 1 to 8, and shown as it is taken", async () => {
  await load("left", "Cube");
  const steps = side("left").getByLabel("Steps", { exact: true });
  for (const [typed, taken] of [
    ["-1", "1"],
    ["0", "1"],
    ["2.5", "3"],
    ["99", "8"],
  ] as const) {
    await steps.fill(typed);
    await steps.blur();
    expect(await steps.inputValue()).toBe(taken);
  }
});

test("an undone step is computed again if the server has dropped it", async () => {
  await load("left", "Cube");
  await press("left", "Subdivide");
  await expectFact("left", "Faces", "48");
  await press("left", "Subdivide");
  await expectFact("left", "Faces", "192");
  for (let count = 0; count < 70; count++) await session.server.run("query Cube");
  await press("left", "Undo");
  await expectFact("left", "Faces", "48");
  expect(await side("left").locator(".callout.error").count()).toBe(0);
});

test("set operations take the mesh of the other side", async () => {
  await load("left", "Cube");
  await load("right", "Ball");
  await press("left", "minus");
  await expect
    .poll(async () => Number(await side("left").locator('[data-fact="Volume"]').innerText()), {
      timeout: 30_000,
    })
    .toBeLessThan(7);
  await stillScene(page, sceneOf("left"));
  await takePicture(page, "compare-minus");
});

test("simplification and dual", async () => {
  await load("right", "Ball");
  await side("right").getByLabel("Percentage").fill("25");
  await press("right", "Simplify");
  await expectFact("right", "Faces", "132");
  await load("left", "Cube");
  await press("left", "Dual");
  await expectFact("left", "Vertices", "6");
  await expectFact("left", "Faces", "8");
});

test.each([
  ["catmull-clark", "384"],
  ["doo-sabin", "386"],
])(
  "the limit surface of %s stands beside its control mesh, which is drawn over it",
  async (scheme, faces) => {
    await load("left", "Cube");
    await side("left").getByLabel("Scheme").selectOption(scheme);
    await side("left").getByLabel("Steps", { exact: true }).fill("3");
    await press("left", "Limit beside");
    await expectFact("right", "Faces", faces);
    const picture = await stillScene(page, sceneOf("right"));
    await takePicture(page, `compare-limit-${scheme}`);
    // Edges of the control mesh.
    expect(picture.count(([red, green, blue]) => red > 150 && green > 110 && blue < 120)).toBeGreaterThan(
      200,
    );
  },
);

test("cameras move together, or each alone", async () => {
  await load("left", "Cube");
  await load("right", "Cube");
  const turn = async () => {
    const box = await boxOf(page, sceneOf("left"));
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 90, box.y + box.height / 2 + 30, { steps: 6 });
    await page.mouse.up();
  };
  const before = await stillScene(page, sceneOf("right"));
  await turn();
  const together = await stillScene(page, sceneOf("right"));
  expect(together.difference(before)).toBeGreaterThan(0.02);
  await page.getByRole("checkbox", { name: "Same camera" }).uncheck();
  await turn();
  const alone = await stillScene(page, sceneOf("right"));
  expect(alone.difference(together)).toBe(0);
});

test("a key goes to the scene that has just got the focus", async () => {
  await load("left", "Cube");
  await load("right", "Cube");
  await page.getByRole("checkbox", { name: "Same camera" }).uncheck();
  await page.locator(sceneOf("left")).focus();
  const before = {
    left: await stillScene(page, sceneOf("left")),
    right: await stillScene(page, sceneOf("right")),
  };
  // In the next task, before any frame is drawn.
  await page.locator(sceneOf("right")).evaluate(async (scene: HTMLElement) => {
    scene.focus();
    await new Promise((resolve) => setTimeout(resolve));
    scene.dispatchEvent(new KeyboardEvent("keydown", { key: "1", bubbles: true }));
  });
  await expect
    .poll(async () => (await stillScene(page, sceneOf("right"))).difference(before.right), {
      timeout: 20_000,
    })
    .toBeGreaterThan(0.02);
  expect((await stillScene(page, sceneOf("left"))).difference(before.left)).toBe(0);
});

test("a link restores the split screen", async () => {
  await load("left", "Cube");
  await side("left").getByLabel("Scheme").selectOption("catmull-clark");
  await press("left", "Subdivide");
  await expectFact("left", "Faces", "24");
  await load("right", "Ball");
  await expectFact("right", "Faces", "528");
  await press("right", "minus");
  await expectSteps("right", /Ball › minus/);
  const volume = await side("right").locator('[data-fact="Volume"]').innerText();
  await page.getByLabel("Same camera").setChecked(false);
  await page.locator(sceneOf("left")).focus();
  await page.keyboard.press("1");
  const left = await stillScene(page, sceneOf("left"));
  const right = await stillScene(page, sceneOf("right"));
  const link = await copiedLink(page);
  const other = await Browser.start({ width: 1400, height: 900 });
  try {
    page = session.page = await other.open(link);
    // Only objects are shown and operations of the split screen done: nobody has to be asked.
    await expectSteps("right", /Ball › minus/);
    expect(await session.stepsOf("left")).toMatch(/Cube › subdivide catmull-clark/);
    await expectFact("left", "Faces", "24");
    await expectFact("right", "Volume", volume);
    expect(await page.getByLabel("Same camera").isChecked()).toBe(false);
    expect((await stillScene(page, sceneOf("left"))).difference(left)).toBeLessThan(0.01);
    expect((await stillScene(page, sceneOf("right"))).difference(right)).toBeLessThan(0.01);
    await takePicture(page, "compare-link");
    await press("left", "Undo");
    await expectFact("left", "Faces", "12");
    expectNoErrors(other.errors);
  } finally {
    await other.end();
  }
});

test("a link restores its cameras also where other meshes are shown", async () => {
  await session.server.run("let_ Yard = createCube(makePoint3D(0, 0, 0), makePoint3D(50, 50, 50))");
  await page.getByRole("button", { name: "Read the list again" }).click();
  await load("left", "Cube");
  await load("right", "Ball");
  await page.getByLabel("Same camera").setChecked(false);
  for (const name of ["left", "right"] as const) {
    await page.locator(sceneOf(name)).focus();
    await page.keyboard.press(name === "left" ? "1" : "7");
    for (let i = 0; i < 3; i++) await page.keyboard.press("-");
  }
  const left = await stillScene(page, sceneOf("left"));
  const right = await stillScene(page, sceneOf("right"));
  const { hash } = new URL(await copiedLink(page));
  await page.evaluate(() => history.replaceState(null, "", "#"));
  await load("left", "Yard");
  await load("right", "Yard");
  expect((await stillScene(page, sceneOf("left"))).difference(left)).toBeGreaterThan(0.02);
  await page.evaluate((link) => (location.hash = link), hash);
  await expectFact("left", "Volume", "8");
  await expectFact("right", "Faces", "528");
  expect((await stillScene(page, sceneOf("left"))).difference(left)).toBeLessThan(0.01);
  expect((await stillScene(page, sceneOf("right"))).difference(right)).toBeLessThan(0.01);
});

test("counting is stopped, and the mesh stays", async () => {
  const held: (() => void)[] = [];
  await page.route("**/api/query", async (route) => {
    const { statement } = route.request().postDataJSON() as { statement: string };
    if (/volume/i.test(statement)) await new Promise<void>((resolve) => held.push(resolve));
    await route.continue().catch(() => undefined);
  });
  await load("left", "Cube");
  await expectFact("left", "Faces", "12");
  await side("left").getByText("Counting…").waitFor();
  await takePicture(page, "compare-counting");
  await press("left", "Stop");
  await side("left").getByText("Counting…").waitFor({ state: "detached" });
  expect(held.length).toBe(1);
  expect(await side("left").locator('[data-fact="Faces"]').innerText()).toBe("12");
  expect(await side("left").locator('[data-fact="Volume"]').count()).toBe(0);
  expect(await session.stepsOf("left")).toBe("Cube");
  held.forEach((end) => end());
  await page.unroute("**/api/query");
});

test("a running step is stopped, and what was there stays", async () => {
  await load("right", "Ball");
  await side("right").getByLabel("Steps", { exact: true }).fill("8");
  await press("right", "Subdivide");
  await side("right").getByRole("button", { name: "Stop", exact: true }).click();
  await side("right").getByText("Stopped.").waitFor({ timeout: 60_000 });
  expect(await session.stepsOf("right")).toContain("Ball");
  await side("right").locator('[data-fact="Faces"]').waitFor({ timeout: 60_000 });
});

test("nothing is told of the shapes of a step that is gone", async () => {
  const held: Route[] = [];
  await page.route("**/shapes?*", (route) => void held.push(route));
  await side("left").getByLabel("Mesh of this side").selectOption("Cube");
  await expect.poll(() => held.length, { timeout: 30_000 }).toBe(1);
  await press("left", "Dual");
  await expectSteps("left", /dual$/);
  await expect.poll(() => held.length, { timeout: 30_000 }).toBe(2);
  await held[0]!.abort(); // of the step before; the mesh of the present one is still on its way
  await expectFact("left", "Faces", "8");
  expect(await side("left").locator(".scene .error-text").allInnerTexts()).toEqual([]);
  await held[1]!.continue();
  expect((await stillScene(page, sceneOf("left"))).colors()).toBeGreaterThan(10);
  expect(await side("left").locator(".scene .error-text").allInnerTexts()).toEqual([]);
  await page.unrouteAll({ behavior: "ignoreErrors" });
  session.browser.errors.length = 0; // the request that broke off
});

test("an operation that is not possible says why", async () => {
  await session.server
    .run("let Flat = [const surface3d value (((0 0 0) (2 0 0) (0 2 0)))]")
    .catch(() => undefined);
  await page.getByRole("button", { name: "Read the list again" }).click();
  await load("left", "Flat");
  await load("right", "Cube");
  await press("left", "union");
  await expect.poll(() => side("left").locator(".callout.error").innerText()).toContain("union: expected");
});

test("the split screen has the same tools and panels: measures and inspects, each side its own", async () => {
  await load("left", "Cube");
  await load("right", "Cube");
  await page.getByRole("button", { name: "Settings of the view" }).click();
  const panels = page.getByRole("region", { name: "Settings of the view" });
  const middleOf = async (name: "left" | "right") => {
    const box = await boxOf(page, sceneOf(name));
    return [box.x + box.width / 2, box.y + box.height / 2] as const;
  };
  const [x, y] = await middleOf("left");
  await page.mouse.click(x, y);
  await page.keyboard.press("m");
  expect(await panels.innerText()).toMatch(/left side/i);
  await page.mouse.click(x - 20, y + 20);
  await page.mouse.click(x + 20, y + 20);
  await expect.poll(() => page.getByTestId("measure-value").innerText(), { timeout: 20_000 }).toMatch(/≈ \d/);
  await expect.poll(() => side("left").getByTestId("tool-readout").innerText()).toMatch(/points: ≈ \d/);
  const label = ([r, g, b]: readonly number[]) => r! > 180 && g! < 90 && b! > 80;
  expect((await stillScene(page, sceneOf("left"))).count(label)).toBeGreaterThan(20);
  await takePicture(page, "compare-measure");
  const [otherX, otherY] = await middleOf("right");
  await page.mouse.click(otherX, otherY);
  await page.keyboard.press("v");
  await page.mouse.click(otherX + 20, otherY + 30);
  expect(await panels.innerText()).toMatch(/right side/i);
  expect(await panels.getByTestId("inspected").innerText()).toMatch(/Triangle/);
  expect(await panels.getByTestId("measure").count()).toBe(0);
  // A step takes the measures of the mesh before with it.
  await press("left", "Dual");
  await expectFact("left", "Vertices", "6");
  expect((await stillScene(page, sceneOf("left"))).count(label)).toBe(0);
});

test("a tool that is chosen ends the one before, and its button shows it", async () => {
  await load("left", "Cube");
  const move = side("left").getByRole("button", { name: "Move", exact: true });
  await move.click();
  expect(await move.getAttribute("aria-pressed")).toBe("true");
  await side("left").getByRole("button", { name: "Measure" }).click();
  expect(await move.getAttribute("aria-pressed")).toBe("false");
});

test("the steps of a mesh are a list, and a click shows one of them", async () => {
  await load("left", "Cube");
  await side("left").getByLabel("Steps", { exact: true }).fill("2");
  await press("left", "Subdivide");
  await expectFact("left", "Faces", "192");
  expect(await side("left").getByTestId("side-title").innerText()).toBe("Cube");
  await side("left").getByRole("button", { name: "2. subdivide loop" }).click();
  await expectFact("left", "Faces", "48");
  await takePicture(page, "compare-steps");
  await side("left").getByRole("button", { name: "3. subdivide loop" }).click();
  await expectFact("left", "Faces", "192");
  await load("left", "Ball");
  expect(await side("left").getByTestId("side-title").innerText()).toBe("Ball");
});

test("a reload keeps the split screen with its steps, also those that were undone", async () => {
  await load("left", "Cube");
  await press("left", "Subdivide");
  await expectFact("left", "Faces", "48");
  await press("left", "Undo");
  await expectFact("left", "Faces", "12");
  await load("right", "Ball");
  const before = await stillScene(page, sceneOf("right"));
  await settled(page);
  await page.reload();
  await expectFact("left", "Faces", "12");
  await expectFact("right", "Faces", "528");
  expect((await stillScene(page, sceneOf("right"))).difference(before)).toBeLessThan(0.01);
  await press("left", "Redo");
  await expectFact("left", "Faces", "48");
});
