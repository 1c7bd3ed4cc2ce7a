import { expect, test } from "vitest";
import { searchOperators } from "../../../src/state/catalogue";
import { History } from "../../../src/state/history";

function storage() {
  const items = new Map<string, string>();
  return {
    getItem: (key: string) => items.get(key) ?? null,
    setItem: (key: string, value: string) => void items.set(key, value),
  };
}

test("each statement once, the latest first, kept for the next visit", () => {
  const place = storage();
  const history = new History(place);
  history.add("query A", true, 1);
  history.add("query B", false, 2);
  history.add(" query A ", true, 3);
  const expected = [
    { text: "query A", ok: true, time: 3 },
    { text: "query B", ok: false, time: 2 },
  ];
  expect(history.entries.value).toEqual(expected);
  expect(new History(place).entries.value).toEqual(expected);
  expect([history.knows("query A"), history.knows("query B")]).toEqual([true, false]);
});

test("a search finds entries with all words", () => {
  const history = new History(storage());
  history.add("query Parts feed count", true);
  history.add("query Plate", true);
  expect(history.search("COUNT parts").map(({ text }) => text)).toEqual(["query Parts feed count"]);
});

test("a damaged storage is an empty history", () => {
  const place = storage();
  place.setItem("algebra3d.history", "{broken");
  expect(new History(place).entries.value).toEqual([]);
});

test("operators whose name begins with the pattern come first", () => {
  const operator = (name: string, doc: string) => ({
    name,
    doc,
    family: "measures",
    syntax: "",
    signatures: [],
    changes: false,
  });
  const operators = [
    operator("mesh2volume", "A solid."),
    operator("area", "The area; see volume."),
    operator("volumeExact", "Exact."),
    operator("volume", "Enclosed volume."),
  ];
  expect(searchOperators(operators, "volume").map(({ name }) => name)).toEqual([
    "volume",
    "volumeExact",
    "mesh2volume",
    "area",
  ]);
  expect(searchOperators(operators, "see area")).toEqual([operators[1]]);
});
