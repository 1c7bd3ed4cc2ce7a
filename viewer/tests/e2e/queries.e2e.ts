import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from "vitest";
import type { Page } from "playwright-core";
import { clickMiddle, expectNoErrors, ready, run, selectedRow, stillScene, write } from "./support/actions";
import { Browser, takePicture } from "./support/browser";
import { Server } from "./support/server";

const row =
  'intstream(1, 5) transformstream extend[Name: "cube " + tostring(.Elem), Solid: createCube(makePoint3D(.Elem * 3, 0, 0), makePoint3D(.Elem * 3 + 2, 2, .Elem)), Mass: .Elem * 1.5]';

let server: Server;
let browser: Browser;
let page: Page;

beforeAll(async () => {
  server = await Server.start([`let Cubes = ${row} consume`]);
  browser = await Browser.start();
});

afterAll(async () => {
  await browser.end();
  await server.remove();
});

beforeEach(async () => {
  await browser.forget(server.url);
  page = await browser.open(server.url);
  await ready(page);
  browser.errors.length = 0;
});

afterEach(() => expectNoErrors(browser.errors));

test("a statement is highlighted, run, and its rows are shown as a table", async () => {
  await run(page, "query Cubes feed filter[.Mass > 2.0] consume;");
  const keyword = page.locator(".cm-line span", { hasText: /^query$/ });
  const plain = await page.locator(".cm-content").evaluate((element) => getComputedStyle(element).color);
  expect(await keyword.evaluate((element) => getComputedStyle(element).color)).not.toBe(plain);
  const table = page.getByTestId("table");
  expect(await table.getAttribute("aria-rowcount")).toBe("5");
  expect(await table.locator('[data-row="0"] [data-column="Name"]').innerText()).toBe("cube 2");
  expect(await table.locator('[data-row="0"] [data-column="Solid"]').innerText()).toBe(
    "volume3d, 12 triangles",
  );
  expect(await table.locator('[data-row="0"] [data-column="Mass"]').innerText()).toBe("3");
});

test("an inquiry of many lines has an answer", async () => {
  for (const statement of ["list operators;", "explain query Cubes feed count;"]) {
    await run(page, statement);
    expect(await page.getByTestId("failure").count()).toBe(0);
  }
});

test("undefined values are marked as such, and are not the word", async () => {
  await run(
    page,
    'query intstream(1, 1) transformstream extend[A: [const real value undefined], B: "undefined"] consume',
  );
  const cell = (name: string) => page.locator(`[data-row="0"] [data-column="${name}"]`);
  expect(await cell("A").locator(".undefined").count()).toBe(1);
  expect(await cell("B").locator(".undefined").count()).toBe(0);
});

test("the statement at the cursor is run, or the selection, or all", async () => {
  await write(page, "query 1 + 1;\nquery 2 + 2;\n\nquery 3 + 3;");
  await page.keyboard.press("Control+Home");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Control+Enter");
  await page.getByTestId("result-tab").first().waitFor();
  const titles = () => page.locator(".result-title").allInnerTexts();
  await expect.poll(titles).toEqual(["2 + 2"]);
  await page.getByRole("button", { name: "Close all results" }).click();
  await page.locator(".cm-content").click();
  await page.keyboard.press("Shift+Control+Enter");
  await expect.poll(titles).toEqual(["1 + 1", "2 + 2", "3 + 3"]);
});

test("an error is marked at its place, with message and remedy", async () => {
  await write(page, "query 1;\n\nquery Cubes feed\n  project[Nam] consume;");
  await page.keyboard.press("Control+End");
  await page.keyboard.press("Control+Enter");
  const failure = page.getByTestId("failure");
  await failure.waitFor();
  expect(await failure.innerText()).toContain("unknown attribute 'Nam', did you mean 'Name'?");
  expect(await failure.innerText()).toContain("Line 4");
  await expect.poll(() => page.locator(".cm-lintRange-error").innerText()).toBe("project");
  await takePicture(page, "queries-error");
  await run(page, "query 2");
  expect(await failure.count()).toBe(0);
  expect(await page.locator(".cm-lintRange-error").count()).toBe(0);
});

test("operators complete with syntax and description, attributes after a dot", async () => {
  await write(page, "query ");
  await page.keyboard.type("volu");
  const options = page.locator(".cm-tooltip-autocomplete li");
  await options.first().waitFor();
  expect(await options.first().innerText()).toContain("volume(_)");
  await expect.poll(() => page.locator(".cm-completionInfo").innerText()).toContain("enclosed volume");
  await page.waitForTimeout(150); // a list that has just appeared does not take keys yet
  await page.keyboard.press("Enter");
  expect(await page.locator(".cm-line").innerText()).toBe("query volume()");
  await write(page, "query Cubes feed filter[");
  await page.keyboard.type(".Ma");
  await options.first().waitFor();
  expect(await options.allInnerTexts()).toEqual(["Massreal"]);
});

