import { ApiError, ServerGone, errorFromBody, isAbort, messageOf } from "./errors";
import { readEvents } from "./event_stream";
import type {
  CommandInfo,
  CellText,
  DatabaseObject,
  ErrorBody,
  MeshFormat,
  OperatorHelp,
  OperatorInfo,
  Progress,
  QueryAnswer,
  QueryRequest,
  RowsAnswer,
  RunningStatement,
  ServerInfo,
  StatementRange,
  TypeInfo,
  Upload,
} from "./types";

export interface ClientOptions {
  /** Address of the server up to its `/`; that of the page if empty. */
  readonly base?: string;
  readonly fetch?: typeof fetch;
  /** Whether shapes are compressed on their way; worth its time on a network, not on loopback. */
  readonly compressesShapes?: boolean;
}

interface Request {
  readonly method?: string;
  readonly query?: Readonly<Record<string, string | number>>;
  readonly json?: unknown;
  readonly accept?: string;
  readonly signal?: AbortSignal | undefined;
}

export interface ShapesQuery {
  readonly column: string;
  readonly from: number;
  readonly count: number;
  /** Largest number of triangles of one shape; 0 for all. */
  readonly triangles?: number;
  readonly bytes?: number;
}

/**
 * The HTTP API of `algebra3d serve`. Every method rejects with ApiError if the server refused, with ServerGone if there
 * was no answer, and with an AbortError after its signal was aborted.
 */
export class Client {
  /** Sent with every request; "" for none. */
  token = "";
  /** By which the server tells clients apart; sent with every request, "" for none. */
  name = "";
  /** Called at each answer of the server. */
  onAnswer: () => void = () => undefined;
  readonly #base: string;
  readonly #fetch: typeof fetch;
  readonly #encoding: { readonly encoding?: "gzip" };

  constructor(options: ClientOptions = {}) {
    this.#base = options.base ?? "";
    // Called without `this`, as browsers demand.
    this.#fetch = options.fetch ?? ((input, init) => fetch(input, init));
    this.#encoding = options.compressesShapes ? { encoding: "gzip" } : {};
  }

  server = (signal?: AbortSignal) => this.#get<ServerInfo>("api/server", { signal });
  objects = () => this.#get<DatabaseObject[]>("api/objects");
  types = () => this.#get<TypeInfo[]>("api/types");
  operators = () => this.#get<OperatorInfo[]>("api/operators");
  operator = (name: string) => this.#get<OperatorHelp>(`api/operators/${encodeURIComponent(name)}`);
  commands = () => this.#get<CommandInfo[]>("api/commands");
  keywords = () => this.#get<string[]>("api/keywords");
  formats = () => this.#get<MeshFormat[]>("api/formats");
  statements = () => this.#get<RunningStatement[]>("api/statements");

  /** Divides a text into its statements, as the shell does. */
  split(text: string, signal?: AbortSignal): Promise<StatementRange[]> {
    return this.#get("api/statements/split", { method: "POST", json: { text }, signal });
  }

  /** Runs a statement and waits for its value. */
  query(request: QueryRequest, signal?: AbortSignal): Promise<QueryAnswer> {
    return this.#get("api/query", { method: "POST", json: request, signal });
  }

  /** Runs a statement; `onProgress` is called while it runs. Aborting the signal cancels the statement. */
  async run(
    request: QueryRequest,
    onProgress: (progress: Progress) => void,
    signal?: AbortSignal,
  ): Promise<QueryAnswer> {
    const accept = "text/event-stream";
    const response = await this.#send("api/query", { method: "POST", json: request, accept, signal });
    // An error before the statement began may come as plain JSON.
    if (!response.headers.get("Content-Type")?.startsWith(accept))
      return (await this.#json(response)) as QueryAnswer;
    if (!response.body) throw new ServerGone("an empty answer");
    let answer: QueryAnswer | null = null;
    try {
      // Read to the end, so that the connection can be used again.
      for await (const { event, data } of readEvents(response.body)) {
        if (event === "progress") onProgress(JSON.parse(data) as Progress);
        else if (event === "result") answer = JSON.parse(data) as QueryAnswer;
        else if (event === "error") throw streamError(JSON.parse(data) as ErrorBody | ErrorBody["error"]);
      }
    } catch (error) {
      if (error instanceof ApiError || isAbort(error)) throw error;
      throw new ServerGone(messageOf(error));
    }
    if (!answer) throw new ServerGone("the answer ended early");
    return answer;
  }

  /** Cancels a running statement; one that has ended meanwhile is not an error. */
  async cancel(id: string): Promise<void> {
    await this.#delete(`api/statements/${encodeURIComponent(id)}`);
  }

  rows(result: string, from: number, count: number, signal?: AbortSignal): Promise<RowsAnswer> {
    return this.#get(`api/results/${result}/rows`, { query: { from, count }, signal });
  }

  cell(result: string, row: number, column: string, signal?: AbortSignal): Promise<CellText> {
    return this.#get(`api/results/${result}/cell`, { query: { row, column }, signal });
  }

  /** The shapes of a column as binary glTF; the response is returned as it is, to be read while it arrives. */
  shapes(result: string, query: ShapesQuery, signal?: AbortSignal): Promise<Response> {
    return this.#send(`api/results/${result}/shapes`, {
      query: { ...query, ...this.#encoding },
      signal,
      accept: "model/gltf-binary",
    });
  }

