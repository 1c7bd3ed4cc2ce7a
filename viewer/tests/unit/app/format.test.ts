import { expect, test } from "vitest";
import {
  boxText,
  bytesText,
  canOpen,
  columnWidths,
  commonFolders,
  fittedWidths,
  listText,
  seconds,
  viewOf,
} from "../../../src/app/table/format";
import { nameProblem } from "../../../src/app/ui/name_form";

test("values by their kind", () => {
  expect(viewOf(null, "real")).toEqual({ kind: "undefined" });
  expect(viewOf(1.5, "real")).toEqual({ kind: "number", text: "1.5" });
  expect(viewOf(true, "bool")).toEqual({ kind: "text", text: "TRUE" });
  expect(viewOf([1, [2.5, null]], "(vector)")).toEqual({ kind: "text", text: "(1 (2.5 undefined))" });
  expect(viewOf({ type: "volume3d", triangles: 320, box: [0, 4, 0, 4, 0, 12] }, "volume3d")).toEqual({
    kind: "geometry",
    type: "volume3d",
    count: "320 triangles",
    box: "(0 4) (0 4) (0 12)",
  });
  const nested = viewOf([{ A: 1 }], "(rel (tuple ((A int))))");
  expect(nested).toEqual({ kind: "relation", rows: [{ A: 1 }] });
  expect(canOpen(nested)).toBe(true);
});

test("only what has more than its line opens", () => {
  expect(canOpen(viewOf("short", "string"))).toBe(false);
  expect(canOpen(viewOf("x".repeat(31), "string"))).toBe(true);
  expect(canOpen(viewOf("two\nlines", "text"))).toBe(true);
  expect(canOpen(viewOf(12345, "int"))).toBe(false);
});

test("texts of lists, boxes, times and sizes", () => {
  expect(listText([1, "a", false])).toBe("(1 a FALSE)");
  expect(boxText([0, 1 / 3])).toBe("(0 0.333333)");
  expect([seconds(0.0001), seconds(0.0123), seconds(1.234), seconds(250.4)]).toEqual([
    "< 1 ms",
    "12 ms",
    "1.23 s",
    "250 s",
  ]);
  expect([bytesText(684), bytesText(1500), bytesText(2_500_000_000)]).toEqual([
    "684 bytes",
    "1.50 kB",
    "2.50 GB",
  ]);
});

test("wide texts make wide columns, within limits", () => {
  const columns = [
    { name: "N", type: "int", shape: false },
    { name: "T", type: "text", shape: false },
  ];
  const [n, t] = columnWidths(columns, [{ N: 1, T: "x".repeat(500) }]);
  expect(n).toBe(84);
  expect(t).toBe(420);
});

test("columns of texts give way so that all are seen, and take the room that there is", () => {
  const columns = [
    { name: "File", type: "text", shape: false },
    { name: "Solid", type: "volume3d", shape: true },
  ];
  expect(fittedWidths([420, 230], columns, 500)).toEqual([270, 230]);
  expect(fittedWidths([420, 230], columns, 200)).toEqual([120, 230]);
  expect(fittedWidths([420, 230], columns, 900)).toEqual([670, 230]);
  expect(fittedWidths([230], [columns[1]!], 900)).toEqual([230]);
});

test("wide columns of an inquiry, which have no type, give way to its numbers", () => {
  const columns = ["Signature", "Milliseconds"].map((name) => ({ name, type: "", shape: false }));
  expect(fittedWidths([420, 110], columns, 400)).toEqual([290, 110]);
});

test("the folder in which all files lie is left out", () => {
  const columns = [{ name: "File", type: "text", shape: false }];
  const rows = ["parts/bolts/long/a.stl", "parts/bolts/long/b.stl"].map((File) => ({ File }));
  expect(commonFolders(columns, rows).get("File")).toBe("parts/bolts/long/");
  expect(commonFolders(columns, [...rows, { File: "other/c.stl" }]).size).toBe(0);
  expect(commonFolders(columns, rows.slice(0, 1)).size).toBe(0);
});

test("names of objects are checked before they are sent", () => {
  expect(nameProblem("Part_2", [])).toBe("");
  expect(nameProblem("2nd", [])).toContain("A name is a letter");
  expect(nameProblem("Part", ["Part"])).toBe("There is an object Part already.");
});
