import { expect, test } from "vitest";
import { keepToken, takeToken } from "../../../src/api/token";
import { uploadName } from "../../../src/api/upload";

function storage(): Pick<Storage, "getItem" | "setItem" | "removeItem"> {
  const items = new Map<string, string>();
  return {
    getItem: (key) => items.get(key) ?? null,
    setItem: (key, value) => void items.set(key, value),
    removeItem: (key) => void items.delete(key),
  };
}

test("the token moves from the address to the storage, and the rest of the fragment stays", () => {
  const kept = storage();
  let hash = "#token=a%2Bb&view=xyz";
  const place = { hash, storage: kept, replaceHash: (next: string) => void (hash = next) };
  expect(takeToken(place)).toBe("a+b");
  expect(hash).toBe("#view=xyz");
  expect(takeToken({ ...place, hash })).toBe("a+b");
});

test("without a token there is none, and an empty one is forgotten", () => {
  const kept = storage();
  const place = { hash: "", storage: kept, replaceHash: () => undefined };
  expect(takeToken(place)).toBe("");
  keepToken("secret", kept);
  expect(takeToken(place)).toBe("secret");
  keepToken("", kept);
  expect(takeToken(place)).toBe("");
});

test.each([
  ["part.stl", "part.stl"],
  ["C:\\parts\\my part.STL", "my part.STL"],
  ["../../etc/passwd", "passwd"],
  [".hidden.obj", "hidden.obj"],
  ["Würfel#1.stl", "W_rfel_1.stl"],
  ["...", "file"],
])("the upload of %s is named %s", (given, expected) => {
  expect(uploadName(given)).toBe(expected);
});
