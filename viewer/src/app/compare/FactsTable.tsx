import type { Json } from "../../api/types";
import type { Side } from "../../state/workbench";
import { shortNumber } from "../table/format";

/** Statistics of a mesh; what differs from the other side is emphasised. */
export function FactsTable({ side, other }: { side: Side; other: Side }) {
  const facts = side.facts.value;
  if (!side.step.value) return null;
  if (!facts) return <p class="side-facts muted">Counting…</p>;
  const compared = new Map(other.facts.value?.map(({ name, value }) => [name, value]));
  return (
    <dl class="side-facts" data-testid="facts">
      {facts.map(({ name, value }) => (
        <div key={name} class={compared.has(name) && compared.get(name) !== value ? "differs" : ""}>
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
