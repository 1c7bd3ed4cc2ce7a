// node tests/bench/drawing.mjs --program PATH --db FILE --object NAME [--pages FOLDER] [--runs N] [--drag SECONDS]
//                              [--loaded] [--profile FILE] [--picture FILE]
// Opens the viewer at 1280 x 720 in Chromium with software rendering, clicks on an object of a database, and tells what a
// person waits for: when it is first drawn, when all of it is there, and the longest pause in between, in which the page
// draws nothing and answers nothing. Beside them the longest task of the page in processor time, which another load of the
// machine does not change, the processor seconds of page, graphics process and server, and the memory at the end.
// The first opening is of a database without levels of detail, which the server makes and keeps; the others find them.
// With --drag the object is turned with the mouse then. With --profile the last opening leaves a profile of the page.
//
// On a machine where other programs use more than half a processor it refuses to measure. With --loaded it measures
// nevertheless, and marks the figures.
/* global addEventListener, document, fetch, performance, PointerEvent, requestAnimationFrame, setTimeout, WebGL2RenderingContext */
import { spawn } from "node:child_process";
import { copyFileSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { parseArgs } from "node:util";

import { chromium } from "playwright-core";

import { machineSeconds, ownBytes, processesOf, processorSeconds } from "./processes.mjs";

const { values: options } = parseArgs({
  options: {
    program: { type: "string" },
    db: { type: "string" },
    object: { type: "string" },
    pages: { type: "string" },
    runs: { type: "string", default: "6" },
    drag: { type: "string", default: "0" },
    loaded: { type: "boolean", default: false },
    profile: { type: "string" },
    picture: { type: "string" },
    chromium: { type: "string", default: "/usr/bin/chromium" },
  },
});
if (!options.program || !options.db || !options.object) {
  console.error("drawing: --program, --db and --object are needed");
  process.exit(2);
}

/** Processors that other programs may use while we measure. */
const kMostForeign = 0.5;
const kPatience = 300_000;

/** Runs in the page: notes frames from the first click on, and the triangles that they draw. */
function watch() {
  const seen = { click: 0, first: 0, triangles: 0, frames: [], last: 0, gaps: [] };
  Object.assign(globalThis, { seen });
  let before = 0;
  addEventListener(
    "click",
    () => {
      if (seen.click) return;
      seen.click = before = performance.now();
      requestAnimationFrame(beat);
    },
    { capture: true },
  );
  /** What a person sees of a pause: the time between two frames that the browser asks for. */
  function beat() {
    const now = performance.now();
    seen.gaps.push([before - seen.click, now - before]);
    before = now;
    requestAnimationFrame(beat);
  }
  const { drawElements } = WebGL2RenderingContext.prototype;
  let drawn = 0;
  WebGL2RenderingContext.prototype.drawElements = function (mode, count, ...rest) {
    drawElements.call(this, mode, count, ...rest);
    if (mode !== this.TRIANGLES || count < 300) return;
    if (drawn === 0) requestAnimationFrame(endOfFrame);
    drawn += count / 3;
  };
  function endOfFrame(now) {
    if (seen.click) seen.first ||= performance.now();
    seen.triangles = drawn;
    seen.frames.push({ time: seen.last ? now - seen.last : 0, triangles: drawn });
    seen.last = now;
    drawn = 0;
  }
}

const folder = mkdtempSync(join(tmpdir(), "algebra3d-drawing-"));
const port = 8000 + (process.pid % 1000);
const url = `http://127.0.0.1:${port}/`;
const median = (values, share = 0.5) =>
  [...values].sort((a, b) => a - b)[Math.floor(values.length * share)] ?? 0;
const seconds = (milliseconds) => `${(milliseconds / 1000).toFixed(2)} s`;

try {
  copyFileSync(options.db, join(folder, "measured.db"));
  const runs = Number(options.runs);
  const later = [];
  for (let run = 1; run <= runs; run++) {
    await refuseLoad();
    const figures = await opening({ isLast: run === runs });
    console.log(`${options.object}, opening ${run}: ${told(figures)}`);
    if (run > 1) later.push(figures);
  }
  if (later.length > 1)
    console.log(`${options.object}, median of ${later.length} later openings: ${told(medians(later))}`);
} catch (error) {
  console.error(`drawing: ${error instanceof Error ? error.message : error}`);
  process.exitCode = 1;
} finally {
  rmSync(folder, { recursive: true, force: true });
}

/** Looks for two seconds at what the machine does without us. */
async function refuseLoad() {
  const before = machineSeconds();
  await new Promise((next) => setTimeout(next, 2000));
  const foreign = (machineSeconds() - before) / 2;
  if (foreign > kMostForeign && !options.loaded)
    throw new Error(
      `other programs use ${foreign.toFixed(1)} processors, and figures would be theirs; ` +
        "wait, or take --loaded for figures that are marked",
    );
}

async function opening({ isLast }) {
  const server = spawn(resolve(options.program), ["serve", "--db", "measured.db", "--port", String(port)], {
    stdio: "ignore",
    cwd: folder,
  });
  const profile = mkdtempSync(join(tmpdir(), "algebra3d-chromium-"));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: options.chromium,
    viewport: { width: 1280, height: 720 },
    ignoreDefaultArgs: ["--headless"],
    args: [
      "--headless=new",
      "--no-sandbox",
      "--enable-unsafe-swiftshader",
      "--use-gl=angle",
      "--use-angle=swiftshader",
    ],
  });
  try {
    const page = context.pages()[0];
    page.setDefaultTimeout(kPatience);
    await page.addInitScript(watch);
    if (options.pages) await servePages(page, resolve(options.pages));
    await waitForServer();
    // The contact sheet of the first page would be measured with what is opened.
    const queries = (address) => address.pathname === "/api/query";
    await page.route(queries, (route) => route.abort());
    await page.goto(url);
    const object = page.getByTestId("objects").getByText(options.object, { exact: true });
    await object.waitFor();
    await page.waitForTimeout(1000);
    await page.unroute(queries);
    const session = await context.newCDPSession(page);
    const isProfiled = isLast && options.profile;
    if (isProfiled) {
      await session.send("Profiler.enable");
      await session.send("Profiler.setSamplingInterval", { interval: 500 });
      await session.send("Profiler.start");
    }
    const figures = await measured(context, server.pid, page, object);
    if (isProfiled) {
      const { profile: taken } = await session.send("Profiler.stop");
      writeFileSync(options.profile, JSON.stringify(taken));
    }
    if (isLast) {
      await page.waitForTimeout(1500);
      if (Number(options.drag) > 0) await drag(page, Number(options.drag));
      if (options.picture) await page.screenshot({ path: options.picture });
    }
    return figures;
  } finally {
    await context.close();
    server.kill();
    rmSync(profile, { recursive: true, force: true });
  }
}