test("the history is kept over a reload and can be searched", async () => {
  await run(page, "query Cubes feed count");
  await run(page, "query 17 * 2");
  await page.reload();
  await ready(page);
  await page.getByRole("tab", { name: "History" }).click();
  const entries = page.getByTestId("history").locator("li");
  await expect.poll(() => entries.count()).toBe(2);
  await page.getByRole("searchbox", { name: "Search history" }).fill("cubes");
  expect(await entries.allInnerTexts()).toEqual(["query Cubes feed count"]);
  await entries.getByRole("button", { name: "Run again" }).click();
  await page.getByTestId("table").waitFor();
  expect(await page.locator('[data-column="value"]').innerText()).toBe("5");
});

test("a long statement shows its progress and stops", async () => {
  await write(page, "query intstream(1, 1000000000) transformstream filter[.Elem < 0] count");
  await page.keyboard.press("Control+Enter");
  const running = page.getByTestId("running");
  await running.waitFor();
  await page.waitForTimeout(1500);
  expect(await running.innerText()).toMatch(/\d s|\ds/);
  await takePicture(page, "queries-running");
  await page.getByTestId("stop").click();
  await running.waitFor({ state: "detached" });
  expect(await page.getByTestId("failure").innerText()).toContain("Stopped.");
  const left = await fetch(`${server.url}api/statements`);
  await expect
    .poll(async () => (await (await fetch(`${server.url}api/statements`)).json()) as unknown)
    .toEqual([]);
  expect(left.ok).toBe(true);
});

test("thousands of rows are read as they are scrolled into view", async () => {
  await run(page, "query intstream(1, 20000) transformstream extend[Square: .Elem * .Elem] consume");
  const table = page.getByTestId("table");
  expect(await table.locator(".table-row").count()).toBeLessThan(60);
  await table.evaluate((element) => (element.scrollTop = element.scrollHeight));
  const last = table.locator('[data-row="19999"] [data-column="Square"]');
  await expect.poll(() => last.innerText()).toBe("400000000");
  await table.focus();
  await page.keyboard.press("Home");
  await expect.poll(() => selectedRow(page)).toBe(0);
});

test("a row is found by its object, and an object by its row", async () => {
  const fitSelection = async () => {
    await page.getByTestId("scene").focus();
    await page.keyboard.press(".");
  };
  await page.getByTestId("objects").getByText("Cubes").click();
  await page.getByTestId("table").waitFor();
  const whole = await stillScene(page);
  await page.locator('[data-row="3"] [data-column="Name"]').click();
  await fitSelection();
  const centred = await stillScene(page);
  await takePicture(page, "queries-selected");
  expect(centred.difference(whole)).toBeGreaterThan(0.05);
  await page.locator('[data-row="0"] [data-column="Name"]').click();
  await stillScene(page);
  expect(await selectedRow(page)).toBe(0);
  await page.locator('[data-row="3"] [data-column="Name"]').click();
  await fitSelection();
  await stillScene(page);
  // The fourth cube is in the middle now. Nothing is selected, then it is clicked.
  await page.getByTestId("scene").focus();
  await page.keyboard.press("Escape");
  await expect.poll(() => selectedRow(page)).toBeNull();
  await clickMiddle(page);
  await expect.poll(() => selectedRow(page)).toBe(3);
});

