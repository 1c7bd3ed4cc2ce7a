import type { CellRef } from "../scene/api";
import { isKept, keptOf, type KeptResult } from "./kept_result";
import type { Outcome, Parameters } from "./outcome";
import { isLinkCompare, type LinkCompare } from "./workbench_link";

/** A parameter in a link: a cell of the n-th statement of the link, or a plain value. */
type LinkParameter =
  readonly [number, number, string] | { readonly type: string; readonly value: number | string };

export interface LinkStatement {
  readonly text: string;
  readonly parameters?: Readonly<Record<string, LinkParameter>>;
  /** Columns shown in 3D. */
  readonly shown: readonly string[];
  /** Its result, if the page is that of this browser. */
  readonly kept?: KeptResult;
}

/** Which panels are open. */
export interface LinkLayout {
  readonly side: boolean;
  readonly bottom: boolean;
}

/** A view of the page as plain data. */
export interface LinkView {
  readonly version: 1;
  readonly statements: readonly LinkStatement[];
  /** The statement whose table is shown. */
  readonly active: number;
  /** The selected cell as statement, row, column. */
  readonly selected?: readonly [number, number, string | null];
  /** Text in the editor; "" for the one that is there. */
  readonly editor: string;
  /** Of the page of this browser; links of others leave it as it is. */
  readonly layout?: LinkLayout;
  /** What SceneView.toJSON gave, with places of statements for results. */
  readonly scene: unknown;
  /** The split screen, if it is shown. */
  readonly compare?: LinkCompare;
}

/** What a view is made of. */
export interface ViewParts {
  readonly outcomes: readonly Outcome[];
  readonly activeKey: number | null;
  readonly selected: { readonly result: string; readonly row: number; readonly column: string | null } | null;
  readonly editor: string;
  readonly scene: unknown;
  /** The results are named, so that this browser can take them up again. */
  readonly keep?: boolean;
}

/** The view of a link; outcomes whose parameters are cells of closed results cannot be brought back and are left out. */
export function makeView({ outcomes, activeKey, selected, editor, scene, keep = false }: ViewParts): {
  view: LinkView;
  left: readonly Outcome[];
  placeOf: (result: string) => number | null;
} {
  const taken: Outcome[] = [];
  const left: Outcome[] = [];
  const statements: LinkStatement[] = [];
  for (const outcome of outcomes) {
    const parameters = linkParameters(outcome.parameters, taken);
    if (parameters === null || outcome.resultId === null) {
      left.push(outcome);
      continue;
    }
    taken.push(outcome);
    const shown = [...outcome.shown.value];
    const kept = keep ? keptOf(outcome) : null;
    statements.push({
      text: outcome.statement,
      shown,
      ...(Object.keys(parameters).length ? { parameters } : {}),
      ...(kept ? { kept } : {}),
    });
  }
  const place = taken.findIndex(({ resultId }) => resultId === selected?.result);
  const active = Math.max(
    0,
    taken.findIndex(({ key }) => key === activeKey),
  );
  const selection =
    selected && place >= 0 ? { selected: [place, selected.row, selected.column] as const } : {};
  const placeOf = (result: string): number | null => {
    const found = taken.findIndex(({ resultId }) => resultId === result);
    return found < 0 ? null : found;
  };
  const kept = withCells(scene, (result) => {
    const found = placeOf(result);
    return found === null ? null : String(found);
  });
  return { view: { version: 1, statements, active, ...selection, editor, scene: kept }, left, placeOf };
}

/** The state of a scene for the results of this page, from that of a link. */
export function sceneOf(scene: unknown, results: readonly (string | null)[]): unknown {
  return withCells(scene, (place) => results[Number(place)] ?? null);
}

/** A state of a scene with other names for results in its cells; what belongs to one without a name is left out. */
export function withCells(scene: unknown, nameOf: (result: string) => string | null): unknown {
  const named = renamed(scene, nameOf);
  return named === kLost ? null : named;
}

const kLost = Symbol("of a result without a name");

