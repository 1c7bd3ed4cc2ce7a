import { expect, test } from "vitest";

import type { LinkView } from "../../../src/state/permalink";
import { ViewHistory } from "../../../src/state/view_history";

const view = (active: number): LinkView => ({ version: 1, statements: [], active, editor: "", scene: null });

test("views are gone through back and forth, and a new one forgets those that were undone", () => {
  const history = new ViewHistory();
  expect(history.undo()).toBeNull();
  for (const active of [1, 2, 3]) expect(history.record(view(active))).toBe(true);
  expect(history.record(view(3))).toBe(false);
  expect(history.undo()?.active).toBe(2);
  expect(history.undo()?.active).toBe(1);
  expect([history.canUndo.value, history.canRedo.value]).toEqual([false, true]);
  expect(history.redo()?.active).toBe(2);
  history.amend(view(7));
  expect(history.present?.active).toBe(7);
  expect(history.redo()?.active).toBe(3);
  history.undo();
  history.record(view(9));
  expect(history.canRedo.value).toBe(false);
  expect(history.undo()?.active).toBe(7);
});
