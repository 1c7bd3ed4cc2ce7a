/** The answers of the HTTP API, as `docs/http-api.md` describes them. */

/** A value in JSON: undefined is null, lists are arrays, geometry is a summary. */
export type Json = null | boolean | number | string | readonly Json[] | { readonly [key: string]: Json };

/** What stands in a table for geometry: its kind, how much there is of it, and its box `[x1, x2, y1, y2, z1, z2]`. */
export interface GeometrySummary {
  readonly type: string;
  readonly box?: readonly number[] | null;
  readonly [count: string]: Json | undefined;
}

export type Row = Readonly<Record<string, Json>>;

export interface Column {
  readonly name: string;
  readonly type: string;
  /** Whether the values can be drawn. */
  readonly shape: boolean;
}

/** A result that is kept on the server. */
export interface ResultInfo {
  readonly id: string;
  readonly count: number;
  readonly columns: readonly Column[];
}

export interface QueryAnswer {
  readonly type: string | null;
  readonly value: Json;
  readonly diagnostics: readonly string[];
  readonly seconds: number;
  readonly result?: ResultInfo;
}

/** The value of `$name` in a statement: a cell of a result, or a value (text of its nested list for structured types). */
export type Parameter =
  | { readonly result: string; readonly row: number; readonly column: string }
  | { readonly type: string; readonly value: number | string };

export interface QueryRequest {
  readonly statement: string;
  /** Rows in the answer; 0 to 10,000, 100 if not given. */
  readonly rows?: number;
  readonly id?: string;
  readonly parameters?: Readonly<Record<string, Parameter>>;
}

export interface Progress {
  readonly text: string;
  readonly seconds: number;
}

export interface RunningStatement {
  readonly id: string;
  readonly statement: string;
  readonly seconds: number;
  readonly progress: string;
}

/** A statement of a longer text; `begin` and `end` count UTF-16 units. */
export interface StatementRange {
  readonly text: string;
  readonly line: number;
  readonly column: number;
  readonly begin: number;
  readonly end: number;
}

export interface RowsAnswer {
  readonly from: number;
  readonly rows: readonly Row[];
}

export interface CellText {
  readonly type: string;
  readonly text: string;
}

export interface ServerInfo {
  readonly name: string;
  readonly version: string;
  readonly database: string;
  readonly readOnly: boolean;
  readonly uploadLimit: number;
  readonly statementLimit: number;
}

export type ObjectKind = "relation" | "value" | "index" | "function";

export interface DatabaseObject {
  readonly name: string;
  readonly type: string;
  readonly kind: ObjectKind;
  /** Tuples of a relation. */
  readonly count?: number | null;
  readonly shape: boolean;
  readonly hasValue: boolean;
  readonly derivedFrom?: string | null;
  readonly indexOf?: string | null;
}

export interface TypeInfo {
  readonly name: string;
  readonly doc: string;
  readonly shape: boolean;
}

/** A command of the language; words in capital letters stand for something else. */
export interface CommandInfo {
  readonly syntax: string;
  readonly doc: string;
}

export interface OperatorInfo {
  readonly name: string;
  readonly family: string;
  readonly syntax: string;
  readonly doc: string;
  readonly signatures: readonly string[];
  /** Whether it writes files or changes stored relations. */
  readonly changes: boolean;
}

export interface OperatorHelp extends OperatorInfo {
  readonly detail: string;
  readonly exactness: string;
  readonly cost: string;
  readonly examples: readonly { readonly query: string; readonly result: string }[];
  readonly errors: readonly (string | { readonly query: string; readonly message?: string })[];
  /** The text of the command `help`. */
  readonly help: string;
}

export interface Upload {
  /** The name for statements, with `uploads/` before it. */
  readonly name: string;
  readonly bytes: number;
}

/** A form in which mesh files are written. */
export interface MeshForm {
  /** Its name in requests: `stl`, `stl-ascii`. */
  readonly format: string;
  readonly binary: boolean;
  readonly coordinates: "doubles" | "floats";
  readonly mediaType: string;
}

/** A format of mesh files. */
export interface MeshFormat {
  readonly name: string;
  /** Of file names, in lower case with their point. */
  readonly endings: readonly string[];
  /** The operator that reads a file as a solid. */
  readonly importer: string;
  /** Whether polygons are kept, or become triangles. */
  readonly polygons: boolean;
  /** Whether a file has the name of its solid. */
  readonly names: boolean;
  /** Whether a file has attributes of vertices, edges and faces. */
  readonly attributes: boolean;
  /** The first is the usual one. */
  readonly forms: readonly MeshForm[];
}

/** The body of every error response. */
export interface ErrorBody {
  readonly error: {
    readonly code: string;
    readonly message: string;
    readonly remedy?: string;
    readonly line?: number;
    readonly column?: number;
    /** In the event `error` of a stream. */
    readonly status?: number;
  };
}
