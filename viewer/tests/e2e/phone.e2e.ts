import { afterAll, beforeAll, expect, test } from "vitest";
import type { Page } from "playwright-core";
import { expectNoErrors, ready, stillScene } from "./support/actions";
import { Browser, takePicture } from "./support/browser";
import { Server } from "./support/server";

let server: Server;
let browser: Browser;
let page: Page;

beforeAll(async () => {
  server = await Server.start(["let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))"]);
  browser = await Browser.start({ width: 390, height: 844, touch: true });
  page = await browser.open(server.url);
  await ready(page);
});

afterAll(async () => {
  await browser.end();
  await server.remove();
});

/** Accessible names of what can be pressed. */
const names = (page: Page) =>
  page.evaluate(() =>
    [...document.querySelectorAll<HTMLElement>("header button")]
      .filter((button) => button.checkVisibility())
      .map((button) => button.ariaLabel ?? button.innerText.trim()),
  );

/** What is too small for a finger. */
const smallControls = () =>
  page.evaluate(() =>
    [...document.querySelectorAll<HTMLElement>("button, select, summary")]
      .filter((control) => control.checkVisibility() && control.ariaHidden !== "true")
      .filter(({ offsetWidth, offsetHeight }) => offsetWidth < 32 || offsetHeight < 32)
      .map((control) => control.ariaLabel ?? control.innerText),
  );

/** Nothing reaches over the edge of the page. */
async function expectToFit(): Promise<void> {
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  expect(width).toBeLessThanOrEqual(390);
}

test("the panels are sheets below the scene", async () => {
  const tabs = page.getByRole("navigation", { name: "Panels" });
  await takePicture(page, "phone-query");
  await expectToFit();
  await page.getByTestId("objects").getByText("Cube").tap();
  await tabs.getByText("Results").tap();
  await page.getByTestId("table").waitFor();
  expect(await page.getByTestId("editor").isVisible()).toBe(false);
  const picture = await stillScene(page);
  await takePicture(page, "phone-results");
  expect(picture.colors()).toBeGreaterThan(10);
  await expectToFit();
  await tabs.getByText("View").tap();
  await page.getByText("Appearance").first().waitFor();
  await takePicture(page, "phone-view");
  await expectToFit();
  await tabs.getByText("3D").tap();
  const box = await page.getByTestId("scene").boundingBox();
  expect(box?.height).toBeGreaterThan(500);
  expectNoErrors(browser.errors);
});

test("the card of a chosen file leaves the scene to see, and opens on demand", async () => {
  const facets = ["0 0 0, 0 1 0, 1 0 0", "0 0 0, 1 0 0, 0 0 1", "0 0 0, 0 0 1, 0 1 0"].map(
    (corners) =>
      `facet normal 0 0 0 outer loop vertex ${corners.replaceAll(", ", " vertex ")} endloop endfacet`,
  );
  const stl = `solid part\n${facets.join("\n")}\nendsolid part\n`;
  const part = { name: "part.stl", mimeType: "model/stl", buffer: Buffer.from(stl) };
  await page.getByTestId("file-input").setInputFiles(part);
  const card = page.locator('[data-testid="review"][data-phase="ready"]');
  await card.waitFor();
  await stillScene(page);
  await takePicture(page, "phone-review");
  const [folded, scene] = [await card.boundingBox(), await page.getByTestId("scene").boundingBox()];
  expect(folded!.height).toBeLessThan(0.2 * scene!.height);
  expect(await card.innerText()).toContain("1 kind of defect");
  await expectToFit();
  await card.getByRole("button", { name: "Details of part.stl" }).tap();
  await card.getByRole("button", { name: "Store" }).waitFor();
  expect(await card.innerText()).toMatch(/found\s+boundary edges\s+3/);
  await card.getByRole("button", { name: "Details of part.stl" }).tap();
  await card.getByRole("button", { name: "Store" }).waitFor({ state: "hidden" });
  await card.getByRole("button", { name: "Close part.stl" }).tap();
  await card.waitFor({ state: "detached" });
  expectNoErrors(browser.errors);
});

