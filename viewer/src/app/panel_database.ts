import type { Database } from "../scene/api";
import { questionsAbout } from "../state/row_questions";
import { readBytes } from "../state/shape_source";
import type { App } from "./context";

/** The database as the panels of the scene use it. */
export function panelDatabase({ store, workspace }: App): Database {
  const { catalogue, client, results, runner } = store;
  return {
    async query(statement, parameters, signal) {
      const answer = await runner.answer(statement, parameters, signal);
      return { ...answer, result: answer.result ?? null };
    },
    async shapes({ result, row, column }, triangles, signal) {
      const query = { column, from: row, count: 1, triangles };
      return readBytes(await client.shapes(result, query, signal));
    },
    async rows(result, from, count, signal) {
      return (await client.rows(result, from, count, signal)).rows;
    },
    indexes: () =>
      catalogue.objects.value
        .filter(({ kind, type }) => kind === "index" && type.startsWith("(rtree"))
        .map(({ name, indexOf }) => ({ name, relation: indexOf ?? null })),
    questions(cell) {
      const outcome = results.ofResult(cell.result);
      if (!outcome) return [];
      return questionsAbout(outcome, cell).map((question) => ({
        label: question.label,
        ask: () => void workspace.ask(question),
      }));
    },
    drop: (result) => void client.drop(result).catch(() => undefined),
    show(statement, parameters) {
      // What a panel shows belongs to what is seen already.
      const before = results.overlay.value;
      results.overlay.value = true;
      void store.run(statement, { parameters }).finally(() => (results.overlay.value = before));
    },
  };
}