/** Opens the object, and waits until all of it is drawn. */
async function measured(context, server, page, object) {
  const trace = await startTrace(context, page);
  const before = usage(server);
  const start = performance.now();
  await object.click();
  await page.getByTestId("result-tab").waitFor();
  await page.waitForFunction(() => globalThis.seen.first > 0);
  await page.waitForFunction(isComplete, null, { polling: 50 });
  const { first, all, gaps, triangles } = await page.evaluate(async () => {
    const { seen } = globalThis;
    // The commands of the last frame are sent; the browser asks for others when they are carried out.
    for (let frame = 0; frame < 3; frame++) await new Promise(requestAnimationFrame);
    return {
      first: seen.first - seen.click,
      all: performance.now() - seen.click,
      gaps: seen.gaps,
      triangles: seen.triangles,
    };
  });
  const elapsed = (performance.now() - start) / 1000;
  const after = usage(server);
  const used = Object.fromEntries(Object.entries(after).map(([name, value]) => [name, value - before[name]]));
  const { machine, ...own } = used;
  const others = (machine - own.page - own.graphics - own.server - own.rest) / elapsed;
  const tasks = await trace.end();
  const pause = gaps.reduce((longest, gap) => (gap[1] > longest[1] ? gap : longest), [0, 0]);
  const memory = (kind) => Math.max(...processesOf(process.pid, `--type=${kind}`).map(ownBytes)) / 1e6;
  return {
    first,
    all,
    pause: pause[1],
    pauseAt: pause[0],
    task: tasks.longest,
    ...own,
    triangles,
    pageMemory: memory("renderer"),
    graphicsMemory: memory("gpu-process"),
    others,
  };
}

