import type { CellRef } from "../../scene/api";
import { downloadsOf } from "../../state/mesh_formats";
import { questionsAbout } from "../../state/row_questions";
import type { Outcome } from "../../state/outcome";
import type { App } from "../context";
import { saveBlob } from "../ui/save";
import type { MenuItem } from "../ui/menu";

/** What can be done with the geometry in a cell. */
export function cellMenu(
  { store, workspace }: App,
  outcome: Outcome,
  row: number,
  column: string,
): MenuItem[] {
  const { resultId } = outcome;
  if (resultId === null) return [];
  const cell: CellRef = { result: resultId, row, column };
  const type = outcome.table?.columns.find(({ name }) => name === column)?.type ?? "";
  const isMesh = ["volume3d", "surface3d", "mesh3d"].includes(type);
  const items: MenuItem[] = [
    { label: "Colour and size…", run: () => workspace.openProperties(cell) },
    { label: "Show alone", run: () => void store.run("query $a", { parameters: { a: cell } }) },
    { label: "Store as object…", run: () => workspace.askName(cell) },
  ];
  if (!isMesh) return items;
  return [
    ...questionsAbout(outcome, cell).map((question) => ({
      label: question.label,
      run: () => void workspace.ask(question),
    })),
    ...items,
    { label: "Compare: to the left", run: () => workspace.compare("left", cell) },
    { label: "Compare: to the right", run: () => workspace.compare("right", cell) },
    ...downloadsOf(store.catalogue.formats.value).map(({ form, label, ending }) => ({
      label: `Download as ${label}`,
      run: () => void download(store, cell, form.format, `${fileName(outcome, row)}${ending}`),
    })),
  ];
}

/** The first text of the row, such as its name, else the column and the row. */
function fileName(outcome: Outcome, row: number): string {
  const values = Object.values(outcome.table?.rows.row(row) ?? {});
  const text = values.find((value) => typeof value === "string");
  const name = typeof text === "string" ? text : `row ${row + 1}`;
  return name.replace(/[^\p{L}\p{N}._ -]/gu, "_").slice(0, 80) || "shape";
}

async function download(store: App["store"], cell: CellRef, format: string, name: string): Promise<void> {
  try {
    const { blob, diagnostics } = await store.client.file(cell.result, cell.row, cell.column, format);
    saveBlob(blob, name);
    store.notices.add("success", `${name} is downloaded.`, { detail: diagnostics.join("\n") });
  } catch (error) {
    store.report(error, `${name} cannot be written`);
  }
}
