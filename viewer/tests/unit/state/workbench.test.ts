import { expect, test } from "vitest";

import { dual } from "../../../src/state/workbench_operations";
import { workbench } from "./workbench_fake";

test("undos and redos that come while one is running are done after it", async () => {
  const { left } = workbench().bench;
  await left.loadObject("Cube");
  await left.apply(dual, null, 3);
  const labels = () => left.steps.value.map(({ label }) => label).join(" ");
  expect(labels()).toBe("Cube dual dual dual");
  await Promise.all([left.undo(), left.undo(), left.undo()]);
  expect(labels()).toBe("Cube");
  expect(left.canUndo.value).toBe(false);
  await Promise.all([left.redo(), left.redo(), left.undo()]);
  expect(labels()).toBe("Cube dual");
  await Promise.all([left.redo(), left.redo(), left.redo()]);
  expect(labels()).toBe("Cube dual dual dual");
});
