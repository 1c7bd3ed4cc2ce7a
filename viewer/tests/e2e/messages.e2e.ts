import { afterEach, expect, test } from "vitest";
import { boxOf, copiedLink, ready, run, stillScene, write } from "./support/actions";
import { Browser, takePicture, type BrowserOptions } from "./support/browser";
import { choose, field, openSettings, setColor } from "./support/scene";
import { Server } from "./support/server";

const cube = "let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))";

let ends: (() => Promise<void>)[] = [];

afterEach(async () => {
  for (const end of ends.reverse()) await end();
  ends = [];
});

async function startServer(...args: Parameters<typeof Server.start>): Promise<Server> {
  const server = await Server.start(...args);
  ends.push(() => server.remove());
  return server;
}

async function startBrowser(options: BrowserOptions = {}): Promise<Browser> {
  const browser = await Browser.start(options);
  ends.push(() => browser.end());
  return browser;
}

test("a server that is gone is told, and the page goes on when it is back", async () => {
  const server = await startServer([cube]);
  const browser = await startBrowser();
  const page = await browser.open(server.url);
  await ready(page);
  await run(page, "query volume(Cube)");
  await server.end();
  await write(page, "query area(Cube)");
  await page.keyboard.press("Control+Enter");
  const banner = page.getByTestId("server-gone");
  await banner.waitFor();
  expect(await banner.innerText()).toContain("The server does not answer.");
  expect(await banner.innerText()).toContain("It is asked each second.");
  const asked: number[] = [];
  page.on("request", (request) => request.url().endsWith("/api/server") && asked.push(Date.now()));
  await expect.poll(() => asked.length, { timeout: 60_000 }).toBeGreaterThanOrEqual(5);
  const pauses = asked.slice(1).map((time, index) => time - (asked[index] ?? 0));
  expect(Math.min(...pauses.slice(-2))).toBeLessThan(1.5 * Math.min(...pauses.slice(0, 2))); // they do not grow
  await takePicture(page, "messages-gone");
  await server.begin();
  const before = asked.length;
  // The page finds it by itself; a click on "Try now" would only be faster.
  await banner.waitFor({ state: "detached" });
  expect(asked.length - before).toBeLessThanOrEqual(2);
  await run(page, "query area(Cube)");
  expect(await page.locator('[data-column="value"]').innerText()).toBe("24");
});

test("rows that the server no longer has are told, and run again", async () => {
  const server = await startServer();
  const browser = await startBrowser();
  const page = await browser.open(server.url);
  await ready(page);
  const asked = page.waitForRequest((request) => new URL(request.url()).pathname === "/api/query");
  await run(page, "query intstream(1, 5000) transformstream consume");
  // The server keeps 64 results of each client.
  const client = (await asked).headers()["x-algebra3d-client"];
  for (let count = 0; count < 70; count++) await server.run("query makePoint3D(0, 0, 0)", client);
  await page.getByTestId("table").evaluate((element) => (element.scrollTop = 60_000));
  await page.getByText("The server no longer has this result.").waitFor();
  await page.getByRole("button", { name: "Run again" }).last().click();
  await page.getByText("The server no longer has this result.").waitFor({ state: "detached" });
  await page.getByTestId("table").evaluate((element) => (element.scrollTop = 60_000));
  await expect.poll(() => page.locator('[data-row="2145"] [data-column="Elem"]').innerText()).toBe("2146");
});

test("a server with a token asks for it, and accepts it in the address", async () => {
  const server = await startServer([], [], { ALGEBRA3D_TOKEN: "open-sesame-please" });
  const browser = await startBrowser();
  const page = await browser.open(server.url);
  const dialog = page.getByTestId("token-dialog");
  await dialog.waitFor();
  await takePicture(page, "messages-token");
  await dialog.getByLabel("Token").fill("wrong");
  await dialog.getByRole("button", { name: "Connect" }).click();
  await dialog.getByText("The server did not accept the token.").waitFor();
  await dialog.getByLabel("Token").fill("open-sesame-please");
  await dialog.getByRole("button", { name: "Connect" }).click();
  await ready(page);
  await run(page, "query 1 + 1");
  expect(await page.locator('[data-column="value"]').innerText()).toBe("2");
  const other = await startBrowser();
  const direct = await other.open(`${server.url}#token=open-sesame-please`);
  await ready(direct);
  expect(direct.url()).toBe(server.url);
});

