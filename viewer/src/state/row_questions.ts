/** Statements about the rows of a result, made of the statement that brought them: a person need not write them. */

import type { CellRef } from "../scene/api";
import { isQuery, type Outcome, type Parameters } from "./outcome";

export interface RowQuestion {
  readonly label: string;
  readonly statement: string;
  readonly parameters: Parameters;
  /** The column that it adds, by which the objects are to be coloured. */
  readonly column?: string;
}

/** The relation of a result as an expression; null of a result that is not the rows of a query. */
function relationOf({ statement, table }: Outcome): string | null {
  if (!table?.isRelation || table.rows.count === 0 || !isQuery(statement)) return null;
  const expression = statement
    .replace(/^\s*(#.*\n\s*)*query\b\s*/, "")
    .replace(/[\s;]+$/, "")
    .trim();
  // A comment would hide what is put behind it.
  if (expression.includes("#")) return null;
  return /^\w+$/.test(expression) ? expression : `(${expression})`;
}

/** The name of the parameter for the object that is asked about; the statement may have some of its own. */
const kObject = "object";

/** What else of the rows meets the solid of one of them. */
export function questionsAbout(outcome: Outcome, cell: CellRef): readonly RowQuestion[] {
  const relation = relationOf(outcome);
  const type = outcome.table?.columns.find(({ name }) => name === cell.column)?.type;
  if (relation === null || type !== "volume3d") return [];
  const parameters = { ...outcome.parameters, [kObject]: cell };
  const filtered = (label: string, condition: string) => ({
    label,
    statement: `query ${relation} feed filter[${condition}] consume`,
    parameters,
  });
  return [
    filtered("What touches it", `.${cell.column} touches $${kObject}`),
    filtered("What overlaps it", `.${cell.column} overlaps $${kObject}`),
  ];
}

const kMeasures = [
  { label: "Colour by volume", name: "Volume", operator: "volume" },
  { label: "Colour by area", name: "Area", operator: "area" },
  { label: "Colour by wall thickness", name: "Thickness", operator: "thickness" },
] as const;

/** Measures of all solids of a column, as a further column by which they are coloured. */
export function measuresOf(outcome: Outcome, column: string): readonly RowQuestion[] {
  const relation = relationOf(outcome);
  const columns = outcome.table?.columns ?? [];
  if (relation === null || columns.find(({ name }) => name === column)?.type !== "volume3d") return [];
  return kMeasures.map(({ label, name, operator }) => {
    const free = freeName(
      name,
      columns.map((each) => each.name),
    );
    const statement = `query ${relation} feed extend[${free}: ${operator}(.${column})] sortby[${free}] consume`;
    return { label, statement, parameters: outcome.parameters, column: free };
  });
}

function freeName(name: string, taken: readonly string[]): string {
  if (!taken.includes(name)) return name;
  for (let number = 2; ; number++) if (!taken.includes(`${name}${number}`)) return `${name}${number}`;
}
