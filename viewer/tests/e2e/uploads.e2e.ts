import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, beforeAll, beforeEach, expect, test } from "vitest";
import type { Page } from "playwright-core";
import { expectNoErrors, ready, stillScene } from "./support/actions";
import { Browser, takePicture } from "./support/browser";
import { isGreenish } from "./support/scene";
import { Server } from "./support/server";

let server: Server;
let browser: Browser;
let page: Page;
let folder: string;

const corners: Readonly<Record<string, string>> = { a: "0 0 0", b: "6 0 0", c: "0 6 0", d: "0 0 6" };

/** A pyramid in STL; each triangle is named by its three corners. */
function stl(...triangles: string[]): string {
  const facets = triangles.map(
    (names) =>
      `facet normal 0 0 0\nouter loop\n${Array.from(names, (name) => `vertex ${corners[name] ?? ""}`).join("\n")}\nendloop\nendfacet`,
  );
  return `solid tip\n${facets.join("\n")}\nendsolid tip\n`;
}

function file(name: string, text: string): string {
  const path = join(folder, name);
  writeFileSync(path, text);
  return path;
}

const review = () => page.getByTestId("review");

async function choose(...paths: string[]): Promise<void> {
  await page.getByTestId("file-input").setInputFiles(paths);
}

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), "algebra3d-files-"));
  server = await Server.start();
  browser = await Browser.start();
});

afterAll(async () => {
  await browser.end();
  await server.remove();
  rmSync(folder, { recursive: true });
});

beforeEach(async () => {
  await browser.forget(server.url); // else a split screen that was just opened is kept
  page = await browser.open(server.url);
  await ready(page);
});

test("a broken file is shown as it is, with its defects, its repair and what that changed", async () => {
  const empty = await stillScene(page);
  await choose(file("tip.stl", stl("acb", "abd", "adc")));
  await page.locator('[data-testid="review"][data-phase="ready"]').waitFor();
  await review().getByText("Changes").waitFor();
  const text = await review().innerText();
  expect(text).toContain("mesh3d, 3 faces");
  expect(text).toContain("volume3d, 4 triangles");
  expect(text).toMatch(/found\s+boundary edges\s+3/);
  expect(text).toMatch(/changed\s+holes\s+1/);
  expect(await review().locator(".added").innerText()).toBe("+1");
  expect(await review().locator(".removed").innerText()).toBe("−0");
  const marked = await stillScene(page);
  await takePicture(page, "uploads-review");
  expect(marked.difference(empty)).toBeGreaterThan(0.03);
  // The added triangle is green, and the edges of the hole are red.
  expect(marked.count(([red, green, blue]) => green > red + 40 && green > blue + 20)).toBeGreaterThan(300);
  await review().getByRole("button", { name: "Mark the changed triangles" }).click();
  const plain = await stillScene(page);
  expect(plain.count(([red, green, blue]) => red > 150 && green < 90 && blue < 110)).toBeGreaterThan(100);
  expect(plain.difference(marked)).toBeGreaterThan(0.01);
  expectNoErrors(browser.errors);
});

test("the repaired solid is stored with one click", async () => {
  await choose(file("my tip.stl", stl("acb", "abd", "adc", "bcd")));
  await page.locator('[data-testid="review"][data-phase="ready"]').waitFor();
  expect(await review().innerText()).toContain("No defects: a valid solid.");
  expect(await review().getByRole("textbox").inputValue()).toBe("My_tip");
  await review().getByRole("button", { name: "Store" }).click();
  await page.getByTestId("objects").getByText("My_tip").waitFor();
  expect(await server.run("query volume(My_tip)")).toMatchObject({ value: 36 });
  expect(await review().count()).toBe(0);
});

test("a file without faces is not called a valid solid", async () => {
  await choose(file("nothing.stl", "solid nothing\nendsolid nothing\n"));
  await page.locator('[data-testid="review"][data-phase="ready"]').waitFor();
  const text = await review().innerText();
  expect(text).toContain("The file has no faces");
  expect(text).not.toContain("No defects");
  await takePicture(page, "uploads-nothing");
});

test("an OBJ file is drawn in the colours of its materials, which come from its file of materials", async () => {
  const vertices = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 2\n";
  const obj = `mtllib roof.mtl\n${vertices}usemtl floor\nf 4 3 2 1\nusemtl roof\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n`;
  await choose(file("roof.obj", obj));
  await page.locator('[data-testid="review"][data-phase="ready"]').waitFor();
  const plain = await stillScene(page);
  expect(plain.count(isGreenish)).toBe(0);
  await choose(file("roof.mtl", "newmtl roof\nKd 0 1 0\nnewmtl floor\nKd 1 0 0\nmap_Kd floor.png\n"));
  await page.getByText("roof.mtl has the colours of 2 materials.").waitFor();
  expect(await page.getByText("Pictures on materials are not shown: 1.").count()).toBe(1);
  const legend = page.getByTestId("legend");
  await expect.poll(() => legend.innerText()).toMatch(/floor\s*1\s*roof\s*4/);
  expect((await stillScene(page)).count(isGreenish)).toBeGreaterThan(2000);
  await takePicture(page, "uploads-materials");
});

