import type { Column } from "../../api/types";
import type { Outcome } from "../../state/outcome";
import { measuresOf } from "../../state/row_questions";
import { isColourable } from "../../state/shape_source";
import { useApp } from "../context";
import { IconButton } from "../ui/controls";
import { draggable } from "../ui/drag";
import { openMenu } from "../ui/menu";

interface Props {
  readonly outcome: Outcome;
  readonly column: Column;
  readonly width: number;
  readonly onResize: (width: number) => void;
}

/** Name and type of a column; shapes can be hidden, and objects coloured by other values. */
export function ColumnHead({ outcome, column, width, onResize }: Props) {
  const { store, workspace } = useApp();
  const measures = measuresOf(outcome, column.name);
  const shown = outcome.shown.value.has(column.name);
  return (
    <div class="column-head" role="columnheader" title={`${column.name}: ${column.type}`}>
      <span class="column-name ellipsis">{column.name}</span>
      <span class="column-type ellipsis">{column.type}</span>
      <span class="column-actions">
        {measures.length > 0 && (
          <IconButton
            small
            icon="palette"
            label={`Colour by a measure of ${column.name}`}
            onClick={(event) =>
              openMenu(
                event.currentTarget as HTMLElement,
                measures.map((question) => ({
                  label: question.label,
                  run: () => void workspace.ask(question),
                })),
              )
            }
          />
        )}
        {column.shape && (
          <IconButton
            small
            icon={shown ? "eye" : "eyeOff"}
            pressed={shown}
            label={`Show ${column.name} in 3D`}
            onClick={() => store.results.show(outcome, !shown, column.name)}
          />
        )}
        {outcome.shapeColumns.length > 0 && isColourable(column.type) && (
          <IconButton
            small
            icon="palette"
            label={`Colour the objects by ${column.name}`}
            onClick={() => workspace.colourBy(column.name)}
          />
        )}
      </span>
      <div
        class="column-grip"
        {...draggable(
          () => width,
          (start, dx) => onResize(start + dx),
        )}
      />
    </div>
  );
}