test("the sides of the split screen stand one below the other, each with its scene", async () => {
  await page.getByTitle("Two meshes side by side").tap();
  for (const side of ["left", "right"]) {
    const scene = page.locator(`[data-testid="side-${side}"] .scene-canvas`);
    expect((await scene.boundingBox())?.height).toBeGreaterThan(250);
  }
  await page.getByTestId("side-left").getByLabel("Mesh of this side").selectOption("Cube");
  await page.getByTestId("side-left").getByTestId("facts").waitFor();
  await takePicture(page, "phone-compare");
  await expectToFit();
  await page.getByTitle("Two meshes side by side").tap();
});

test("the page is worked by the keyboard alone", async () => {
  await page.setViewportSize({ width: 1280, height: 720 });
  await page.reload();
  await ready(page);
  await page.getByRole("tab", { name: "Objects" }).click();
  await page.evaluate(() => (document.activeElement as HTMLElement | null)?.blur());
  const reached = new Set<string>();
  for (let count = 0; count < 60; count++) {
    // The bars are one stop each, and the arrow keys go through them.
    const isInBar = await page.evaluate(() => document.activeElement?.closest(".top-tools") !== null);
    const isLast = await page.evaluate(() => document.activeElement?.ariaLabel === "Theme");
    await page.keyboard.press(isInBar && !isLast ? "ArrowRight" : "Tab");
    const name = await page.evaluate(() => {
      const element = document.activeElement;
      if (!element || element === document.body) return "";
      return element.getAttribute("aria-label") ?? element.textContent;
    });
    reached.add(name.trim());
    // CodeMirror keeps Tab for indenting; Escape then Tab leaves it.
    if (name === "Statements") await page.keyboard.press("Escape");
  }
  for (const name of [
    "Import",
    "Compare",
    "Copy link",
    "Theme",
    "Run",
    "Statements",
    "Objects",
    "Search objects",
  ])
    expect(
      [...reached].some((each) => each.includes(name)),
      `${name} in ${[...reached].join(" | ")}`,
    ).toBe(true);
  expect([...reached].some((each) => each.startsWith("3D view"))).toBe(true);
});

test("the editor tells how the keyboard leaves it", async () => {
  const hint = page.getByText("then Tab leaves the editor");
  await page.locator(".cm-content").focus();
  await hint.waitFor();
  const described = await page.locator(".cm-content").getAttribute("aria-describedby");
  expect(await page.locator(`#${described ?? ""}`).innerText()).toMatch(/Tab indents; Esc then Tab leaves/);
  const inEditor = () => page.evaluate(() => document.activeElement?.closest(".cm-editor") !== null);
  await page.keyboard.press("End"); // ends the time after an Escape
  await page.keyboard.press("Tab");
  expect(await inEditor()).toBe(true);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Tab");
  expect(await inEditor()).toBe(false);
  await hint.waitFor({ state: "hidden" });
});

test("every control has a name", async () => {
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("button, input, select, [role=tab], [role=separator]")]
      .filter((element) => element.checkVisibility())
      .filter(
        (element) =>
          !element.getAttribute("aria-label") &&
          !element.textContent.trim() &&
          !element.getAttribute("title") &&
          !(element instanceof HTMLInputElement && element.labels?.length),
      )
      .map((element) => element.outerHTML.slice(0, 120)),
  );
  expect(nameless).toEqual([]);
});

test("buttons have the names that they have on wide pages", async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  const narrow = await names(page);
  const desk = await Browser.start({ width: 1280, height: 800 });
  const wide = await desk.open(server.url);
  await ready(wide);
  const all = await names(wide);
  await desk.end();
  expect(narrow.length).toBeGreaterThan(3);
  expect(all).toEqual(expect.arrayContaining(narrow));
});

test("fingers have room, and the bar says that it goes on", async () => {
  const tabs = page.getByRole("navigation", { name: "Panels" });
  await tabs.getByText("Query").tap();
  await page.getByTestId("objects").getByText("Cube").tap();
  await page.getByTestId("table").waitFor();
  expect(await smallControls()).toEqual([]);
  await tabs.getByText("View").tap();
  expect(await smallControls()).toEqual([]);
  const bar = page.getByTestId("scene-tools");
  await expect.poll(() => bar.getAttribute("data-more")).toBe("right");
  await takePicture(page, "phone-tools");
  await page.locator(".tools-arrow.right").tap();
  await expect.poll(() => bar.getAttribute("data-more")).toBe("left right");
  await bar.evaluate((element) => (element.scrollLeft = element.scrollWidth));
  await expect.poll(() => bar.getAttribute("data-more")).toBe("left");
  expectNoErrors(browser.errors);
});