test("without WebGL the page says so, and queries work", async () => {
  const server = await startServer([cube]);
  const browser = await startBrowser({ withoutWebGl: true });
  const page = await browser.open(server.url);
  await ready(page);
  const problem = page.getByTestId("scene-problem");
  await problem.waitFor();
  expect(await problem.innerText()).toMatch(/WebGL/);
  await run(page, "query volume(Cube)");
  expect(await page.locator('[data-column="value"]').innerText()).toBe("8");
  await takePicture(page, "messages-no-webgl");
  await page.getByRole("button", { name: "Compare" }).click();
  await page.getByTestId("side-left").getByTestId("scene-problem").waitFor();
  expect(await page.getByText("Choose a mesh for this side.").count()).toBe(0);
  await takePicture(page, "messages-no-webgl-compare");
});

test("the theme follows the system, and can be chosen", async () => {
  const server = await startServer([cube]);
  const browser = await startBrowser({ theme: "light" });
  const page = await browser.open(server.url);
  await ready(page);
  await page.getByTestId("objects").getByText("Cube").click();
  const light = await stillScene(page);
  await takePicture(page, "messages-light");
  expect(light.at(4, 4)[0]).toBeGreaterThan(200);
  const main = page.locator(".btn.primary").first();
  await main.hover();
  // Its text is white.
  await expect
    .poll(() => main.evaluate((button) => getComputedStyle(button).backgroundColor))
    .toBe("rgb(22, 79, 168)");
  await page.getByRole("button", { name: "Theme" }).click();
  await page.getByRole("menuitem", { name: "Dark theme" }).click();
  const dark = await stillScene(page);
  expect(dark.at(4, 4)[0]).toBeLessThan(60);
  await page.reload();
  await ready(page);
  expect(await page.locator("html").getAttribute("data-theme")).toBe("dark");
});

