/**
 * Ten tasks of somebody who has never seen the page, by what its words and tooltips say, without a statement written by
 * hand. The numbers of clicks are those of the table in the README of the viewer.
 */

import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeEach, expect, test } from "vitest";
import type { Locator, Page } from "playwright-core";

import { boxOf, stillScene } from "./support/actions";
import { takePicture } from "./support/browser";
import type { Picture } from "./support/picture";
import { kScene } from "./support/scene";
import { Session } from "./support/session";

const box = (x1: number, x2: number, z1: number, z2: number, depth = 4) =>
  `createCube(makePoint3D(${x1}, 0, ${z1}), makePoint3D(${x2}, ${depth}, ${z2}))`;
const part = (name: string, solid: string) =>
  `intstream(1, 1) transformstream projectextend[; Name: "${name}", Solid: ${solid}]`;

const session = new Session({
  browser: { width: 1280, height: 720 },
  statements: [
    // The base carries a post and a pin; the lid lies on the post; the knob stands apart.
    `let Machine = ${[
      part("pin", box(0, 1, 2, 5)),
      `${part("base", box(0, 10, 0, 2))} concat`,
      `${part("post", box(4, 6, 2, 6))} concat`,
      `${part("lid", box(3, 7, 6, 7))} concat`,
      `${part("knob", box(14, 15, 0, 1))} concat`,
    ].join(" ")} consume`,
    `let Wall = ${box(0, 9, 0, 5, 2)}`,
    `let Bracket_1 = ${box(0, 4, 0, 4)}`,
    `let Bracket_2 = (${box(0, 4, 0, 4)}) minus (${box(1, 2, 1, 2)})`,
  ],
});
let page: Page;

const folder = mkdtempSync(join(tmpdir(), "algebra3d-newcomer-"));
afterAll(() => rmSync(folder, { recursive: true }));

const poll = <T>(look: () => T) => expect.poll(look, { timeout: 30_000 });

/** The clicks of a task. */
let clicks = 0;

beforeEach(() => {
  page = session.page;
  clicks = 0;
});

async function clickOn(place: Locator): Promise<void> {
  clicks++;
  await place.click();
}

/** Clicks on what has these words on it, or in its tooltip. */
async function click(words: string, role: "button" | "menuitem" | "tab" = "button"): Promise<void> {
  await clickOn(page.getByRole(role, { name: words }).filter({ visible: true }).first());
}

/** One click opens the list, one chooses. */
async function choose(list: Locator, words: string): Promise<void> {
  clicks += 2;
  await list.selectOption({ label: words });
}

async function clickScene(x: number, y: number): Promise<void> {
  clicks++;
  const scene = await boxOf(page, kScene);
  await page.mouse.click(scene.x + x, scene.y + y);
}

/** The left and right ends of the topmost row of an object, below `from`. */
function topCorners(picture: Picture): { y: number; left: number; right: number } {
  const ground = picture.at(4, picture.height / 2);
  const isObject = (x: number, y: number) =>
    picture.at(x, y).some((value, i) => Math.abs(value - ground[i]!) > 25);
  for (let y = 70; y < picture.height - 70; y++) {
    const inside = Array.from({ length: picture.width - 240 }, (_, i) => i + 120).filter((x) =>
      isObject(x, y),
    );
    if (inside.length > 8) return { y, left: inside[0]!, right: inside.at(-1)! };
  }
  throw new Error("the picture has no object");
}

const names = () => page.locator('.table-row [data-column="Name"]').allInnerTexts();

/** The number of clicks that the page of the viewer states for a task. */
function stated(task: string): number {
  const readme = readFileSync(join(process.cwd(), "README.md"), "utf8");
  const row = readme.split("\n").find((line) => line.startsWith(`| ${task} `));
  return Number(row?.split("|")[2]?.trim() ?? NaN);
}

