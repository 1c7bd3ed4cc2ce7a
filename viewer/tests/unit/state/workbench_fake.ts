import type { QueryAnswer } from "../../../src/api/types";
import type { Store } from "../../../src/state/store";
import { Workbench } from "../../../src/state/workbench";

/** A workbench whose server answers each statement with a cube of its own, and the statements that came. */
export function workbench(): { bench: Workbench; asked: { statement: string; parameters: unknown }[] } {
  const asked: { statement: string; parameters: unknown }[] = [];
  let count = 0;
  const answer = (): QueryAnswer => ({
    type: "volume3d",
    value: { type: "volume3d", triangles: 12 },
    diagnostics: [],
    seconds: 0,
    result: {
      id: `r${++count}`,
      count: 1,
      columns: [{ name: "value", type: "volume3d", shape: true }],
    },
  });
  const client = {
    query: () => Promise.reject(new Error("no statistics here")),
    rows: () => Promise.resolve({ rows: [] }),
    drop: () => Promise.resolve(),
  };
  const runner = {
    answer: (statement: string, parameters: unknown) => {
      asked.push({ statement, parameters });
      return Promise.resolve(answer());
    },
  };
  const store = { client, runner } as unknown as Store;
  return { bench: new Workbench(store), asked };
}
