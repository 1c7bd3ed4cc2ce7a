import type { Column, Row } from "../../api/types";
import type { Outcome } from "../../state/outcome";
import { useApp } from "../context";
import { IconButton } from "../ui/controls";
import { openMenu } from "../ui/menu";
import { CellContent } from "./CellContent";
import { cellMenu } from "./cell_menu";
import { canOpen, viewOf } from "./format";
import { OpenedCell } from "./OpenedCell";

/** The opened column of each opened row. */
export type OpenedColumns = ReadonlyMap<number, string>;

interface Props {
  readonly outcome: Outcome;
  readonly columns: readonly Column[];
  readonly row: number;
  /** null while it is being read. */
  readonly value: Row | null;
  readonly selected: boolean;
  readonly opened: string | null;
  /** Of columns whose texts lie in one folder. */
  readonly folders: ReadonlyMap<string, string>;
  readonly top: number;
  readonly template: string;
  readonly onSelect: (row: number, column: string | null) => void;
  readonly onToggle: (row: number, column: string) => void;
  readonly onOpen: (row: number, column: string) => void;
}

export function TableRow(props: Props) {
  const { outcome, columns, row, value, selected, opened, top, template } = props;
  const openedColumn = columns.find(({ name }) => name === opened);
  return (
    <div class="table-row-place" style={{ transform: `translateY(${top}px)` }}>
      <div
        class="table-row"
        role="row"
        aria-rowindex={row + 2}
        aria-selected={selected}
        data-row={row}
        style={{ gridTemplateColumns: template }}
      >
        <div class="row-number" role="rowheader" onClick={() => props.onSelect(row, null)}>
          {(row + 1).toLocaleString("en")}
        </div>
        {columns.map((column) => (
          <Cell key={column.name} {...props} column={column} />
        ))}
      </div>
      {openedColumn && value && (
        <OpenedCell
          result={outcome.resultId}
          row={row}
          column={openedColumn}
          value={value[openedColumn.name] ?? null}
          onClose={() => props.onToggle(row, openedColumn.name)}
        />
      )}
    </div>
  );
}

function Cell({
  outcome,
  row,
  value,
  column,
  opened,
  folders,
  onSelect,
  onToggle,
  onOpen,
}: Props & { column: Column }) {
  const app = useApp();
  if (!value) return <div class="cell loading" role="gridcell" />;
  const view = viewOf(value[column.name] ?? null, column.type);
  const isOpened = opened === column.name;
  const hasMenu = view.kind === "geometry" && outcome.resultId !== null;
  return (
    <div
      class={`cell ${view.kind}`}
      role="gridcell"
      data-column={column.name}
      onClick={() => onSelect(row, column.shape ? column.name : null)}
      onDblClick={() => {
        // The browser has selected a word.
        getSelection()?.removeAllRanges();
        onOpen(row, column.name);
      }}
    >
      {canOpen(view) && (
        <IconButton
          small
          icon={isOpened ? "chevronDown" : "chevronRight"}
          label={`${isOpened ? "Close" : "Open"} ${column.name}`}
          onClick={(event) => {
            event.stopPropagation();
            onToggle(row, column.name);
          }}
        />
      )}
      <CellContent view={view} folder={folders.get(column.name) ?? ""} />
      {hasMenu && (
        <IconButton
          small
          icon="more"
          label={`Actions for ${column.name}`}
          onClick={(event) => {
            event.stopPropagation();
            openMenu(event.currentTarget as HTMLElement, cellMenu(app, outcome, row, column.name));
          }}
        />
      )}
    </div>
  );
}
