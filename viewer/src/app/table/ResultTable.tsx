import { useEffect, useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import type { Outcome, Table } from "../../state/outcome";
import { useApp } from "../context";
import { ColumnHead } from "./ColumnHead";
import { columnWidths, commonFolders, fittedWidths } from "./format";
import { RowLayout } from "./row_layout";
import { TableRow, type OpenedColumns } from "./TableRow";

/** As `--row`: fingers need more room. */
const rowHeight = matchMedia("(pointer: coarse)").matches ? 40 : 28;
const headHeight = 40;
const openedHeight = 220;
const numberWidth = 64;
/** Rows drawn above and below the window. */
const margin = 6;

/** The rows of an outcome; only those in the window are drawn. */
export function ResultTable({ outcome, table }: { outcome: Outcome; table: Table }) {
  const { store, workspace } = useApp();
  const scroller = useRef<HTMLDivElement>(null);
  const [scroll, setScroll] = useState(0);
  const [height, setHeight] = useState(300);
  const [lastOpened, setLastOpened] = useState<number | null>(null);
  const [opened, setOpened] = useState<OpenedColumns>(new Map());
  const [widths, setWidths] = useState<readonly number[]>(() =>
    columnWidths(table.columns, firstRows(table)),
  );
  const folders = useMemo(() => commonFolders(table.columns, firstRows(table)), [table]);
  const layout = useMemo(
    () =>
      new RowLayout(
        table.rows.count,
        rowHeight,
        new Map([...opened.keys()].map((row) => [row, openedHeight])),
      ),
    [table, opened],
  );
  // Drawn again when rows arrive.
  void table.rows.changed.value;
  const problem = table.rows.problem.value;
  const selected = store.results.selected.value;
  const selectedRow = selected?.result === outcome.resultId ? selected.row : null;

  useLayoutEffect(() => {
    const element = scroller.current;
    if (!element) return;
    setWidths((wanted) => fittedWidths(wanted, table.columns, element.clientWidth - numberWidth));
    const observer = new ResizeObserver(() => setHeight(element.clientHeight));
    observer.observe(element);
    return () => observer.disconnect();
  }, []);

  /** Scrolls a row into the window, with its opened part if there is room for both. */
  const reveal = (row: number, part = opened.has(row) ? openedHeight : 0) => {
    const element = scroller.current;
    if (!element) return;
    const room = element.clientHeight - headHeight;
    const top = layout.topOf(row);
    const bottom = top + Math.min(room, rowHeight + part);
    const offset = layout.offsetOfScroll(element.scrollTop, element.clientHeight);
    if (top >= offset && bottom <= offset + room) return;
    const wanted = part > 0 ? bottom - room : top - room / 2;
    element.scrollTop = layout.scrollOfOffset(Math.max(0, wanted), element.clientHeight);
  };
  useEffect(() => {
    if (selectedRow !== null) reveal(selectedRow);
  }, [selectedRow, layout]);

  const select = (row: number, column: string | null) => {
    if (outcome.resultId !== null) store.results.selected.value = { result: outcome.resultId, row, column };
  };
  const toggle = (row: number, column: string) => {
    const next = new Map(opened);
    if (next.get(row) === column) next.delete(row);
    else next.set(row, column);
    setOpened(next);
    setLastOpened(next.has(row) ? row : null);
  };
  useEffect(() => {
    if (lastOpened !== null) reveal(lastOpened, openedHeight);
  }, [lastOpened, opened]);
  const onKeyDown = (event: KeyboardEvent) => {
    const target = nextRow(event.key, selectedRow, table.rows.count, Math.floor(height / rowHeight) - 2);
    if (target !== null) {
      select(target, null);
      event.preventDefault();
    } else if (event.key === "Enter" && selectedRow !== null && event.target === scroller.current) {
      openProperties(selectedRow);
    }
  };
  const openProperties = (row: number, column?: string) => {
    const shape =
      column !== undefined && outcome.shapeColumns.includes(column) ? column : outcome.shapeColumns[0];
    if (outcome.resultId !== null && shape !== undefined)
      workspace.openProperties({ result: outcome.resultId, row, column: shape });
  };

  const offset = layout.offsetOfScroll(scroll, height);
  const first = Math.max(0, layout.rowAt(offset) - margin);
  const last = Math.min(table.rows.count, layout.rowAt(offset + height) + margin + 1);
  const template = `${numberWidth}px ${widths.map((width) => `${width}px`).join(" ")}`;
  const width = numberWidth + widths.reduce((sum, each) => sum + each, 0);
  const indices = Array.from({ length: Math.max(0, last - first) }, (_, index) => first + index);
  return (
    <div
      ref={scroller}
      class="table"
      role="grid"
      aria-label={`Rows of ${outcome.statement}`}
      aria-rowcount={table.rows.count + 1}
      tabIndex={0}
      data-testid="table"
      onScroll={(event) => setScroll(event.currentTarget.scrollTop)}
      onKeyDown={onKeyDown}
    >
      <div
        class="table-head"
        role="row"
        aria-rowindex={1}
        style={{ gridTemplateColumns: template, width: `${width}px` }}
      >
        <div class="table-corner" role="columnheader" aria-label="Row" />
        {table.columns.map((column, index) => (
          <ColumnHead
            key={column.name}
            outcome={outcome}
            column={column}
            onResize={(to) => setWidths(widths.map((old, at) => (at === index ? Math.max(56, to) : old)))}
            width={widths[index] ?? 120}
          />
        ))}
      </div>
      <div class="table-rows" style={{ height: `${layout.scrollHeight}px`, width: `${width}px` }}>
        {indices.map((row) => (
          <TableRow
            key={row}
            outcome={outcome}
            columns={table.columns}
            row={row}
            value={table.rows.row(row)}
            selected={row === selectedRow}
            opened={opened.get(row) ?? null}
            folders={folders}
            top={scroll + layout.topOf(row) - offset}
            template={template}
            onSelect={select}
            onToggle={toggle}
            onOpen={openProperties}
          />
        ))}
      </div>
      {table.rows.count === 0 && <p class="empty">No rows.</p>}
      {problem && <RowsProblem outcome={outcome} table={table} />}
    </div>
  );
}

function firstRows(table: Table) {
  return Array.from({ length: Math.min(40, table.rows.count) }, (_, row) => table.rows.row(row));
}

/** The row that a key leads to; null for other keys. */
function nextRow(key: string, row: number | null, count: number, page: number): number | null {
  const steps: Record<string, number> = { ArrowDown: 1, ArrowUp: -1, PageDown: page, PageUp: -page };
  const step = steps[key];
  if (count === 0) return null;
  if (key === "Home") return 0;
  if (key === "End") return count - 1;
  if (step === undefined) return null;
  return row === null ? 0 : Math.min(count - 1, Math.max(0, row + step));
}

function RowsProblem({ outcome, table }: { outcome: Outcome; table: Table }) {
  const { store } = useApp();
  const problem = table.rows.problem.value;
  if (!problem) return null;
  return (
    <div class="table-problem callout error" role="alert">
      <span class="grow">
        {problem.gone
          ? "The server no longer has this result."
          : `The rows cannot be read. ${problem.message}`}
      </span>
      {problem.gone ? (
        <button type="button" class="btn" onClick={() => void store.run(outcome.statement)}>
          Run again
        </button>
      ) : (
        <button type="button" class="btn" onClick={() => table.rows.retry()}>
          Try again
        </button>
      )}
    </div>
  );
}
