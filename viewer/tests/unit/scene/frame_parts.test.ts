import type { WebGLRenderer } from "three";
import { afterEach, beforeEach, expect, test, vi } from "vitest";

import { Parts } from "../../../src/scene/frame_parts";
import type { Frame } from "../../../src/scene/stage";

/** A graphics card that needs a time for each triangle. */
class Card {
  private readyAt = 0;
  /** Triangles of each part. */
  readonly parts: number[] = [];
  readonly SYNC_GPU_COMMANDS_COMPLETE = 1;
  readonly SYNC_STATUS = 2;
  readonly SIGNALED = 3;

  constructor(
    private readonly perMillisecond: number,
    private left: number,
  ) {}

  readonly fenceSync = (): object => ({});
  readonly flush = (): void => undefined;
  readonly deleteSync = (): void => undefined;
  readonly isContextLost = (): boolean => false;
  readonly getSyncParameter = (): number => (performance.now() >= this.readyAt ? this.SIGNALED : 0);

  readonly frame: Frame = {
    drawAll: () => undefined,
    drawPart: (triangles) => {
      expect(performance.now()).toBeGreaterThanOrEqual(this.readyAt); // never two parts at once
      const drawn = Math.min(this.left, triangles);
      this.left -= drawn;
      this.parts.push(drawn);
      this.readyAt = performance.now() + drawn / this.perMillisecond;
      return this.left === 0;
    },
    finish: () => undefined,
  };

  get renderer(): WebGLRenderer {
    return { getContext: () => this } as unknown as WebGLRenderer;
  }
}

beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

test("parts become as large as the card carries out in time, one after the other", () => {
  const card = new Card(10_000, 20_000_000);
  const done = vi.fn();
  new Parts(card.renderer, true).draw(card.frame, done);
  vi.advanceTimersByTime(3000);
  expect(done).toHaveBeenCalledOnce();
  const settled = card.parts.slice(5, -1);
  for (const part of settled) {
    expect(part).toBeLessThan(500_000); // 50 milliseconds
    expect(part).toBeGreaterThan(200_000);
  }
});

test("on a slow card they become small", () => {
  const card = new Card(1000, 1_000_000);
  new Parts(card.renderer, true).draw(card.frame, () => undefined);
  vi.advanceTimersByTime(3000);
  expect(Math.max(...card.parts.slice(2))).toBeLessThan(50_000);
});

test("a frame is given up at once", () => {
  const card = new Card(10_000, 20_000_000);
  const done = vi.fn();
  const parts = new Parts(card.renderer, true);
  parts.draw(card.frame, done);
  vi.advanceTimersByTime(100);
  const { length } = card.parts;
  expect(parts.isDrawing).toBe(true);
  parts.giveUp();
  expect(parts.isDrawing).toBe(false);
  vi.advanceTimersByTime(3000);
  expect(card.parts).toHaveLength(length);
  expect(done).not.toHaveBeenCalled();
});
