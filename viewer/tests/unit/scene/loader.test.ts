import { describe, expect, it } from "vitest";

import type { LoadProgress, ShapeRequest, ShapeSource } from "../../../src/scene/api";
import { coarseTriangles, Loader, percentage } from "../../../src/scene/loader";
import { SharedMaterials } from "../../../src/scene/materials";
import { ShapeStore } from "../../../src/scene/shape_store";
import { buildGlb } from "./support/glb_builder";
import { sphere } from "./support/solids";

/** Spheres of which row i has `sizes[i]` triangles; coarser ones are made as the server does. */
class TestSource implements ShapeSource {
  readonly result = "r1";
  readonly column = "Solid";
  readonly title = "test";
  readonly attributes = [];
  readonly requests: ShapeRequest[] = [];
  failAt: number | null = null;
  atRequest: (index: number) => unknown = () => undefined;

  constructor(
    readonly sizes: readonly number[],
    private readonly rowsPerAnswer = 3,
  ) {}

  get count(): number {
    return this.sizes.length;
  }

  load(request: ShapeRequest): ReturnType<ShapeSource["load"]> {
    this.requests.push(request);
    this.atRequest(this.requests.length - 1);
    const { from, count, triangles } = request;
    if (this.requests.length - 1 === this.failAt) return Promise.reject(new Error("result r1 was dropped"));
    const rows = Math.min(count, this.rowsPerAnswer, this.sizes.length - from);
    const shapes = Array.from({ length: rows }, (_, i) => {
      const whole = this.sizes[from + i]!;
      // A level has rarely as many triangles as are allowed.
      const shown = triangles === 0 || whole <= triangles ? whole : Math.floor(triangles * 0.97);
      const rings = Math.min(20, Math.max(2, Math.floor(Math.sqrt(shown) / 2)));
      const shape = sphere(from + i, 1, rings, [0, 0, 0], { edges: [] });
      return { ...shape, triangles: whole, shown };
    });
    const next = from + rows < this.sizes.length ? from + rows : null;
    return Promise.resolve({ bytes: buildGlb(shapes), next });
  }

  values(): Promise<never[]> {
    return Promise.resolve([]);
  }
}

async function loaded(
  source: TestSource,
  budget?: number,
  interval = 0,
): Promise<{ store: ShapeStore; events: LoadProgress[]; loader: Loader; finer: number[] }> {
  const store = new ShapeStore(new SharedMaterials());
  const events: LoadProgress[] = [];
  const finer: number[] = [];
  let end: () => void = () => undefined;
  const done = new Promise<void>((resolve) => (end = resolve));
  const loader = new Loader(
    store,
    {
      progress: (progress) => {
        events.push(progress);
        if (progress.phase === "done" || progress.phase === "failed") end();
      },
      changed: (_, came) => {
        if (came === "finer") finer.push(performance.now());
      },
    },
    budget,
    interval,
  );
  loader.start(store.addColumn(source));
  await done;
  return { store, events, loader, finer };
}

/** A loader that has begun with a column. */
function started(source: TestSource, budget?: number, interval = 0) {
  const store = new ShapeStore(new SharedMaterials());
  const events: LoadProgress[] = [];
  const loader = new Loader(
    store,
    { progress: (progress) => events.push(progress), changed: () => undefined },
    budget,
    interval,
  );
  const column = store.addColumn(source);
  loader.start(column);
  return { store, events, loader, column };
}

async function until(isTrue: () => boolean): Promise<void> {
  while (!isTrue()) await new Promise((resolve) => setTimeout(resolve));
}

