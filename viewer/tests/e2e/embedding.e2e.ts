import { createServer, type Server as HttpServer } from "node:http";
import type { AddressInfo } from "node:net";
import { afterAll, afterEach, beforeAll, expect, test } from "vitest";
import { expectNoErrors } from "./support/actions";
import { Browser } from "./support/browser";
import { Server } from "./support/server";

let portal: HttpServer;
let browser: Browser;
let server: Server | null = null;
let framed = "";

beforeAll(async () => {
  portal = createServer((_, response) => {
    response.setHeader("Content-Type", "text/html");
    response.end(
      `<!doctype html><title>Portal</title><iframe src="${framed}" width="1200" height="650"></iframe>`,
    );
  });
  await new Promise<void>((listening) => portal.listen(0, "127.0.0.1", listening));
  browser = await Browser.start();
  // As where a browser blocks the storage of frames of other sites.
  await browser.context.addInitScript(() => {
    if (window === window.top) return;
    for (const name of ["localStorage", "sessionStorage"])
      Object.defineProperty(window, name, {
        get() {
          throw new DOMException("Access is denied for this document.", "SecurityError");
        },
      });
  });
});

afterEach(async () => {
  await server?.remove();
  server = null;
});

afterAll(async () => {
  await browser.end();
  portal.close();
});

/** The address of the page that shows the viewer in a frame; its site is not that of the viewer. */
function portalUrl(): string {
  return `http://localhost:${(portal.address() as AddressInfo).port}`;
}

async function openPortal(options: readonly string[]) {
  server = await Server.start(["let Cube = createCube(makePoint3D(0, 0, 0), makePoint3D(2, 2, 2))"], options);
  framed = server.url;
  const page = await browser.open(portalUrl());
  return page.frameLocator("iframe");
}

test("a page of an origin that is given shows the viewer, which works without storage", async () => {
  const frame = await openPortal(["--embed", portalUrl()]);
  await frame.getByTestId("objects").getByText("Cube").click();
  await frame.getByTestId("result-tab").waitFor();
  await frame.getByTestId("result-tab").getByText("Cube").first().waitFor();
  expectNoErrors(browser.errors);
});

test("other pages cannot show it", async () => {
  for (const options of [[], ["--embed", "https://portal.example"]]) {
    const frame = await openPortal(options);
    await expect(frame.getByTestId("objects").waitFor({ timeout: 3000 })).rejects.toThrow();
    await server?.remove();
    server = null;
  }
  expect(browser.errors.filter((error) => error.includes("frame")).length).toBeGreaterThanOrEqual(2);
});
