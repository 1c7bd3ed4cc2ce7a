import { useEffect, useState } from "preact/hooks";
import { messageOf } from "../../api/errors";
import type { Column, Json, Row } from "../../api/types";
import { attributesOf } from "../../state/types";
import { useApp } from "../context";
import { IconButton } from "../ui/controls";
import { PlainText } from "../ui/PlainText";
import { CellContent } from "./CellContent";
import { listText, viewOf } from "./format";

/** Characters of a cell that are shown; browsers become slow with more. */
const shownCharacters = 100_000;

interface Props {
  /** null: there is nothing more than `value`. */
  readonly result: string | null;
  readonly row: number;
  readonly column: Column;
  readonly value: Json;
  readonly onClose: () => void;
}

/** The whole value of a cell, below its row. */
export function OpenedCell({ result, row, column, value, onClose }: Props) {
  const view = viewOf(value, column.type);
  return (
    <div class="opened-cell">
      <div class="opened-head">
        <strong>{column.name}</strong>
        <span class="muted ellipsis grow">{column.type}</span>
        <IconButton small icon="close" label={`Close ${column.name}`} onClick={onClose} />
      </div>
      {view.kind === "relation" ? (
        <NestedTable type={column.type} rows={view.rows} />
      ) : (
        <WholeText result={result} row={row} column={column.name} value={value} />
      )}
    </div>
  );
}

function WholeText({
  result,
  row,
  column,
  value,
}: Pick<Props, "result" | "row" | "value"> & { column: string }) {
  const { store } = useApp();
  const plain = result === null || typeof value === "string";
  const [text, setText] = useState<string | null>(plain ? listText(value) : null);
  const [problem, setProblem] = useState("");
  useEffect(() => {
    if (plain) return;
    const abort = new AbortController();
    store.client.cell(result, row, column, abort.signal).then(
      (cell) => setText(cell.text),
      (error: unknown) => !abort.signal.aborted && setProblem(messageOf(error)),
    );
    return () => abort.abort();
  }, [result, row, column]);
  if (problem) return <p class="error-text">{problem}</p>;
  if (text === null) return <p class="muted">Reading…</p>;
  const more = text.length - shownCharacters;
  return (
    <pre tabIndex={0}>
      <PlainText text={text.slice(0, shownCharacters)} lines />
      {more > 0 && <span class="muted">{` … and ${more.toLocaleString("en")} characters more`}</span>}
    </pre>
  );
}

/** A relation in a cell. */
export function NestedTable({ type, rows }: { type: string; rows: readonly Row[] }) {
  const names = attributesOf(type) ?? Object.keys(rows[0] ?? {}).map((name) => ({ name, type: "" }));
  return (
    <table class="nested-table">
      <thead>
        <tr>
          {names.map(({ name }) => (
            <th key={name} scope="col">
              {name}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {rows.map((row, index) => (
          <tr key={index}>
            {names.map(({ name, type: of }) => (
              <td key={name}>
                <NestedCell value={row[name] ?? null} type={of} />
              </td>
            ))}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** A cell of a nested table; a relation in it opens in place, again. */
function NestedCell({ value, type }: { value: Json; type: string }) {
  const view = viewOf(value, type);
  if (view.kind !== "relation") return <CellContent view={view} />;
  return (
    <details>
      <summary>
        <CellContent view={view} />
      </summary>
      <NestedTable type={type} rows={view.rows} />
    </details>
  );
}