describe("Loader", () => {
  it("asks for all rows coarse first, then only for those that are finer", async () => {
    const source = new TestSource([8, 3000, 8, 8, 2000, 8, 8]);
    const { store, events } = await loaded(source);
    const coarse = coarseTriangles(7);
    expect(source.requests.slice(0, 3).map(({ from, triangles }) => [from, triangles])).toEqual([
      [0, coarse],
      [3, coarse],
      [6, coarse],
    ]);
    expect(coarse).toBeGreaterThanOrEqual(3000);
    expect(source.requests).toHaveLength(3);
    expect([...store.records()]).toHaveLength(7);
    expect(events.at(-1)).toMatchObject({ phase: "done", rowsLoaded: 7, rows: 7 });
    expect(events[0]).toMatchObject({ phase: "coarse" });
  });

  it("loads values larger than the first picture in full afterwards", async () => {
    const source = new TestSource([60_000]);
    const { store } = await loaded(source);
    expect(source.requests.map(({ triangles }) => triangles)).toEqual([20_000, 0]);
    expect([...store.records()][0]!.levels).toHaveLength(2);
  });

  it("loads very large values by way of a middle level", async () => {
    const source = new TestSource([10_000_000]);
    const { store } = await loaded(source);
    expect(source.requests.map(({ triangles }) => triangles)).toEqual([20_000, 200_000, 0]);
    const [record] = [...store.records()];
    expect(record!.levels.map(({ shape }) => shape.shown)).toEqual([19_400, 10_000_000]);
  });

  it("makes neighbouring rows finer by one request, with few others between them", async () => {
    const source = new TestSource(
      Array.from({ length: 200 }, (_, row) => (row % 10 === 0 ? 8 : 1000)),
      500,
    );
    const { store } = await loaded(source);
    expect(source.requests.map(({ from, count, triangles }) => [from, count, triangles])).toEqual([
      [0, 500, 300],
      [1, 199, 0],
    ]);
    expect([...store.records()].every(({ shown, triangles }) => shown === triangles)).toBe(true);
  });

  it("does not send large rows again that are there", async () => {
    const source = new TestSource([1000, 1000, 300_000, 1000, ...Array<number>(196).fill(8)], 500);
    const { loader } = await loaded(source, 300_000);
    expect(source.requests.slice(1).map(({ from, count }) => [from, count])).toEqual([
      [0, 2],
      [3, 1],
    ]);
    loader.stopAll();
  });

  it("refines the picture no more often than the interval", async () => {
    const source = new TestSource(Array<number>(6).fill(300_000));
    const { finer } = await loaded(source, undefined, 150);
    expect(finer).toHaveLength(6);
    for (let i = 1; i < finer.length; i++) expect(finer[i]! - finer[i - 1]!).toBeGreaterThan(140);
  });

  it("stays coarse beyond the budget, except for what is selected", async () => {
    const source = new TestSource([60_000, 90_000]);
    const { store, loader } = await loaded(source, 30_000);
    expect(source.requests.map(({ triangles }) => triangles)).toEqual([20_000]);
    loader.select([{ result: "r1", row: 1, column: "Solid" }]);
    await new Promise((resolve) => setTimeout(resolve, 50));
    expect(source.requests.map(({ from, triangles }) => [from, triangles]).at(-1)).toEqual([1, 0]);
    const [first, second] = [...store.records()];
    expect(first!.levels).toHaveLength(1);
    expect(second!.levels).toHaveLength(2);
    // Another selection: the first one's memory is freed.
    loader.select([{ result: "r1", row: 0, column: "Solid" }]);
    await new Promise((resolve) => setTimeout(resolve, 50));
    expect(first!.levels).toHaveLength(2);
    expect(second!.levels).toHaveLength(1);
  });

  it("stops in the first picture, keeps what came, and goes on with the next row", async () => {
    const source = new TestSource([8, 8, 8, 8, 8, 8, 8]);
    const { events, store, loader, column } = started(source);
    source.atRequest = (index) => index === 1 && loader.halt(column);
    await until(() => events.at(-1)?.phase === "stopped");
    await new Promise((resolve) => setTimeout(resolve, 30));
    expect([...store.records()]).toHaveLength(3); // the answer that came later is not taken
    expect(events.at(-1)).toMatchObject({ phase: "stopped", rowsLoaded: 3, rows: 7 });
    loader.resume(column);
    await until(() => events.at(-1)?.phase === "done");
    expect([...store.records()]).toHaveLength(7);
    expect(source.requests.map(({ from }) => from)).toEqual([0, 3, 3, 6]);
  });

  it("stops in a refinement, which goes on later", async () => {
    const source = new TestSource([60_000, 60_000]);
    const { events, store, loader, column } = started(source);
    source.atRequest = (index) => index === 1 && loader.halt(column);
    await until(() => events.at(-1)?.phase === "stopped");
    await new Promise((resolve) => setTimeout(resolve, 30));
    const shown = () => [...store.records()].map((record) => record.shown);
    expect(shown()).toEqual([19_400, 19_400]);
    loader.resume(column);
    await until(() => events.at(-1)?.phase === "done");
    expect(shown()).toEqual([60_000, 60_000]);
    expect(source.requests.map(({ triangles }) => triangles)).toEqual([20_000, 0, 0]);
  });

  it("says why it failed, and keeps what came", async () => {
    const source = new TestSource([8, 8, 8, 8]);
    source.failAt = 1;
    const { store, events } = await loaded(source);
    expect(events.at(-1)).toMatchObject({ phase: "failed", text: "result r1 was dropped", rowsLoaded: 3 });
    expect([...store.records()]).toHaveLength(3);
  });
});

describe("progress", () => {
  it("reads the percentage of the server's text", () => {
    expect(percentage("levels of detail, 42 %")).toBe(0.42);
    expect(percentage("waiting")).toBeNull();
  });

  it("shares the triangles of the first picture among the rows", () => {
    expect(coarseTriangles(1)).toBe(20_000);
    expect(coarseTriangles(100)).toBe(600);
    expect(coarseTriangles(1_000_000)).toBe(32);
  });
});
