import { expect, test } from "vitest";
import { Client } from "../../../src/api/client";
import { Catalogue } from "../../../src/state/catalogue";
import { helpSubject, helpText } from "../../../src/state/help";
import { fakeServer, json } from "../api/fake_server";

const area = {
  name: "area",
  family: "measures",
  syntax: "area(_)",
  doc: "The area of a region.",
  signatures: [],
  changes: false,
};
const box = {
  name: "bbox",
  family: "boxes",
  syntax: "bbox(_)",
  doc: "The bounding box.",
  signatures: [],
  changes: false,
};

async function makeCatalogue() {
  const answers: Record<string, unknown> = {
    "api/objects": [],
    "api/types": [],
    "api/operators": [area, box],
    "api/commands": [
      { syntax: "query EXPRESSION", doc: "Show the value of an expression" },
      { syntax: "let NAME = EXPRESSION", doc: "Make an object" },
      { syntax: "delete type TYPE", doc: "Remove the name of a type" },
    ],
    "api/keywords": ["query", "let"],
    "api/formats": [],
    "api/operators/area": { ...area, help: "area    area(_)\n\n  The whole text." },
  };
  const { fetch } = fakeServer(({ url }) => json(answers[url]));
  const catalogue = new Catalogue(new Client({ fetch }));
  await catalogue.load();
  return catalogue;
}

test("help is told from other commands", () => {
  expect(helpSubject("help")).toBe("");
  expect(helpSubject(" help area; ")).toBe("area");
  expect(helpSubject("help +")).toBe("+");
  for (const other of ["query help", "helpless", "let help = 1"]) expect(helpSubject(other)).toBeNull();
});

test("a name gives the server's text, a word what has it, nothing the whole list", async () => {
  const catalogue = await makeCatalogue();
  expect(await helpText("area", catalogue)).toBe("area    area(_)\n\n  The whole text.");
  const found = await helpText("BOUNDING", catalogue);
  expect(found).toContain("bbox(_)");
  expect(found).not.toContain("area(_)");
  const all = await helpText("", catalogue);
  for (const part of ["let NAME", "query EXPRESSION", "Operators: measures", "area(_)", "bbox(_)"])
    expect(all).toContain(part);
  expect(await helpText("query", catalogue)).toMatch(/^ *query EXPRESSION +Show the value of an expression$/);
  const expression = await helpText("expression", catalogue);
  expect(expression).toMatch(/^Commands with “expression”\n +query EXPRESSION .*\n +let NAME = EXPRESSION/);
  await expect(helpText("xyzzy", catalogue)).rejects.toThrow("no operator or command has xyzzy in its name");
});
