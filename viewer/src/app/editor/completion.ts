import type { Completion, CompletionContext, CompletionResult } from "@codemirror/autocomplete";
import type { EditorView } from "@codemirror/view";
import type { Column, DatabaseObject, OperatorInfo } from "../../api/types";
import { attributesOf, type Attribute } from "../../state/types";

/** What can be completed; asked anew at each completion. */
export interface Known {
  readonly keywords: readonly string[];
  readonly operators: readonly OperatorInfo[];
  readonly types: readonly { readonly name: string; readonly doc: string }[];
  readonly objects: readonly DatabaseObject[];
  /** Columns of the result that is shown. */
  readonly columns: readonly Column[];
}

/** Completes attributes after a dot, else operators, objects, types and words of commands. */
export function complete(context: CompletionContext, known: Known): CompletionResult | null {
  if (isInLiteral(context.state.sliceDoc(statementBegin(context), context.pos))) return null;
  const attribute = context.matchBefore(/\.{1,2}\w*/);
  if (attribute) {
    const from = attribute.from + (attribute.text.startsWith("..") ? 2 : 1);
    // A digit before the dot makes it a number.
    if (/\d/.test(context.state.sliceDoc(Math.max(0, attribute.from - 1), attribute.from))) return null;
    const statement = context.state.sliceDoc(statementBegin(context));
    return { from, options: attributesIn(statement, known).map(attributeOption), validFor: /^\w*$/ };
  }
  const word = context.matchBefore(/[A-Za-z]\w*/);
  if (!word && !context.explicit) return null;
  return { from: word ? word.from : context.pos, options: wordOptions(known), validFor: /^\w*$/ };
}

/** The offset where the statement of the cursor begins: after the last `;` or empty line. */
function statementBegin(context: CompletionContext): number {
  const before = context.state.sliceDoc(0, context.pos);
  return Math.max(before.lastIndexOf(";"), before.search(/\n\s*\n(?![\s\S]*\n\s*\n)/)) + 1;
}

function isInLiteral(text: string): boolean {
  let quote = "";
  for (let index = 0; index < text.length; index++) {
    const character = text[index] ?? "";
    if (quote && character === "\\") index++;
    else if (character === quote) quote = "";
    else if (!quote && (character === '"' || character === "'")) quote = character;
  }
  return quote !== "";
}

/**
 * The attributes that a statement may name: those of the relations in it, with the endings that `{a}` adds, those that
 * it defines (`extend[New: ...]`), and the columns of the result that is shown.
 */
export function attributesIn(
  statement: string,
  known: Pick<Known, "objects" | "columns">,
): readonly Attribute[] {
  const found = new Map<string, string>();
  const names = new Set(statement.match(/[A-Za-z]\w*/g) ?? []);
  const endings = [...statement.matchAll(/\{\s*([A-Za-z]\w*)\s*\}/g)].map((match) => `_${match[1] ?? ""}`);
  for (const object of known.objects) {
    if (!names.has(object.name)) continue;
    for (const { name, type } of attributesOf(object.type) ?? [])
      for (const ending of endings.length ? endings : [""]) found.set(name + ending, type);
  }
  for (const match of statement.matchAll(/[[,;]\s*([A-Za-z]\w*)\s*:/g)) if (match[1]) found.set(match[1], "");
  for (const { name, type } of known.columns) if (!found.has(name)) found.set(name, type);
  return [...found].map(([name, type]) => ({ name, type }));
}

function attributeOption({ name, type }: Attribute): Completion {
  return { label: name, type: "property", detail: type, boost: type ? 1 : 0 };
}

function wordOptions(known: Known): readonly Completion[] {
  return [
    ...known.objects.map((object): Completion => ({
      label: object.name,
      type: object.kind === "function" ? "function" : "variable",
      detail: object.kind,
      info: object.type,
      boost: 2,
    })),
    ...known.operators.filter(({ name }) => /^[A-Za-z]/.test(name)).map(operatorOption),
    ...known.keywords.map((label): Completion => ({ label, type: "keyword", boost: 1 })),
    ...known.types.map(({ name, doc }): Completion => ({ label: name, type: "type", info: doc, boost: -1 })),
  ];
}

/** The syntax with words for what stands in it: `fun(STREAMELEM)` is an expression of the attributes of a tuple. */
export function readableSyntax(syntax: string): string {
  return syntax.replace(/fun\([^()]*\)/g, "expression of .Attributes");
}

function operatorOption(operator: OperatorInfo): Completion {
  return {
    label: operator.name,
    type: "function",
    detail: readableSyntax(operator.syntax),
    info: operator.doc,
    apply: (view, _, from, to) => insertOperator(view, operator, from, to),
  };
}

/** Inserts an operator with the brackets of its syntax, and puts the cursor into them. */
function insertOperator(view: EditorView, { name, syntax }: OperatorInfo, from: number, to: number): void {
  const after = syntax.slice(syntax.indexOf(name) + name.length);
  const open = /^[([]/.exec(after)?.[0] ?? "";
  const has = view.state.sliceDoc(to, to + 1) === open;
  const brackets = !open || has ? "" : open === "(" ? "()" : "[]";
  const anchor = from + name.length + (open ? 1 : 0);
  view.dispatch({
    changes: { from, to, insert: name + brackets },
    selection: { anchor },
    userEvent: "input.complete",
  });
}
