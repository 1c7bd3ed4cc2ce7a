import { expect, test } from "vitest";

import { dual } from "../../../src/state/workbench_operations";
import { workbench } from "./workbench_fake";

test("undos and redos that come while one is running are done after it", async () => {
  const { left } = workbench().bench;
  await left.loadObject("Cube");
  await left.apply(dual, null, 3);
  const labels = () => left.steps.value.map(({ label }) => label).join(" ");
  expect(labels()).toBe("Cube dual dual dual");
  await Promise.all([left.travel(-1), left.travel(-1), left.travel(-1)]);
  expect(labels()).toBe("Cube");
  expect(left.undone.value.length).toBe(3);
  await Promise.all([left.travel(1), left.travel(1), left.travel(-1)]);
  expect(labels()).toBe("Cube dual");
  await Promise.all([left.travel(1), left.travel(1), left.travel(1)]);
  expect(labels()).toBe("Cube dual dual dual");
});

test("a state of the list is shown, and those after it can be shown again until another one is made", async () => {
  const { left } = workbench().bench;
  await left.loadObject("Cube");
  await left.apply(dual, null, 3);
  const [first, second] = left.steps.value;
  await left.show(second!);
  expect(left.step.value).toBe(second);
  expect(left.undone.value.map(({ label }) => label)).toEqual(["dual", "dual"]);
  await left.show(left.undone.value[1]!);
  expect(left.steps.value.length).toBe(4);
  await left.show(first!);
  await left.apply(dual);
  expect(left.undone.value).toEqual([]);
  expect(left.steps.value.map(({ label }) => label)).toEqual(["Cube", "dual"]);
});
