import { PlainText } from "../ui/PlainText";
import type { CellView } from "./format";

/** One line of a cell. */
export function CellContent({ view }: { view: CellView }) {
  switch (view.kind) {
    case "undefined":
      return <span class="undefined">undefined</span>;
    case "geometry":
      return (
        <span class="geometry ellipsis" title={view.box ? `${view.type}, box ${view.box}` : view.type}>
          <span class="geometry-type">{view.type}</span>
          {view.count && `, ${view.count}`}
        </span>
      );
    case "relation":
      return <span class="tag">{view.rows.length === 1 ? "1 row" : `${view.rows.length} rows`}</span>;
    default:
      return (
        <span class="ellipsis" title={view.text.length > 30 ? view.text.slice(0, 500) : undefined}>
          <PlainText text={view.text} />
        </span>
      );
  }
}