  /** What the server is doing for a result that is not ready to be drawn; "" if nothing. */
  async resultProgress(result: string, signal?: AbortSignal): Promise<string> {
    return (await this.#get<{ text: string }>(`api/results/${result}/progress`, { signal })).text;
  }

  /** A cell as a mesh file of the form `format`, with the notes on its rounding. */
  async file(
    result: string,
    row: number,
    column: string,
    format: string,
  ): Promise<{ blob: Blob; diagnostics: string[] }> {
    const response = await this.#send(`api/results/${result}/file`, {
      query: { row, column, format },
      accept: "*/*",
    });
    const notes = response.headers.get("X-Algebra3d-Diagnostics");
    return { blob: await response.blob(), diagnostics: notes ? (JSON.parse(notes) as string[]) : [] };
  }

  /** Drops a result; one that the server has dropped already is not an error. */
  async drop(result: string): Promise<void> {
    await this.#delete(`api/results/${result}`);
  }

  uploads = () => this.#get<Upload[]>("api/uploads");

  /** The address and headers of an upload, for XMLHttpRequest, which reports its progress. */
  uploadTarget(name: string): { url: string; headers: Record<string, string> } {
    return { url: `${this.#base}api/uploads/${encodeURIComponent(name)}`, headers: this.#headers({}) };
  }

  async #get<T>(path: string, request: Request = {}): Promise<T> {
    return (await this.#json(await this.#send(path, request))) as T;
  }

  async #json(response: Response): Promise<unknown> {
    try {
      return await response.json();
    } catch (error) {
      if (isAbort(error)) throw error;
      throw new ServerGone(messageOf(error));
    }
  }

  async #delete(path: string): Promise<void> {
    try {
      await this.#send(path, { method: "DELETE" });
    } catch (error) {
      if (!(error instanceof ApiError && (error.status === 404 || error.status === 410))) throw error;
    }
  }

  #headers(request: Request): Record<string, string> {
    const headers: Record<string, string> = {};
    if (this.token) headers["Authorization"] = `Bearer ${this.token}`;
    if (this.name) headers["X-Algebra3d-Client"] = this.name;
    if (request.accept) headers["Accept"] = request.accept;
    if (request.json !== undefined) headers["Content-Type"] = "application/json";
    return headers;
  }

  async #send(path: string, request: Request): Promise<Response> {
    const query = request.query
      ? `?${new URLSearchParams(Object.entries(request.query).map(([key, value]) => [key, String(value)])).toString()}`
      : "";
    const init: RequestInit = { method: request.method ?? "GET", headers: this.#headers(request) };
    if (request.json !== undefined) init.body = JSON.stringify(request.json);
    if (request.signal) init.signal = request.signal;
    let response: Response;
    try {
      response = await this.#fetch(`${this.#base}${path}${query}`, init);
    } catch (error) {
      if (isAbort(error)) throw error;
      throw new ServerGone(messageOf(error));
    }
    this.onAnswer();
    if (!response.ok) throw errorFromBody(response.status, await response.text().catch(() => ""));
    return response;
  }
}

/** Whether a name of a host is of this machine, as the server has them by default. */
export function isLoopback(host: string): boolean {
  return host === "localhost" || host === "[::1]" || /^127(\.\d+){3}$/.test(host);
}

/** The error of an event `error`, with or without the member `error` around it. */
function streamError(body: ErrorBody | ErrorBody["error"]): ApiError {
  const error = "error" in body ? body.error : body;
  return new ApiError(error.status ?? 422, error);
}
