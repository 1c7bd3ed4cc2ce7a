/** A nested list of the language, as types are written: `(rel (tuple ((Name string))))`. */
export type List = string | readonly List[];

/** Reads a nested list of symbols; null if the parentheses do not match or something follows. */
export function parseList(text: string): List | null {
  const stack: List[][] = [[]];
  for (const [token] of text.matchAll(/[()]|[^\s()]+/g)) {
    const top = stack.at(-1);
    if (top === undefined) return null;
    if (token === "(") {
      const list: List[] = [];
      top.push(list);
      stack.push(list);
    } else if (token === ")") {
      if (stack.length === 1) return null;
      stack.pop();
    } else {
      top.push(token);
    }
  }
  const [only, ...more] = stack[0] ?? [];
  return stack.length === 1 && more.length === 0 && only !== undefined ? only : null;
}

export function writeList(list: List): string {
  return typeof list === "string" ? list : `(${list.map(writeList).join(" ")})`;
}

export interface Attribute {
  readonly name: string;
  readonly type: string;
}

const collections = ["rel", "trel", "orel", "stream", "arel", "nrel", "mrel"];

/** The attributes of a relation, stream of tuples or tuple; null for every other type. */
export function attributesOf(type: string | null): readonly Attribute[] | null {
  const list = type === null ? null : parseList(type);
  const tuple = list !== null && isOf(list, collections) ? list[1] : list;
  if (tuple === undefined || tuple === null || !isOf(tuple, ["tuple"])) return null;
  const attributes = tuple[1];
  if (!Array.isArray(attributes)) return null;
  return (attributes as readonly List[]).flatMap((entry) =>
    Array.isArray(entry) && typeof entry[0] === "string"
      ? [{ name: entry[0], type: writeList((entry as readonly List[])[1] ?? "") }]
      : [],
  );
}

/** Whether values of the type are tables. */
export function isRelation(type: string | null): boolean {
  const list = type === null ? null : parseList(type);
  return list !== null && isOf(list, collections) && attributesOf(type) !== null;
}

/** A type for people: `relation of Name: string, Solid: volume3d`. */
export function describeType(type: string): string {
  const attributes = attributesOf(type);
  if (attributes === null) return type;
  const kind = isRelation(type) ? "relation" : "tuple";
  return `${kind} of ${attributes.map(({ name, type: of }) => `${name}: ${of}`).join(", ")}`;
}

function isOf(list: List, heads: readonly string[]): list is readonly List[] {
  return typeof list !== "string" && typeof list[0] === "string" && heads.includes(list[0]);
}
