/** Stop is answered within 100 ms, whatever the page is doing. Times are those that the page itself sees. */

import { afterEach, beforeEach, expect, test } from "vitest";
import type { Page, Route } from "playwright-core";

import { ready, run, stillScene, write } from "./support/actions";
import { takePicture } from "./support/browser";
import { kScene } from "./support/scene";
import { Session } from "./support/session";

/** Milliseconds from the click to the page that says so, at most. */
const kMostMilliseconds = 100;

const session = new Session({
  browser: { width: 1280, height: 720 },
  statements: [
    "let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))",
    "let Ball = createSphere(makePoint3D(0, 0, 0), 1.0, 200)",
  ],
  initScript: () => {
    const held: (() => void)[] = [];
    Object.assign(window, { decodedLater: held, holdsDecoded: false });
    // The answers of the worker that decodes shapes can be kept back, so that decoding takes as long as the test needs.
    const Original = Worker;
    window.Worker = class extends Original {
      override set onmessage(listener: ((event: MessageEvent) => void) | null) {
        super.onmessage = (event) => {
          const take = () => listener?.call(this, event);
          if ("holdsDecoded" in window && window.holdsDecoded === true) held.push(take);
          else take();
        };
      }
    };
  },
});
let page: Page;

beforeEach(() => {
  page = session.page;
});

afterEach(() => page.unrouteAll({ behavior: "ignoreErrors" }));

/** Clicks on a button and answers with the milliseconds until an element is there, as the page sees them. */
async function reaction(button: string, sign: string, within = "body"): Promise<number> {
  await page.evaluate(
    ({ button, sign }) => {
      const seen = new Promise<number>((resolve) => {
        let clicked: number | null = null;
        document.addEventListener(
          "click",
          ({ target, timeStamp }) => {
            if (target instanceof Element && target.closest("button")?.innerText.trim() === button)
              clicked = timeStamp; // of the hand, not of the listener
          },
          { capture: true, once: true },
        );
        new MutationObserver((_, observer) => {
          if (clicked === null || !document.querySelector(sign)) return;
          observer.disconnect();
          resolve(performance.now() - clicked);
        }).observe(document.body, { subtree: true, childList: true, attributes: true });
      });
      Object.assign(window, { reaction: seen });
    },
    { button, sign },
  );
  await page.locator(within).getByRole("button", { name: button, exact: true }).click();
  return page.evaluate(() => (window as unknown as { reaction: Promise<number> }).reaction);
}

/** Keeps back requests until they are let go, or given up by the page. */
async function hold(pattern: string, isHeld: (url: string) => boolean = () => true): Promise<Route[]> {
  const held: Route[] = [];
  await page.route(pattern, async (route) => {
    if (isHeld(route.request().url())) held.push(route);
    else await route.continue();
  });
  return held;
}

const givenUp = () => page.waitForEvent("requestfailed");

test("while a statement runs", async () => {
  await write(page, "query intstream(1, 1000000000) transformstream filter[.Elem < 0] count");
  await page.keyboard.press("Control+Enter");
  await page.getByTestId("running").waitFor();
  expect(await reaction("Stop", '[data-testid="failure"]')).toBeLessThan(kMostMilliseconds);
  expect(await page.getByTestId("failure").innerText()).toContain("Stopped.");
  const statements = async () =>
    (await (await fetch(`${session.server.url}api/statements`)).json()) as unknown[];
  await expect.poll(statements).toEqual([]);
});

test("while shapes are on their way", async () => {
  const held = await hold("**/shapes?*");
  await run(page, "query Cube");
  await expect.poll(() => held.length).toBe(1);
  const failed = givenUp();
  expect(await reaction("Stop loading", '[data-testid="scene-stopped"]')).toBeLessThan(kMostMilliseconds);
  expect((await failed).url()).toContain("/shapes");
  await page.unrouteAll({ behavior: "ignoreErrors" });
  await page.getByRole("button", { name: "Load the rest" }).click();
  expect((await stillScene(page)).colors()).toBeGreaterThan(10);
});

