import { HighlightStyle, StreamLanguage, syntaxHighlighting, type StringStream } from "@codemirror/language";
import { tags } from "@lezer/highlight";
import type { Extension } from "@codemirror/state";

/** The words that are highlighted. */
export interface Words {
  readonly keywords: ReadonlySet<string>;
  readonly operators: ReadonlySet<string>;
  readonly types: ReadonlySet<string>;
  readonly objects: ReadonlySet<string>;
}

interface State {
  /** The quote of an open literal, which may go over several lines. */
  quote: string | null;
}

/** Highlighting of the query language with the given words. */
export function language(words: Words): Extension {
  const parser = StreamLanguage.define<State>({
    name: "algebra3d",
    startState: () => ({ quote: null }),
    token: (stream, state) => token(stream, state, words),
    languageData: { commentTokens: { line: "#" }, closeBrackets: { brackets: ["(", "[", "{", '"', "'"] } },
    tokenTable: {
      parameter: tags.special(tags.variableName),
      attribute: tags.propertyName,
      object: tags.variableName,
    },
  });
  return [parser, syntaxHighlighting(style)];
}

function token(stream: StringStream, state: State, words: Words): string | null {
  if (state.quote) return literal(stream, state);
  if (stream.sol() && stream.eat("#")) {
    stream.skipToEnd();
    return "comment";
  }
  if (stream.eatSpace()) return null;
  const quote = stream.eat(/["']/);
  if (quote) {
    state.quote = quote;
    return literal(stream, state);
  }
  if (stream.match(/^\.{1,2}[A-Za-z]\w*/)) return "attribute";
  if (stream.match(/^\$[A-Za-z]\w*/)) return "parameter";
  if (stream.match(/^\d+(\.\d+)?([eE][+-]?\d+)?(\/\d+)?/)) return "number";
  if (stream.match(/^`[^`\n]*`/)) return "object";
  const name = stream.match(/^[A-Za-z]\w*/);
  if (name) return word(Array.isArray(name) ? name[0] : "", stream, words);
  stream.next();
  return null;
}

/** Attribute names before a colon look like attributes; else the word decides. */
function word(name: string, stream: StringStream, words: Words): string | null {
  if (stream.match(/^\s*:(?!=)/, false)) return "attribute";
  if (words.objects.has(name)) return "object";
  if (words.keywords.has(name)) return "keyword";
  if (words.operators.has(name)) return "operatorKeyword";
  if (words.types.has(name)) return "typeName";
  if (name === "TRUE" || name === "FALSE" || name === "undefined") return "bool";
  return null;
}

function literal(stream: StringStream, state: State): string {
  for (let next = stream.next(); next !== undefined; next = stream.next()) {
    if (next === "\\") stream.next();
    else if (next === state.quote) {
      state.quote = null;
      break;
    }
  }
  return "string";
}

const style = HighlightStyle.define([
  { tag: tags.keyword, color: "var(--code-keyword)", fontWeight: "600" },
  { tag: tags.operatorKeyword, color: "var(--code-operator)" },
  { tag: tags.typeName, color: "var(--code-keyword)" },
  { tag: tags.string, color: "var(--code-string)" },
  { tag: [tags.number, tags.bool], color: "var(--code-number)" },
  { tag: tags.comment, color: "var(--code-comment)", fontStyle: "italic" },
  { tag: tags.propertyName, color: "var(--code-attribute)" },
  { tag: tags.special(tags.variableName), color: "var(--code-parameter)" },
  { tag: tags.variableName, fontWeight: "600" },
]);