/** `kLost` of a cell without a name, of what has such a cell, and of a list of places of which one is lost. */
function renamed(value: unknown, nameOf: (result: string) => string | null): unknown {
  if (typeof value !== "object" || value === null) return value;
  if (Array.isArray(value))
    return value.map((each) => renamed(each, nameOf)).filter((each) => each !== kLost);
  if ("result" in value && "row" in value && "column" in value) {
    const result = nameOf(String(value.result));
    return result === null ? kLost : { ...value, result };
  }
  const fields = Object.entries(value).map(([key, field]) => [key, renamed(field, nameOf)] as const);
  const { cell, hits } = Object.fromEntries(fields) as { cell?: unknown; hits?: unknown };
  const before = (value as { hits?: unknown }).hits;
  if (cell === kLost || (Array.isArray(before) && (hits as unknown[]).length < before.length)) return kLost;
  return Object.fromEntries(fields.filter(([, field]) => field !== kLost));
}

function linkParameters(
  parameters: Parameters,
  taken: readonly Outcome[],
): Record<string, LinkParameter> | null {
  const link: Record<string, LinkParameter> = {};
  for (const [name, value] of Object.entries(parameters)) {
    if (!("result" in value)) {
      link[name] = value;
      continue;
    }
    const place = taken.findIndex(({ resultId }) => resultId === value.result);
    if (place < 0) return null;
    link[name] = [place, value.row, value.column];
  }
  return link;
}

/** The parameters for running a statement of a link, given the results of those before it. */
export function parametersOf(statement: LinkStatement, results: readonly (string | null)[]): Parameters {
  const parameters: Record<string, Parameters[string]> = {};
  for (const [name, value] of Object.entries(statement.parameters ?? {})) {
    if (!isPlace(value)) {
      parameters[name] = value;
      continue;
    }
    const [place, row, column] = value;
    const result = results[place];
    if (result) parameters[name] = { result, row, column } satisfies CellRef;
  }
  return parameters;
}

const isPlace = (value: LinkParameter): value is readonly [number, number, string] => Array.isArray(value);

/** A view as text for the fragment of an address: compressed, in the alphabet of URLs. */
export async function encodeView(view: LinkView): Promise<string> {
  const bytes = new Blob([JSON.stringify(view)]).stream().pipeThrough(new CompressionStream("deflate"));
  const packed = new Uint8Array(await new Response(bytes).arrayBuffer());
  let binary = "";
  for (const byte of packed) binary += String.fromCharCode(byte);
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** Largest size of a view; a link of a few bytes may otherwise unpack to gigabytes. */
const largestView = 4_000_000;

/** Reads what encodeView wrote; rejects with a message for people if the link is damaged. */
export async function decodeView(text: string): Promise<LinkView> {
  let view: unknown;
  try {
    const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
    const packed = Uint8Array.from(binary, (character) => character.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    view = JSON.parse(await readLimited(stream));
  } catch {
    throw new Error("The link is damaged: its view cannot be read. Was it copied in full?");
  }
  if (!isView(view)) throw new Error("The link was made by another version of this page and cannot be read.");
  return view;
}

async function readLimited(stream: ReadableStream<Uint8Array>): Promise<string> {
  const decoder = new TextDecoder();
  let text = "";
  const reader = stream.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) return text + decoder.decode();
    text += decoder.decode(value, { stream: true });
    if (text.length > largestView) throw new Error("too large");
  }
}

function isLayout(value: Partial<LinkLayout> | null): boolean {
  return [value?.side, value?.bottom].every((open) => typeof open === "boolean");
}

function isView(value: unknown): value is LinkView {
  if (typeof value !== "object" || value === null) return false;
  const view = value as Partial<LinkView>;
  return (
    view.version === 1 &&
    typeof view.editor === "string" &&
    (view.layout === undefined || isLayout(view.layout)) &&
    (view.compare === undefined || isLinkCompare(view.compare)) &&
    Array.isArray(view.statements) &&
    view.statements.every(
      (statement: Partial<LinkStatement>) =>
        typeof statement.text === "string" &&
        Array.isArray(statement.shown) &&
        (statement.kept === undefined || isKept(statement.kept)),
    )
  );
}
