import { expect, test } from "vitest";
import { usable } from "../../../src/state/page_storage";

test("storage that is refused is replaced for the life of the page", () => {
  const refusals: (() => Storage)[] = [
    () => {
      throw new DOMException("The operation is insecure.", "SecurityError");
    },
    () =>
      ({
        getItem: () => {
          throw new DOMException("The operation is insecure.", "SecurityError");
        },
      }) as unknown as Storage,
    () => null as unknown as Storage,
  ];
  for (const refused of refusals) {
    const storage = usable(refused);
    storage.setItem("a", "1");
    storage.setItem("b", "2");
    expect([storage.getItem("a"), storage.getItem("c"), storage.length, storage.key(1)]).toEqual([
      "1",
      null,
      2,
      "b",
    ]);
    storage.removeItem("a");
    expect(storage.getItem("a")).toBeNull();
    storage.clear();
    expect(storage.length).toBe(0);
  }
});

test("storage that works is used itself", () => {
  const own = usable(() => null as unknown as Storage);
  own.setItem("a", "1");
  expect(usable(() => own)).toBe(own);
});