/** Runs in the page. */
function isComplete() {
  const canvas = document.querySelector('[data-testid="scene"] canvas, .scene-canvas canvas');
  return !document.querySelector('[data-testid="scene-loading"]') && canvas?.dataset.drawn === "full";
}

/** Processor seconds so far. */
function usage(server) {
  const sum = (ids) => ids.reduce((total, id) => total + processorSeconds(id), 0);
  const all = processesOf(process.pid);
  const page = processesOf(process.pid, "--type=renderer");
  const graphics = processesOf(process.pid, "--type=gpu-process");
  const rest = all.filter((id) => id !== server && !page.includes(id) && !graphics.includes(id));
  return {
    page: sum(page),
    graphics: sum(graphics),
    server: processorSeconds(server),
    rest: sum([process.pid, ...rest]),
    machine: machineSeconds(),
  };
}

/** The tasks of the page's main thread, with the processor time that they took. */
async function startTrace(context, page) {
  const session = await context.newCDPSession(page);
  const found = [];
  const threads = new Map();
  session.on("Tracing.dataCollected", ({ value }) => {
    for (const { name, ph, pid, tid, tdur, args } of value) {
      if (name === "thread_name") threads.set(`${pid} ${tid}`, args.name);
      else if (ph === "X" && name.endsWith("RunTask") && tdur > 20_000)
        found.push([`${pid} ${tid}`, tdur / 1000]);
    }
  });
  const includedCategories = ["toplevel", "__metadata"];
  await session.send("Tracing.start", { transferMode: "ReportEvents", traceConfig: { includedCategories } });
  return {
    end: async () => {
      const complete = new Promise((done) => session.once("Tracing.tracingComplete", done));
      await session.send("Tracing.end");
      await complete;
      const ofPage = found.filter(([thread]) => threads.get(thread) === "CrRendererMain");
      return { longest: Math.max(0, ...ofPage.map(([, time]) => time)) };
    },
  };
}

function medians(all) {
  return Object.fromEntries(Object.keys(all[0]).map((name) => [name, median(all.map((one) => one[name]))]));
}

function told(figures) {
  const { first, all, pause, pauseAt, task, page, graphics, server, triangles, others } = figures;
  const mark = others > kMostForeign ? ` [LOADED: ${others.toFixed(1)} processors are taken by others]` : "";
  return (
    `first picture ${seconds(first)}, all ${seconds(all)}, longest pause ${Math.round(pause)} ms ` +
    `(${seconds(pauseAt)} after the click), longest task of the page ${Math.round(task)} ms of processor time; ` +
    `processor seconds: page ${page.toFixed(1)}, graphics ${graphics.toFixed(1)}, server ${server.toFixed(1)}; ` +
    `memory: page ${Math.round(figures.pageMemory)} MB, graphics ${Math.round(figures.graphicsMemory)} MB; ` +
    `${Math.round(triangles)} triangles in the last frame${mark}`
  );
}

async function servePages(page, pages) {
  await page.route(
    (address) => address.origin + "/" === url && !address.pathname.startsWith("/api/"),
    (route) => {
      const { pathname } = new URL(route.request().url());
      return route.fulfill({ path: join(pages, pathname === "/" ? "index.html" : pathname) });
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

async function drag(page, duration) {
  const box = await page.getByTestId("scene").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  const frames = await page.evaluate(movePointer, { x, y, duration });
  await page.mouse.up();
  const times = frames.slice(5).map(({ time }) => time);
  const drawn = frames.map(({ triangles }) => triangles);
  console.log(
    `dragging on ${Math.round(box.width)} x ${Math.round(box.height)}: ${frames.length} frames in ${duration} s, ` +
      `median ${Math.round(median(times))} ms, 90 % below ${Math.round(median(times, 0.9))} ms, ` +
      `worst ${Math.round(Math.max(...times))} ms; triangles drawn ${median(drawn)} (most ${Math.max(...drawn)})`,
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
