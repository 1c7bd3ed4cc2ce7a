import { useEffect, useRef, useState } from "preact/hooks";
import { titleOf, type Outcome } from "../../state/outcome";
import { useApp } from "../context";
import { ResultTable } from "../table/ResultTable";
import { seconds } from "../table/format";
import { IconButton } from "../ui/controls";
import { Icon } from "../ui/Icon";
import { PlainText } from "../ui/PlainText";

/** The results that are kept, and the table of one of them. */
export function ResultsPanel() {
  const { store } = useApp();
  const { results } = store;
  const outcome = results.active.value;
  // The outcome whose notes were folded, or unfolded.
  const [folded, setFolded] = useState<Outcome | null>(null);
  const hasNotes = outcome !== null && outcome.answer.diagnostics.length > 0;
  const open = hasNotes && folded !== outcome;
  return (
    <section class="panel results-panel" aria-label="Results">
      <div class="panel-head results-head">
        <div class="result-tabs" role="group" aria-label="Results that are kept">
          {results.list.value.map((each) => (
            <ResultTab key={each.key} outcome={each} active={each === outcome} />
          ))}
        </div>
        {outcome ? (
          <ResultInfo outcome={outcome} open={open} onFold={() => setFolded(open ? outcome : null)} />
        ) : (
          <span class="grow" />
        )}
        <button
          type="button"
          class="btn quiet"
          aria-pressed={results.overlay.value}
          title="Show new results together with those that are shown already"
          aria-label="Overlay"
          onClick={() => (results.overlay.value = !results.overlay.value)}
        >
          <Icon name="layers" />
          <span class="wide-only">Overlay</span>
        </button>
        <IconButton icon="close" label="Close all results" onClick={() => results.closeAll()} />
      </div>
      {open && (
        <div class="callout warning diagnostics" data-testid="diagnostics">
          {outcome.answer.diagnostics.map((note) => (
            <div key={note}>
              <PlainText text={note} />
            </div>
          ))}
        </div>
      )}
      {outcome ? (
        <ResultBody key={outcome.key} outcome={outcome} />
      ) : (
        <p class="empty">Results of statements appear here.</p>
      )}
    </section>
  );
}

function ResultTab({ outcome, active }: { outcome: Outcome; active: boolean }) {
  const { results } = useApp().store;
  const title = titleOf(outcome.statement);
  const shown = outcome.shown.value.size > 0;
  const place = useRef<HTMLSpanElement>(null);
  useEffect(() => {
    if (active && place.current) scrollIntoRow(place.current);
  }, [active]);
  return (
    <span ref={place} class={`result-tab${active ? " active" : ""}`} data-testid="result-tab">
      {outcome.shapeColumns.length > 0 && (
        <IconButton
          small
          icon={shown ? "eye" : "eyeOff"}
          pressed={shown}
          label={`Show ${title} in 3D`}
          onClick={() => results.show(outcome, !shown)}
        />
      )}
      <button
        type="button"
        class="result-title"
        aria-current={active ? "true" : undefined}
        title={outcome.statement}
        onClick={() => (results.activeKey.value = outcome.key)}
        onAuxClick={(event) => event.button === 1 && results.close(outcome)}
      >
        <span class="ellipsis">
          <PlainText text={title} />
        </span>
        {outcome.table?.isRelation && (
          <span class="tag">{outcome.table.rows.count.toLocaleString("en")}</span>
        )}
        {outcome.answer.diagnostics.length > 0 && <Icon name="warning" />}
      </button>
      <IconButton small icon="close" label={`Close ${title}`} onClick={() => results.close(outcome)} />
    </span>
  );
}

/** Scrolls a row of tabs, and nothing around it, so that one of them is seen. */
function scrollIntoRow(tab: HTMLElement): void {
  const row = tab.parentElement;
  if (!row) return;
  const [inner, outer] = [tab.getBoundingClientRect(), row.getBoundingClientRect()];
  if (inner.left < outer.left) row.scrollLeft -= outer.left - inner.left;
  else if (inner.right > outer.right) row.scrollLeft += inner.right - outer.right;
}

interface InfoProps {
  readonly outcome: Outcome;
  /** Its notes are shown. */
  readonly open: boolean;
  readonly onFold: () => void;
}

/** The statement of a result, its size and time, and what can be done with it again. */
function ResultInfo({ outcome, open, onFold }: InfoProps) {
  const { store, workspace } = useApp();
  const { answer, table, text, statement, parameters } = outcome;
  const count = table?.isRelation
    ? table.rows.count === 1
      ? "1 row"
      : `${table.rows.count.toLocaleString("en")} rows`
    : "";
  return (
    <div class="result-info">
      <code class="ellipsis grow" title={statement}>
        <PlainText text={statement.replace(/\s+/g, " ")} />
      </code>
      {answer.diagnostics.length > 0 && (
        <button type="button" class="btn small quiet" aria-expanded={open} onClick={onFold}>
          <Icon name="warning" />
          {answer.diagnostics.length === 1 ? "1 note" : `${answer.diagnostics.length} notes`}
        </button>
      )}
      {text === null && (
        <span class="muted">{[count, seconds(answer.seconds)].filter(Boolean).join(", ")}</span>
      )}
      <IconButton
        small
        icon="code"
        label="Put the statement into the editor"
        onClick={() => workspace.editor.value?.append(`${statement};`)}
      />
      <IconButton
        small
        icon="refresh"
        label="Run again"
        onClick={() => void store.run(statement, { parameters })}
      />
    </div>
  );
}

function ResultBody({ outcome }: { outcome: Outcome }) {
  const { table, text } = outcome;
  return (
    <>
      {table && <ResultTable outcome={outcome} table={table} />}
      {text !== null && (
        <pre class="description" tabIndex={0} data-testid="description">
          {text}
        </pre>
      )}
    </>
  );
}
