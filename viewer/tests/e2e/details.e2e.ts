import { expect, test } from "vitest";

import { run, stillScene, write } from "./support/actions";
import { takePicture } from "./support/browser";
import { choose, field, plainScene, press } from "./support/scene";
import { Session } from "./support/session";

const session = new Session({
  statements: [
    "let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))",
    "let Block = createCube(makePoint3D(0, 0, 2), makePoint3D(3, 4, 7))",
    "let Parts = intstream(1, 5) transformstream extend[Solid: createCube(makePoint3D(.Elem * 3, 0, 0), makePoint3D(.Elem * 3 + 2, 2, 2))] consume",
    "derive Parts_Solid = Parts creatertree[Solid]",
  ],
});

test("help shows the text of an operator, finds words and lists all", async () => {
  const { page } = session;
  await run(page, "help area");
  const text = page.getByTestId("description");
  expect(await text.innerText()).toContain("The area of a region, or of all triangles");
  await takePicture(page, "details-help");
  await run(page, "help");
  expect(await text.innerText()).toContain("help NAME describes an operator");
  expect(await page.getByTestId("failure").count()).toBe(0);
  await run(page, "help xyzzy");
  expect(await page.getByTestId("failure").innerText()).toContain("no operator or command has xyzzy");
});

test("the section tells its area and how it moves over the scene, with the panel closed", async () => {
  const { page } = session;
  await run(page, "query Cube");
  await stillScene(page);
  await press(page, "c");
  const readout = page.getByTestId("section-readout");
  await expect.poll(() => readout.innerText(), { timeout: 20_000 }).toContain("area 4");
  expect(await readout.innerText()).toContain("Section x = 1");
  expect(await readout.innerText()).toContain("Drag the handle");
  expect(await page.getByTestId("section-panel").isVisible()).toBe(false);
  await takePicture(page, "details-section");
  await press(page, "PageUp");
  await expect.poll(() => readout.innerText()).toMatch(/Section x = 1\.0\d+/);
  await readout.getByRole("button", { name: "Settings of the section" }).click();
  expect(await field(page, "section", "Show the plane").isVisible()).toBe(true);
  await page.getByRole("button", { name: "Settings of the view" }).click();
  await press(page, "c");
  await readout.waitFor({ state: "detached" });
});

test("the axes of a region are told, and are those of the database", async () => {
  const { page } = session;
  await run(page, "query Block");
  await stillScene(page);
  await press(page, "c");
  await page.getByTestId("section-readout").getByRole("button").click();
  await page.getByTestId("cut-area").waitFor();
  const axes = await page.getByTestId("region-axes").innerText();
  expect(axes).toBe("As a region: x is the direction (0, 0, -1), y is (0, 1, 0).");
  await page.getByRole("button", { name: "As region" }).click();
  const statement = page.locator(".result-info code");
  await expect.poll(() => statement.innerText(), { timeout: 20_000 }).toContain("slice");
  const { value } = await session.server.run((await statement.innerText()).replace("$v", "Block"));
  // About the middle (1.5, 2, 4.5), x is -z, which goes from 2 to 7, and y is y, from 0 to 4.
  const numbers = (value as number[][][][]).flat(2);
  const range = (axis: number) => [Math.min, Math.max].map((end) => end(...numbers.map((p) => p[axis]!)));
  expect([range(0), range(1)]).toEqual([
    [-1, 4],
    [0, 4],
  ]);
});

test("names from the list of objects stand apart from the text", async () => {
  const { page } = session;
  await write(page, "query");
  await page.getByTestId("objects").getByText("Parts_Solid").click();
  expect(await page.locator(".cm-content").innerText()).toBe("query Parts_Solid");
});

test("an empty relation shows its columns", async () => {
  const { page } = session;
  await run(page, "query Parts feed filter[.Elem > 100] consume");
  const table = page.getByTestId("table");
  expect(await table.innerText()).toMatch(/Elem\s+int[\s\S]*Solid\s+volume3d[\s\S]*No rows\./);
  await takePicture(page, "details-empty");
});

test("texts are shown as they are, and cannot turn what is beside them", async () => {
  const { page } = session;
  await run(
    page,
    'query intstream(1, 1) transformstream extend[A: "a  b", B: "x\u202Edcba", C: "end"] consume',
  );
  const cell = (name: string) => page.locator(`[data-column="${name}"]`);
  // The browser's own text of the line, in which collapsed blanks are missing.
  expect(await cell("A").innerText()).toBe("a  b");
  expect(await cell("B").innerText()).toBe("xU+202Edcba");
  await takePicture(page, "details-texts");
});

test("the list of shortcuts closes with one Escape, also from a search", async () => {
  const { page } = session;
  await press(page, "?");
  const sheet = page.getByRole("dialog", { name: "Keyboard shortcuts" });
  await sheet.waitFor();
  await page.keyboard.press("Escape");
  await sheet.waitFor({ state: "detached" });
  await press(page, "?");
  await sheet.getByLabel("Search shortcuts").fill("section");
  await page.keyboard.press("Escape");
  await sheet.waitFor({ state: "detached" });
});

test("bounding boxes end at the section", async () => {
  const { page } = session;
  await session.show("query createSphere(makePoint3D(0, 0, 0), 1, 24)");
  await choose(page, "appearance", "Edges", "None");
  await field(page, "display", "Bounding boxes").setChecked(true);
  // Lines are thinner than a pixel of the screenshot; the sphere is greyer.
  const isLine = ([red, , blue]: readonly number[]) => blue! - red! > 70;
  const right = async () => {
    const picture = await stillScene(page);
    let found = 0;
    for (let x = Math.round(picture.width * 0.55); x < picture.width; x++)
      for (let y = 100; y < picture.height; y++) if (isLine(picture.at(x, y))) found++;
    return found;
  };
  expect(await right()).toBeGreaterThan(100);
  await press(page, "c");
  await page.getByTestId("cut-area").waitFor();
  await field(page, "section", "Show the plane").setChecked(false);
  expect(await right()).toBe(0);
  await takePicture(page, "details-boxes");
});

test("what was put into the view by itself still fits when a panel opens beside it", async () => {
  const { page } = session;
  await run(page, "query Parts");
  await stillScene(page);
  await plainScene(page); // opens the panel
  const picture = await stillScene(page);
  await takePicture(page, "details-narrow");
  const isObject = ([red, green, blue]: readonly number[]) => red! + green! + blue! < 700;
  const inColumn = (x: number) =>
    Array.from({ length: picture.height - 100 }, (_, y) => picture.at(x, y + 100)).filter(isObject).length;
  const middle = Array.from({ length: 40 }, (_, i) => inColumn(picture.width / 2 - 20 + i));
  expect(Math.max(...middle)).toBeGreaterThan(20);
  for (const x of [3, 6, picture.width - 6, picture.width - 3]) expect(inColumn(x)).toBe(0);
});