test("while shapes are decoded", async () => {
  await page.evaluate(() => Object.assign(window, { holdsDecoded: true }));
  await run(page, "query Cube");
  await page.waitForFunction(
    () => (window as unknown as { decodedLater: unknown[] }).decodedLater.length > 0,
  );
  expect(await reaction("Stop loading", '[data-testid="scene-stopped"]')).toBeLessThan(kMostMilliseconds);
  const before = await stillScene(page);
  await page.evaluate(() => {
    Object.assign(window, { holdsDecoded: false });
    (window as unknown as { decodedLater: (() => void)[] }).decodedLater.forEach((take) => take());
  });
  expect((await stillScene(page)).difference(before)).toBe(0); // what comes too late is not taken
});

test("while many shapes are added to the picture", async () => {
  const requests: string[] = [];
  page.on("request", (request) => request.url().includes("/shapes?") && requests.push(request.url()));
  await write(
    page,
    "query intstream(0, 9999) transformstream extend[Ball: createSphere(makePoint3D(3 * (.Elem mod 100), 3 * (.Elem div 100), 0), 1.0, 12)] consume",
  );
  await page.keyboard.press("Control+Enter");
  await page.getByText(/[1-9]\d* of 10000 objects/).waitFor();
  expect(await reaction("Stop loading", '[data-testid="scene-stopped"]')).toBeLessThan(kMostMilliseconds);
  await takePicture(page, "stop-many");
  const loaded = Number(
    /(\d+) of 10000/.exec(await page.getByTestId("scene-stopped").innerText())?.[1] ?? NaN,
  );
  const asked = requests.length;
  expect(loaded).toBeLessThan(10000);
  await page.getByRole("button", { name: "Load the rest" }).click();
  await expect.poll(() => requests.length).toBeGreaterThan(asked);
  expect(requests[asked]).toMatch(/from=(?!0&)\d+/); // it goes on where it was
});

test("while a shape is made finer", async () => {
  const held = await hold("**/shapes?*", (url) => /triangles=0\b/.test(url));
  await run(page, "query Ball");
  await expect.poll(() => held.length).toBe(1);
  expect(await reaction("Stop loading", '[data-testid="scene-stopped"]')).toBeLessThan(kMostMilliseconds);
  expect(await page.getByTestId("scene-stopped").innerText()).toContain("1 object");
  expect((await stillScene(page)).colors()).toBeGreaterThan(10); // the coarse one stays
});

test("while a file is sent", async () => {
  const held = await hold("**/uploads/*");
  await page.locator('input[type="file"]').setInputFiles({
    name: "held.stl",
    mimeType: "model/stl",
    buffer: Buffer.from("solid x\nendsolid x\n"),
  });
  await expect.poll(() => held.length).toBe(1);
  const sign = '[data-testid="review"][data-phase="failed"]';
  expect(await reaction("Stop", sign)).toBeLessThan(kMostMilliseconds);
  expect(await page.getByTestId("review").innerText()).toContain("Stopped.");
});

test("while a step of the split screen is computed", async () => {
  await page.getByRole("button", { name: "Compare" }).click();
  const side = page.getByTestId("side-left");
  await side.getByLabel("Mesh of this side").selectOption("Cube");
  await side.getByTestId("facts").waitFor();
  const held = await hold("**/api/query");
  await side.getByRole("button", { name: "Dual", exact: true }).click();
  await expect.poll(() => held.length).toBe(1);
  const sign = '[data-testid="side-left"] .callout.error';
  expect(await reaction("Stop", sign, '[data-testid="side-left"]')).toBeLessThan(kMostMilliseconds);
  expect(await side.getByRole("alert").innerText()).toBe("Stopped.");
});

test("the next thing is shown after any of them", async () => {
  await ready(page);
  await run(page, "query Cube");
  expect((await stillScene(page, kScene)).colors()).toBeGreaterThan(10);
});