test("nothing is stored of a file that is gone, and its card stays", async () => {
  await choose(file("gone.stl", stl("acb", "abd", "adc", "bcd")));
  await page.locator('[data-testid="review"][data-phase="ready"]').waitFor();
  expect((await fetch(`${server.url}api/uploads/gone.stl`, { method: "DELETE" })).ok).toBe(true);
  await review().getByRole("button", { name: "Store" }).click();
  // Beside the name, and not at the editor, which is elsewhere.
  const problem = review().getByTestId("name-problem");
  await expect.poll(() => problem.innerText()).toMatch(/gone.*Nothing was stored/s);
  expect(await page.getByTestId("failure").count()).toBe(0);
  expect(await review().count()).toBe(1);
  expect(await page.getByText("Gone is stored.").count()).toBe(0);
  await expect(server.run("query Gone")).rejects.toThrow();
});

test("the card of the newest file is the first, and the marks of a file go with its results", async () => {
  await choose(file("first.stl", stl("acb", "abd", "adc")));
  await page.locator('[data-testid="review"][data-phase="ready"]').waitFor();
  await review().getByText("Changes").waitFor();
  const isGreen = ([red, green, blue]: readonly number[]) => green! > red! + 40 && green! > blue! + 20;
  const marked = (await stillScene(page)).count(isGreen);
  await choose(file("second.stl", stl("acb", "abd", "adc", "bcd")));
  const second = page.getByRole("region", { name: "second.stl" });
  await second.and(page.locator('[data-phase="ready"]')).waitFor();
  expect(await review().first().innerText()).toContain("second.stl");
  const mark = page.getByRole("button", { name: "Mark the changed triangles" });
  expect(await mark.isDisabled()).toBe(true);
  // The card of the second one has green text.
  await second.getByRole("button", { name: "Close second.stl" }).click();
  const plain = (await stillScene(page)).count(isGreen);
  expect(plain).toBeLessThan(marked / 4);
  await page
    .getByRole("region", { name: "first.stl" })
    .getByRole("button", { name: "Show As it is in 3D" })
    .click();
  expect(await mark.isEnabled()).toBe(true);
});

test("a file and its repair are put side by side", async () => {
  await choose(file("tip.stl", stl("acb", "abd", "adc")));
  await page.locator('[data-testid="review"][data-phase="ready"]').waitFor();
  await review().getByRole("button", { name: "Side by side" }).click();
  const fact = (side: string, name: string) =>
    page.getByTestId(`side-${side}`).locator(`[data-fact="${name}"]`);
  await expect.poll(() => fact("left", "Closed").innerText(), { timeout: 20_000 }).toBe("no");
  await expect.poll(() => fact("right", "Closed").innerText(), { timeout: 20_000 }).toBe("yes");
  await expect.poll(() => fact("right", "Volume").innerText(), { timeout: 20_000 }).toBe("36");
});

test("files dropped on the window are taken", async () => {
  const transfer = await page.evaluateHandle((text) => {
    const data = new DataTransfer();
    data.items.add(new File([text], "dropped.obj"));
    return data;
  }, "v 0 0 0\nv 6 0 0\nv 0 6 0\nv 0 0 6\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  await page.dispatchEvent("body", "dragover", { dataTransfer: transfer });
  await page.getByText("Drop STL, OBJ or OFF files to look at them").waitFor();
  await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
  await page.locator('[data-testid="review"][data-phase="ready"]').waitFor();
  expect(await review().innerText()).toContain("volume3d, 4 triangles");
});

test("a file that is no mesh is refused with the reason, and other files are only uploaded", async () => {
  await choose(file("broken.stl", "this is no mesh"));
  await page.locator('[data-testid="review"][data-phase="failed"]').waitFor();
  expect(await review().locator(".error-text").innerText()).not.toBe("");
  await takePicture(page, "uploads-failed");
  await choose(file("prices.csv", "Name,Price\nbolt,0.35\n"));
  await page.getByTestId("notice").getByText("prices.csv is uploaded.").waitFor();
  const answer = await server.run("query importCSV('uploads/prices.csv') count");
  expect(answer).toMatchObject({ value: 1 });
});
