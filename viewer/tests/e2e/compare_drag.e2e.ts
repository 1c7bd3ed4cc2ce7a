import { beforeEach, expect, test } from "vitest";
import type { Page } from "playwright-core";
import { boxOf, stillScene } from "./support/actions";
import { takePicture } from "./support/browser";
import { CompareSession, sceneOf } from "./support/compare";
import { topRight } from "./support/picture";

const session = new CompareSession();
const { side, load, press, expectSteps, expectFact } = session;
let page: Page;

beforeEach(() => {
  page = session.page;
});

test("a vertex is dragged in the plane of its normal", async () => {
  await load("left", "Cube");
  await expectFact("left", "Volume", "8");
  await press("left", "Vertex ↔ plane");
  await stillScene(page, sceneOf("left"));
  const box = await boxOf(page, sceneOf("left"));
  // In the isometric view the nearest corner is in the middle.
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 70, y, { steps: 8 });
  await takePicture(page, "compare-drag");
  await page.mouse.up();
  await expectSteps("left", /Cube › move vertex \d/);
  await expectFact("left", "Vertices", "8");
  await expect
    .poll(() => side("left").locator('[data-fact="Area"]').innerText(), { timeout: 20_000 })
    .not.toBe("24");
  await press("left", "Undo");
  await expectFact("left", "Area", "24");
});

test("polygons are triangulated", async () => {
  await load("left", "Cube");
  await side("left").getByLabel("Scheme").selectOption("catmull-clark");
  await press("left", "Subdivide");
  await expectFact("left", "Faces", "24");
  await press("left", "Triangulate");
  await expectFact("left", "Faces", "48");
  await expectSteps("left", /triangulate$/);
});

test("a mesh is moved, turned and scaled by a handle", async () => {
  await load("left", "Cube");
  await expectFact("left", "Volume", "8");
  const dragHandle = async (dx: number, dy: number) => {
    await stillScene(page, sceneOf("left"));
    // The list of steps above the scene grows with each of them.
    const box = await boxOf(page, sceneOf("left"));
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + dx, y + dy, { steps: 8 });
    await takePicture(page, "compare-handle");
    await page.mouse.up();
  };
  await press("left", "Move");
  await dragHandle(60, 20);
  await expectSteps("left", /Cube › move$/);
  await expectFact("left", "Volume", "8");
  await press("left", "Undo");
  await press("left", "Scale");
  await dragHandle(80, 0);
  await expectSteps("left", /Cube › scale$/);
  await expect
    .poll(() => side("left").locator('[data-fact="Volume"]').innerText(), { timeout: 20_000 })
    .not.toBe("8");
  await press("left", "Undo");
  await expectFact("left", "Volume", "8");
  await press("left", "Turn");
  await dragHandle(40, 30);
  await expectSteps("left", /Cube › turn$/);
});

test("a vertex is dragged along its normal", async () => {
  await load("left", "Cube");
  await expectFact("left", "Volume", "8");
  const scene = page.locator(sceneOf("left"));
  await scene.focus();
  await page.keyboard.press("1");
  await page.keyboard.press("5");
  await page.keyboard.press("-"); // so that the corner is not at the edge of the view
  await page.keyboard.press("-");
  const corner = topRight(await stillScene(page, sceneOf("left")));
  await press("left", "Vertex ↕ normal");
  await stillScene(page, sceneOf("left")); // the corners are drawn, and can be caught
  const box = await boxOf(page, sceneOf("left"));
  const [x, y] = [box.x + corner.x - 1, box.y + corner.y + 1];
  await page.mouse.move(x, y);
  await page.mouse.down();
  // To the right only: along the normal it goes up as well, and towards the eye.
  await page.mouse.move(x + 60, y, { steps: 8 });
  await takePicture(page, "compare-drag-normal");
  await page.mouse.up();
  await expectSteps("left", /Cube › move vertex \d/);
  await expect
    .poll(async () => Number(await side("left").locator('[data-fact="Volume"]').innerText()), {
      timeout: 20_000,
    })
    .toBeGreaterThan(8.05);
});