test("a long cell opens in place with its whole value", async () => {
  await page.getByTestId("objects").getByText("Cubes").click();
  await page.locator('[data-row="1"]').getByRole("button", { name: "Open Solid" }).click();
  await expect
    .poll(() => page.locator(".opened-cell pre").innerText())
    .toMatch(/^\(\(\(6\.0 2\.0 0\.0\)|^\(\(\(/);
  await takePicture(page, "queries-opened");
  await page.getByRole("button", { name: "Close Solid" }).first().click();
  expect(await page.locator(".opened-cell").count()).toBe(0);
});

test("several results are overlaid, each shown or hidden", async () => {
  await run(page, "query createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))");
  const one = await stillScene(page);
  await page.getByRole("button", { name: "Overlay" }).click();
  await run(page, "query createSphere(makePoint3D(1, 1, 3), 1, 24)");
  const both = await stillScene(page);
  await takePicture(page, "queries-overlay");
  expect(both.difference(one)).toBeGreaterThan(0.01);
  const eyes = page.getByTestId("result-tab").getByRole("button", { name: /in 3D/ });
  expect(await eyes.count()).toBe(2);
  await eyes.nth(1).click();
  const hidden = await stillScene(page);
  expect(hidden.difference(both)).toBeGreaterThan(0.01);
  await eyes.nth(0).click();
  const nothing = await stillScene(page);
  expect(nothing.difference(hidden)).toBeGreaterThan(0.02);
});

test("all shapes of a large result are seen, which come one batch after the other", async () => {
  await run(
    page,
    "query intstream(1, 3000) transformstream extend[S: createCube(makePoint3D(.Elem mod 100 * 3, .Elem div 100 * 3, 0), makePoint3D(.Elem mod 100 * 3 + 2, .Elem div 100 * 3 + 2, 2))] consume",
  );
  await page.mouse.move(2, 2); // no help of the editor over the scene
  await page.locator(".cm-tooltip").waitFor({ state: "detached" });
  const loaded = await stillScene(page);
  await takePicture(page, "queries-large");
  await page.getByTestId("scene").focus();
  await page.keyboard.press("Home");
  const home = await stillScene(page);
  expect(home.difference(loaded)).toBeLessThan(0.05);
});

test("a failure of drawing is shown with its result only", async () => {
  await run(page, "query createCube(makePoint3D(0, 0, 0), makePoint3D(1e300, 1e300, 1e300))");
  const told = page.getByTestId("scene-loading").getByText("nothing of this size can be drawn");
  await told.waitFor();
  await run(page, "query createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))");
  await told.waitFor({ state: "detached" });
  await stillScene(page);
  browser.errors.length = 0; // the refused request
});

test("the tab of the newest result is in sight", async () => {
  for (let count = 1; count <= 7; count++)
    await run(page, `query "a title that needs some room" + "${count}"`);
  const row = await page.locator(".result-tabs").boundingBox();
  const tab = await page.getByTestId("result-tab").last().boundingBox();
  expect(tab!.x).toBeGreaterThanOrEqual(row!.x - 1);
  expect(tab!.x + tab!.width).toBeLessThanOrEqual(row!.x + row!.width + 1);
  const first = await page.getByTestId("result-tab").first().boundingBox();
  expect(first!.x).toBeLessThan(row!.x);
});

test("objects of others are listed after the next statement", async () => {
  await server.run("let Elsewhere = 1");
  await run(page, "query 1");
  expect(await page.getByTestId("objects").getByText("Elsewhere").count()).toBe(1);
  await server.run("delete Elsewhere");
  await page.evaluate(() => dispatchEvent(new Event("focus")));
  await page.getByTestId("objects").getByText("Elsewhere").waitFor({ state: "detached" });
});

test("notes of a statement are shown with its result", async () => {
  await run(page, "query 1 / 0");
  expect(await page.getByTestId("diagnostics").innerText()).toMatch(/division by zero|zero/i);
});

test("a cell is downloaded as a mesh file", async () => {
  await page.getByTestId("objects").getByText("Cubes").click();
  const cell = page.locator('[data-row="1"] [data-column="Solid"]');
  await cell.hover();
  await cell.getByRole("button", { name: "Actions for Solid" }).click();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("menuitem", { name: "Download as OFF", exact: true }).click(),
  ]);
  expect(download.suggestedFilename()).toBe("cube 2.off");
  const stream = await download.createReadStream();
  const chunks: Buffer[] = [];
  for await (const chunk of stream) chunks.push(chunk as Buffer);
  expect(Buffer.concat(chunks).toString()).toMatch(/^OFF\s+8 12/);
});

test("objects are coloured by a column of the table", async () => {
  await page.getByTestId("objects").getByText("Cubes").click();
  const before = await stillScene(page);
  await page.getByRole("button", { name: "Colour the objects by Mass" }).click();
  const after = await stillScene(page);
  await takePicture(page, "queries-colours");
  expect(after.difference(before)).toBeGreaterThan(0.03);
});

test("operators are searched and explained, with examples for the editor", async () => {
  await page.getByRole("tab", { name: "Operators" }).click();
  await page.getByRole("searchbox", { name: /Search \d+ operators/ }).fill("enclosed volume");
  await page.locator(".operator-item", { hasText: "volume(_)" }).first().click();
  await page.getByRole("heading", { name: "volume" }).waitFor();
  await takePicture(page, "queries-operator");
  await page.locator(".example").first().getByRole("button", { name: "Put into the editor" }).click();
  await page.keyboard.press("Control+Enter");
  await expect.poll(() => page.locator('[data-column="value"]').innerText()).toBe("8");
});
