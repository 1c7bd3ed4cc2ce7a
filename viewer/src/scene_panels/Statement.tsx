import type { Database, Question } from "../scene";

/** The query that gives a number, and a button that runs it in the editor's place. */
export function Statement({ question, database }: { question: Question; database: Database }) {
  return (
    <div class="statement">
      <code title={describe(question)}>{question.statement}</code>
      <button
        type="button"
        class="btn quiet small"
        title="Run this query as a result of its own"
        onClick={() => database.show(question.statement, question.parameters)}
      >
        Run
      </button>
    </div>
  );
}

/** What the parameters of a statement are. */
function describe({ parameters }: Question): string {
  return Object.entries(parameters)
    .map(([name, value]) =>
      "result" in value
        ? `$${name}: row ${value.row + 1} of ${value.column} in ${value.result}`
        : `$${name} = ${value.value}`,
    )
    .join("\n");
}
