import { useEffect, useMemo, useState } from "preact/hooks";
import { messageOf } from "../../api/errors";
import type { OperatorHelp, OperatorInfo } from "../../api/types";
import { searchOperators } from "../../state/catalogue";
import { useApp } from "../context";
import { IconButton, SearchField } from "../ui/controls";

/** The operators by family; a search goes through names and descriptions. */
export function OperatorList() {
  const { store } = useApp();
  const [pattern, setPattern] = useState("");
  const [chosen, setChosen] = useState<string | null>(null);
  const operators = store.catalogue.operators.value;
  const found = useMemo(() => searchOperators(operators, pattern), [operators, pattern]);
  if (chosen !== null) return <OperatorPage name={chosen} onBack={() => setChosen(null)} />;
  return (
    <>
      <div class="list-search">
        <SearchField label={`Search ${operators.length} operators`} value={pattern} onInput={setPattern} />
      </div>
      {operators.length > 0 && found.length === 0 && <p class="empty">No operator matches.</p>}
      {pattern.trim() ? (
        <OperatorItems operators={found} onChoose={setChosen} />
      ) : (
        families(found).map(([family, members]) => (
          <details key={family} class="panel-section family">
            <summary>
              {family} <span class="tag">{members.length}</span>
            </summary>
            <OperatorItems operators={members} onChoose={setChosen} />
          </details>
        ))
      )}
    </>
  );
}

function OperatorItems({
  operators,
  onChoose,
}: {
  operators: readonly OperatorInfo[];
  onChoose: (name: string) => void;
}) {
  return (
    <ul class="list">
      {operators.map(({ name, syntax, doc }) => (
        <li key={name}>
          <button type="button" class="list-item operator-item" onClick={() => onChoose(name)}>
            <code>{syntax}</code>
            <span class="muted">{doc}</span>
          </button>
        </li>
      ))}
    </ul>
  );
}

function families(operators: readonly OperatorInfo[]): [string, OperatorInfo[]][] {
  const groups = new Map<string, OperatorInfo[]>();
  for (const operator of operators) {
    const group = groups.get(operator.family);
    if (group) group.push(operator);
    else groups.set(operator.family, [operator]);
  }
  return [...groups];
}

/** The whole description of an operator. */
function OperatorPage({ name, onBack }: { name: string; onBack: () => void }) {
  const { store, workspace } = useApp();
  const [help, setHelp] = useState<OperatorHelp | null>(null);
  const [problem, setProblem] = useState("");
  useEffect(() => {
    store.catalogue.help(name).then(setHelp, (error: unknown) => setProblem(messageOf(error)));
  }, [name]);
  return (
    <article class="operator-page">
      <div class="list-search">
        <button type="button" class="btn quiet" onClick={onBack}>
          ← All operators
        </button>
      </div>
      {problem && <p class="error-text">{problem}</p>}
      {help && (
        <>
          <h3>{help.name}</h3>
          <p>
            <code>{help.syntax}</code>
          </p>
          <p>{help.doc}</p>
          {help.detail && <p class="muted">{help.detail}</p>}
          <h4>Signatures</h4>
          <pre>{help.signatures.join("\n")}</pre>
          <h4>Examples</h4>
          {help.examples.map(({ query, result }) => (
            <div key={query} class="example">
              <pre>{query}</pre>
              <IconButton
                small
                icon="code"
                label="Put into the editor"
                onClick={() => workspace.editor.value?.append(`${query};`)}
              />
              <pre class="muted">{result}</pre>
            </div>
          ))}
          <dl class="facts">
            {help.exactness && (
              <>
                <dt>Exactness</dt>
                <dd>{help.exactness}</dd>
              </>
            )}
            {help.cost && (
              <>
                <dt>Cost</dt>
                <dd>{help.cost}</dd>
              </>
            )}
            <dt>Family</dt>
            <dd>{help.family}</dd>
          </dl>
        </>
      )}
    </article>
  );
}
