import type { Json } from "../../api/types";
import type { Facts, Side } from "../../state/workbench";
import { shortNumber } from "../table/format";

/** Statistics of a mesh; what differs from the other side is emphasised. */
export function FactsTable({ side, other }: { side: Side; other: Side }) {
  const facts = side.facts.value;
  if (!side.step.value) return null;
  return (
    <div class="side-facts">
      {facts && <FactList facts={facts} compared={other.facts.value} />}
      {side.counting.value && !side.busy.value && (
        <p class="counting muted" role="status">
          Counting…
          <button type="button" class="btn small danger" onClick={() => side.stop()}>
            Stop
          </button>
        </p>
      )}
    </div>
  );
}

function FactList({ facts, compared }: { facts: Facts; compared: Facts | null }) {
  const others = new Map(compared?.map(({ name, value }) => [name, value]));
  return (
    <dl data-testid="facts">
      {facts.map(({ name, value }) => (
        <div key={name} class={others.has(name) && others.get(name) !== value ? "differs" : ""}>
          <dt>{name}</dt>
          <dd data-fact={name}>{factText(value)}</dd>
        </div>
      ))}
    </dl>
  );
}

function factText(value: Json): string {
  if (value === null) return "undefined";
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (typeof value === "number")
    return Number.isInteger(value) ? value.toLocaleString("en") : shortNumber(value);
  return typeof value === "string" ? value : JSON.stringify(value);
}
