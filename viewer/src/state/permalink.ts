import type { CellRef } from "../scene/api";
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
}

/** A view of the page as plain data. */
export interface LinkView {
  readonly version: 1;
  readonly statements: readonly LinkStatement[];
  /** The statement whose table is shown. */
  readonly active: number;
  /** The selected cell as statement, row, column. */
  readonly selected?: readonly [number, number, string | null];
  /** Text in the editor. */
  readonly editor: string;
  /** What SceneView.toJSON gave, with places of statements for results. */
  readonly scene: unknown;
  /** The split screen, if it is shown. */
  readonly compare?: LinkCompare;
}

/** The view of a link; outcomes whose parameters are cells of closed results cannot be brought back and are left out. */
export function makeView(
  outcomes: readonly Outcome[],
  activeKey: number | null,
  selected: { result: string; row: number; column: string | null } | null,
  editor: string,
  scene: unknown,
): { view: LinkView; left: readonly Outcome[]; placeOf: (result: string) => number | null } {
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
    statements.push({
      text: outcome.statement,
      shown,
      ...(Object.keys(parameters).length ? { parameters } : {}),
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

/** A state of a scene with other names for results in its colours of objects; those without a name are left out. */
function withCells(scene: unknown, nameOf: (result: string) => string | null): unknown {
  const { overrides } = (scene ?? {}) as { overrides?: readonly { readonly cell?: Partial<CellRef> }[] };
  if (!Array.isArray(overrides)) return scene;
  const named = overrides.flatMap((override: { readonly cell?: Partial<CellRef> }) => {
    const result = nameOf(override.cell?.result ?? "");
    return result === null ? [] : [{ ...override, cell: { ...override.cell, result } }];
  });
  return { ...(scene as object), overrides: named };
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

function isView(value: unknown): value is LinkView {
  if (typeof value !== "object" || value === null) return false;
  const view = value as Partial<LinkView>;
  return (
    view.version === 1 &&
    typeof view.editor === "string" &&
    (view.compare === undefined || isLinkCompare(view.compare)) &&
    Array.isArray(view.statements) &&
    view.statements.every(
      (statement: Partial<LinkStatement>) =>
        typeof statement.text === "string" && Array.isArray(statement.shown),
    )
  );
}