/** The contrast of a text with what is behind it, as WCAG 2 defines it. */
function contrastOf(element: Element): number {
  const context = document.createElement("canvas").getContext("2d", { willReadFrequently: true })!;
  const layers: { color: string; opacity: number }[] = [];
  for (let at: Element | null = element; at; at = at.parentElement) {
    const { backgroundColor, opacity } = getComputedStyle(at);
    layers.unshift({ color: backgroundColor, opacity: Number(opacity) });
  }
  const paint = (color: string, alpha: number) => {
    context.globalAlpha = alpha;
    context.fillStyle = color;
    context.fillRect(0, 0, 1, 1);
  };
  const luminance = () => {
    const [red = 0, green = 0, blue = 0] = [...context.getImageData(0, 0, 1, 1).data].map((part) => {
      const share = part / 255;
      return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  };
  for (const { color, opacity } of layers) paint(color, opacity);
  const ground = luminance();
  paint(
    getComputedStyle(element).color,
    layers.reduce((product, { opacity }) => product * opacity, 1),
  );
  const text = luminance();
  return (Math.max(ground, text) + 0.05) / (Math.min(ground, text) + 0.05);
}

test.each(["dark", "light"] as const)("quiet texts can be read in the %s theme", async (theme) => {
  const server = await startServer();
  const browser = await startBrowser({ theme });
  const page = await browser.open(server.url);
  await ready(page);
  await run(
    page,
    "query intstream(1, 3) transformstream extend[A: 1.0 / (.Elem - .Elem), P: makePoint3D(.Elem, 0, 0)] consume",
  );
  // Under its notes the table has room for two rows.
  const table = await boxOf(page, '[data-testid="table"]');
  const second = await boxOf(page, '.table-row[data-row="1"]');
  expect(second.y + second.height).toBeLessThanOrEqual(table.y + table.height);
  const cell = page.locator(".undefined").first();
  const expectContrast = async (place: ReturnType<typeof page.locator>, name: string) =>
    expect(await place.evaluate(contrastOf), name).toBeGreaterThanOrEqual(4.5);
  await page.mouse.move(0, 0);
  await expectContrast(cell, "undefined");
  await cell.hover();
  await expectContrast(cell, "undefined under the pointer");
  await cell.click();
  await page.locator('.table-row[aria-selected="true"]').waitFor();
  await expectContrast(cell, "undefined in the selected row");
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type("\n# a remark\nquery 1");
  await page.keyboard.press("Escape");
  for (const number of await page.locator(".cm-lineNumbers .cm-gutterElement:visible").all())
    await expectContrast(number, "number of a line");
  await expectContrast(page.locator(".cm-line span", { hasText: "a remark" }).first(), "a remark");
});

test("why a mesh cannot be saved stands at its name", async () => {
  const server = await startServer([cube]);
  const browser = await startBrowser();
  const page = await browser.open(server.url);
  await ready(page);
  await page.getByRole("button", { name: "Compare" }).click();
  const side = page.getByTestId("side-left");
  await side.getByLabel("Mesh of this side").selectOption("Cube");
  await side.getByTestId("facts").waitFor();
  await side.getByRole("button", { name: "Save as a new object" }).click();
  const name = side.getByLabel("Name of the new object");
  const problem = side.getByTestId("name-problem");
  const save = side.getByRole("button", { name: "Save", exact: true });
  const told = () => problem.textContent();
  expect(await told()).toBe("");
  await name.fill("1st");
  expect(await told()).toContain("A name is a letter");
  await name.fill("Cube");
  expect(await told()).toContain("There is an object Cube already.");
  // Somebody else takes a name that is free in the list of this page.
  await server.run("let Taken = 1");
  await name.fill("Taken");
  expect(await told()).toBe("");
  await save.click();
  await expect.poll(told).toContain("there is an object 'Taken' already");
  const [field, message] = [await name.boundingBox(), await problem.boundingBox()];
  expect(message!.y - (field!.y + field!.height)).toBeLessThan(40);
  await takePicture(page, "messages-refused-save");
  await name.fill("Free");
  expect(await told()).toBe("");
  await save.click();
  await name.waitFor({ state: "detached" });
  expect(await server.run("query volume(Free)")).toMatchObject({ value: 8 });
});

test("the dialog for a name stays until the object is stored", async () => {
  const server = await startServer([cube]);
  const browser = await startBrowser();
  const page = await browser.open(server.url);
  await ready(page);
  await page.getByTestId("objects").getByText("Cube").click();
  await page.locator('.table-row [data-column="value"]').hover();
  await page.getByRole("button", { name: "Actions for value" }).click();
  await page.getByRole("menuitem", { name: "Store as object…" }).click();
  const dialog = page.getByTestId("name-dialog");
  await server.run("let Taken = 1");
  await dialog.getByLabel("Name", { exact: true }).fill("Taken");
  await dialog.getByRole("button", { name: "Store" }).click();
  const problem = dialog.getByTestId("name-problem");
  await expect.poll(() => problem.textContent()).toContain("there is an object 'Taken' already");
  await takePicture(page, "messages-name-dialog");
  await dialog.getByLabel("Name", { exact: true }).fill("Copy");
  await dialog.getByRole("button", { name: "Store" }).click();
  await dialog.waitFor({ state: "detached" });
  expect(await server.run("query volume(Copy)")).toMatchObject({ value: 8 });
});

test("a link restores statements, table, selection, colours and camera", async () => {
  const server = await startServer([cube]);
  const browser = await startBrowser();
  const page = await browser.open(server.url);
  await ready(page);
  await run(
    page,
    "query intstream(1, 4) transformstream extend[S: createCube(makePoint3D(.Elem * 3, 0, 0), makePoint3D(.Elem * 3 + 2, 2, 2))] consume",
  );
  await page.getByRole("button", { name: "Colour the objects by Elem" }).click();
  await page.locator('[data-row="2"] [data-column="Elem"]').click();
  const before = await stillScene(page);
  const link = await copiedLink(page);
  expect(link).toMatch(/#view=[\w-]{50,}$/);
  const other = await startBrowser();
  const restored = await other.open(link);
  // The statement was never run in that browser, so that a person is asked.
  await restored.getByTestId("link-dialog").waitFor();
  await takePicture(restored, "messages-link-dialog");
  expect(await restored.getByTestId("link-dialog").innerText()).toContain("query intstream(1, 4)");
  await restored.getByRole("button", { name: "Run and show" }).click();
  await restored.getByTestId("table").waitFor();
  await expect
    .poll(() => restored.locator('.table-row[aria-selected="true"]').getAttribute("data-row"))
    .toBe("2");
  const after = await stillScene(restored);
  await takePicture(restored, "messages-link-restored");
  expect(after.difference(before)).toBeLessThan(0.01);
});

test("a link restores section, lights, colours of objects, display, projection and mouse", async () => {
  const server = await startServer([cube]);
  const browser = await startBrowser({ theme: "light" });
  const page = await browser.open(server.url);
  await page.emulateMedia({ reducedMotion: "reduce" });
  await ready(page);
  await page.getByTestId("objects").getByText("Cube").click();
  await stillScene(page);
  await openSettings(page);
  await setColor(page, "appearance", "Object colour", "#44aa66");
  await setColor(page, "appearance", "Background colour", "#fff0d0");
  await choose(page, "appearance", "Edges", "None");
  await field(page, "display", "Grid").setChecked(true);
  await field(page, "display", "Axes").setChecked(false);
  await choose(page, "navigation", "Projection", "Orthographic");
  await field(page, "navigation", "Mouse as in").selectOption("blender");
  await page.getByTestId("lights-panel").getByRole("button", { name: "Add light" }).click();
  await field(page, "section", "Section plane").setChecked(true);
  await page.getByTestId("cut-area").waitFor();
  const before = await stillScene(page);
  const link = await copiedLink(page);
  const other = await startBrowser({ theme: "light" });
  const restored = await other.open(link);
  await restored.emulateMedia({ reducedMotion: "reduce" });
  // `query Cube` only shows an object: nobody has to be asked.
  await restored.getByTestId("table").waitFor();
  await openSettings(restored);
  await restored.getByTestId("cut-area").waitFor();
  expect(await field(restored, "display", "Grid").isChecked()).toBe(true);
  expect(await field(restored, "display", "Axes").isChecked()).toBe(false);
  expect(await field(restored, "navigation", "Mouse as in").inputValue()).toBe("blender");
  expect(await field(restored, "section", "Section plane").isChecked()).toBe(true);
  const after = await stillScene(restored);
  await takePicture(restored, "messages-link-kinds");
  expect(after.difference(before)).toBeLessThan(0.01);
});

test("a damaged link is refused with a message", async () => {
  const server = await startServer();
  const browser = await startBrowser();
  const page = await browser.open(`${server.url}#view=AAAA`);
  await page.getByText("The link is damaged").waitFor();
});

test("a read-only server refuses changes with its reason", async () => {
  const server = await startServer([cube]);
  await server.end();
  const browser = await startBrowser();
  server.options.push("--read-only");
  await server.begin();
  const page = await browser.open(server.url);
  await ready(page);
  await page.getByText("read only").waitFor();
  await run(page, "let A = 1");
  expect(await page.getByTestId("failure").innerText()).toMatch(/read.only/i);
});
