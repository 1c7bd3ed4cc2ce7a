import { PlainText } from "../ui/PlainText";
import type { CellView } from "./format";

/** One line of a cell. */
export function CellContent({ view, folder = "" }: { view: CellView; folder?: string }) {
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
    default: {
      const isInside = folder !== "" && view.text.startsWith(folder);
      return (
        <span
          class="ellipsis"
          title={isInside || view.text.length > 30 ? view.text.slice(0, 500) : undefined}
        >
          {isInside && <span class="muted">…/</span>}
          <PlainText text={isInside ? view.text.slice(folder.length) : view.text} />
        </span>
      );
    }
  }
}
