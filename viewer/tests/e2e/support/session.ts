/** A server, a browser and a page for all tests of a file; each test begins with the page as if it were opened anew. */

import { afterAll, afterEach, beforeAll, beforeEach } from "vitest";
import type { Page } from "playwright-core";

import { expectNoErrors, ready, run, stillScene } from "./actions";
import { Browser, type BrowserOptions } from "./browser";
import { frontView, plainScene } from "./scene";
import { Server } from "./server";

export interface SessionOptions {
  /** Run before the first test. */
  readonly statements: readonly string[];
  readonly browser?: BrowserOptions;
  /** Runs in each page before its own scripts. */
  readonly initScript?: () => void;
}

export class Session {
  page!: Page;
  browser!: Browser;
  server!: Server;

  constructor({ statements, browser, initScript }: SessionOptions) {
    beforeAll(async () => {
      this.server = await Server.start(statements);
      this.browser = await Browser.start({ theme: "light", width: 1280, height: 900, ...browser });
      if (initScript) await this.browser.context.addInitScript(initScript);
    });
    afterAll(async () => {
      await this.browser.end();
      await this.server.remove();
    });
    beforeEach(() => this.open());
    afterEach(() => expectNoErrors(this.browser.errors));
  }

  private async open(): Promise<void> {
    await this.browser.forget(this.server.url);
    // Without animations a picture that stands still is the final one, also on a slow machine.
    this.page = await this.browser.open(this.server.url, { reducedMotion: "reduce" });
    await ready(this.page);
    this.browser.errors.length = 0;
  }

  /** Runs a statement, and shows its result on white from the front. */
  async show(statement: string): Promise<void> {
    await run(this.page, statement);
    await stillScene(this.page);
    await plainScene(this.page);
    await frontView(this.page);
  }
}
