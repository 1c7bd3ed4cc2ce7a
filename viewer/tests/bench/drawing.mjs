// node tests/bench/drawing.mjs --program PATH --db FILE --object NAME [--pages FOLDER] [--drag SECONDS] [--picture FILE]
// Opens the viewer at 1280 x 720 in Chromium with software rendering and clicks on an object of a database. Tells when it
// is first drawn and when all of it is there, what memory the browser has then, and, with --drag, how long frames take
// while it is turned with the mouse, and how many triangles they draw. Load of the machine beside it.
/* global addEventListener, document, fetch, performance, PointerEvent, requestAnimationFrame, setTimeout, WebGL2RenderingContext */
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { loadavg, tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { parseArgs } from "node:util";

import { chromium } from "playwright-core";

import { processesOf, ownBytes } from "./processes.mjs";

const { values: options } = parseArgs({
  options: {
    program: { type: "string" },
    db: { type: "string" },
    object: { type: "string" },
    pages: { type: "string" },
    drag: { type: "string", default: "0" },
    picture: { type: "string" },
    chromium: { type: "string", default: "/usr/bin/chromium" },
  },
});
if (!options.program || !options.db || !options.object) {
  console.error("drawing: --program, --db and --object are needed");
  process.exit(2);
}

/** Runs in the page: notes the time of the first click, and the triangles and times of frames. */
function watch() {
  const seen = { click: 0, first: 0, triangles: 0, frames: [], last: 0 };
  Object.assign(globalThis, { seen });
  addEventListener("click", () => (seen.click ||= performance.now()), { capture: true });
  const { drawElements } = WebGL2RenderingContext.prototype;
  let drawn = 0;
  WebGL2RenderingContext.prototype.drawElements = function (mode, count, ...rest) {
    drawElements.call(this, mode, count, ...rest);
    if (mode !== this.TRIANGLES || count < 300) return;
    if (drawn === 0) requestAnimationFrame(endOfFrame);
    drawn += count / 3;
  };
  function endOfFrame(now) {
    seen.first ||= performance.now();
    seen.triangles = drawn;
    seen.frames.push({ time: seen.last ? now - seen.last : 0, triangles: drawn });
    seen.last = now;
    drawn = 0;
  }
}

const port = 8000 + (process.pid % 1000);
const url = `http://127.0.0.1:${port}/`;
const server = spawn(resolve(options.program), ["serve", "--db", options.db, "--port", String(port)], {
  stdio: "ignore",
  cwd: tmpdir(),
});
const profile = mkdtempSync(join(tmpdir(), "algebra3d-chromium-"));
const context = await chromium.launchPersistentContext(profile, {
  executablePath: options.chromium,
  viewport: { width: 1280, height: 720 },
  ignoreDefaultArgs: ["--headless"],
  args: ["--headless=new", "--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader"],
});
try {
  const page = context.pages()[0];
  await page.addInitScript(watch);
  if (options.pages) await servePages(page, resolve(options.pages));
  await waitForServer();
  await page.goto(url);
  await page.getByTestId("objects").getByText(options.object, { exact: true }).click();
  await page.getByTestId("result-tab").waitFor();
  await page.waitForFunction(() => globalThis.seen.first > 0, null, { timeout: 120_000 });
  await page.getByTestId("scene-loading").waitFor({ state: "detached", timeout: 120_000 });
  const { first, all, triangles } = await page.evaluate(() => {
    const { seen } = globalThis;
    return { first: seen.first - seen.click, all: performance.now() - seen.click, triangles: seen.triangles };
  });
  console.log(`load ${loadavg()[0].toFixed(1)}: first picture ${seconds(first)}, all ${seconds(all)}`);
  for (const line of await page.evaluate(requests)) console.log(`  ${line}`);
  tellMemory();
  await page.waitForTimeout(1500);
  console.log(
    `triangles drawn at rest: ${await page.evaluate(() => globalThis.seen.triangles)} (then ${triangles})`,
  );
  if (Number(options.drag) > 0) await drag(page, Number(options.drag));
  if (options.picture) await page.screenshot({ path: options.picture });
} finally {
  await context.close();
  server.kill();
  rmSync(profile, { recursive: true, force: true });
}

async function servePages(page, folder) {
  await page.route(
    (address) => address.origin + "/" === url && !address.pathname.startsWith("/api/"),
    (route) => {
      const { pathname } = new URL(route.request().url());
      return route.fulfill({ path: join(folder, pathname === "/" ? "index.html" : pathname) });
    },
  );
}

async function waitForServer() {
  for (let attempt = 0; attempt < 200; attempt++) {
    if (await fetch(`${url}api/server`).catch(() => null)) return;
    await new Promise((next) => setTimeout(next, 50));
  }
  throw new Error("the server does not answer");
}

function tellMemory() {
  for (const kind of ["renderer", "gpu-process"]) {
    const bytes = processesOf(process.pid, `--type=${kind}`).map(ownBytes);
    console.log(`memory of ${kind}: ${Math.round(Math.max(...bytes) / 1e6)} MB`);
  }
}

async function drag(page, duration) {
  const box = await page.getByTestId("scene").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  const frames = await page.evaluate(movePointer, { x, y, duration });
  await page.mouse.up();
  const full = Math.max(...frames.map(({ triangles }) => triangles));
  const afterFull = frames.filter((_, i) => frames[i - 1]?.triangles > full / 2).map(({ time }) => time);
  const times = frames.slice(5).map(({ time }) => time);
  const scale = await page.evaluate(
    () => document.querySelector("canvas").width / document.querySelector("canvas").clientWidth,
  );
  console.log(
    `dragging on ${Math.round(box.width)} x ${Math.round(box.height)}: ${frames.length} frames in ${duration} s, ` +
      `median ${median(times, 0.5)} ms, 90 % below ${median(times, 0.9)} ms; triangles drawn ` +
      `${median(
        frames.map(({ triangles }) => triangles),
        0.5,
      )} (most ${full}); scale at the end ${scale.toFixed(2)}; ` +
      `load ${loadavg()[0].toFixed(1)}`,
  );
  console.log(
    `frames drawn in full: ${afterFull.length}, median ${median(afterFull, 0.5)} ms, 90 % below ${median(afterFull, 0.9)} ms`,
  );
}

/** Runs in the page: when the shapes were asked for, began to come and were there, after the click. */
function requests() {
  const { click } = globalThis.seen;
  const since = (time) => `${((time - click) / 1000).toFixed(2)} s`;
  return performance
    .getEntriesByType("resource")
    .filter(({ name }) => name.includes("/shapes"))
    .map(({ name, requestStart, responseStart, responseEnd, encodedBodySize }) =>
      [
        new URL(name).search,
        `asked ${since(requestStart)}, first byte ${since(responseStart)}, last ${since(responseEnd)}`,
        `${Math.round(encodedBodySize / 1e6)} MB`,
      ].join(": "),
    );
}

/** Runs in the page: moves the pointer before each frame, as a mouse does. */
async function movePointer({ x, y, duration }) {
  const canvas = document.elementFromPoint(x, y);
  const { seen } = globalThis;
  seen.frames.length = 0;
  const end = performance.now() + 1000 * duration;
  for (let step = 0; performance.now() < end; step++) {
    const place = { clientX: x + 150 * Math.sin(step / 20), clientY: y + 80 * Math.cos(step / 31) };
    canvas.dispatchEvent(
      new PointerEvent("pointermove", { ...place, pointerId: 1, buttons: 1, bubbles: true }),
    );
    await new Promise(requestAnimationFrame);
  }
  return seen.frames;
}

function median(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  return Math.round(sorted[Math.floor(sorted.length * share)] ?? 0);
}

function seconds(milliseconds) {
  return `${(milliseconds / 1000).toFixed(2)} s`;
}