const tasks: Readonly<Record<string, () => Promise<void>>> = {
  "the heaviest part": async () => {
    await click("The heaviest first");
    await poll(async () => (await names())[0]).toBe("base");
  },
  "what touches it": async () => {
    await click("The heaviest first");
    await poll(async () => (await names())[0]).toBe("base");
    await clickOn(page.locator('[data-row="0"] [data-column="Name"]'));
    await click("View", "tab");
    await click("What touches it");
    await poll(async () => (await names()).sort()).toEqual(["pin", "post"]);
  },
  "cut it": async () => {
    await stillScene(page);
    await click("Section");
    await poll(() => page.getByTestId("section-readout").innerText()).toMatch(/area [1-9]/);
    const isOrange = ([r, g, b]: readonly number[]) => r! > 180 && g! > 80 && g! < 150 && b! < 100;
    expect((await stillScene(page)).count(isOrange)).toBeGreaterThan(200);
  },
  "measure a wall": async () => {
    await click("Wall");
    await stillScene(page);
    await click("Right view");
    const { y, left, right } = topCorners(await stillScene(page));
    await click("Measure");
    await clickScene(left + 1, y + 1);
    await clickScene(right - 1, y + 1);
    await poll(() => page.getByTestId("tool-readout").innerText()).toMatch(/\b2\b/);
  },
  "colour by thickness": async () => {
    await click("Colour by a measure of Solid");
    await click("Colour by wall thickness", "menuitem");
    await poll(() => page.getByTestId("legend").innerText()).toMatch(/Thickness\s+1\s+2/);
    expect((await stillScene(page)).colors()).toBeGreaterThan(10);
  },
  "save a picture": async () => {
    await stillScene(page);
    const download = page.waitForEvent("download");
    await click("Picture");
    expect((await download).suggestedFilename()).toMatch(/\.png$/);
  },
  "share a view": async () => {
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    await click("Copy link");
    await page.getByText("The link to this view is copied.").waitFor();
    expect(await page.evaluate(() => navigator.clipboard.readText())).toContain(session.server.url);
  },
  "import a folder": async () => {
    const parts = join(folder, "parts");
    mkdirSync(parts, { recursive: true });
    for (const [name, size] of Object.entries({ small: 1, large: 3 }))
      writeFileSync(join(parts, `${name}.off`), tetrahedron(size));
    await click("Import");
    const chooser = page.waitForEvent("filechooser");
    await click("A folder…", "menuitem");
    await (await chooser).setFiles(parts);
    await page.getByText("2 files as a relation").waitFor();
    await clickOn(page.getByTestId("import-all").getByRole("button", { name: "Import" }));
    await page.getByTestId("objects").getByText("Parts").waitFor();
  },
  "compare two versions": async () => {
    await click("Compare");
    for (const [side, name] of Object.entries({ left: "Bracket_1", right: "Bracket_2" }))
      await choose(page.getByTestId(`side-${side}`).getByLabel("Mesh of this side"), name);
    const volume = (side: string) => page.getByTestId(`side-${side}`).locator('[data-fact="Volume"]');
    await poll(() => volume("left").innerText()).toBe("64");
    await poll(() => volume("right").innerText()).toBe("60");
  },
  undo: async () => {
    await stillScene(page);
    await page.getByRole("button", { name: "Exploded", exact: true }).click();
    await page.locator('.page[data-settled="true"]').waitFor();
    await click("Undo");
    const inGrid = page.getByRole("button", { name: "Contact sheet", exact: true });
    await poll(() => inGrid.getAttribute("aria-pressed")).toBe("true");
  },
};

function tetrahedron(size: number): string {
  return `OFF\n4 4 0\n0 0 0\n${size} 0 0\n0 ${size} 0\n0 0 ${size}\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n`;
}

const counts: number[] = [];

test.each(Object.keys(tasks))("%s", async (task) => {
  await page.getByTestId("start").waitFor();
  await tasks[task]!();
  await takePicture(page, `newcomer-${task.replaceAll(" ", "-")}`);
  expect(clicks).toBe(stated(task));
  counts.push(clicks);
});

test("half of the tasks take at most six clicks", () => {
  expect(counts).toHaveLength(10);
  expect(counts.sort((a, b) => a - b)[5]).toBeLessThanOrEqual(6);
});
