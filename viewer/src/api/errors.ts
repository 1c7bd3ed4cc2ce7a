import type { ErrorBody } from "./types";

/** The server answered with an error; `message` is for people, `remedy` says what they can do. */
export class ApiError extends Error {
  override readonly name = "ApiError";
  readonly status: number;
  readonly code: string;
  readonly remedy: string;
  /** Place in the statement, counted from 1 in characters; null if the error has none. */
  readonly place: { readonly line: number; readonly column: number } | null;

  constructor(status: number, error: ErrorBody["error"]) {
    super(error.message);
    this.status = status;
    this.code = error.code;
    this.remedy = error.remedy ?? "";
    this.place =
      error.line === undefined || error.column === undefined
        ? null
        : { line: error.line, column: error.column };
  }
}

/** No answer: the server has ended, or the network is down. */
export class ServerGone extends Error {
  override readonly name = "ServerGone";

  constructor(reason: string) {
    super(`No answer from the server (${reason}).`);
  }
}

/** What `fetch` rejects with after its signal was aborted. */
export function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}

/** The text of any error, for people. */
export function messageOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

/** The error in the body of an answer; an answer that is not of this API gets a message that says so. */
export function errorFromBody(status: number, body: string): ApiError {
  try {
    const parsed = JSON.parse(body) as Partial<ErrorBody>;
    if (parsed.error && typeof parsed.error.message === "string") return new ApiError(status, parsed.error);
  } catch {
    // No JSON: a proxy in between, or another server on this port.
  }
  const start = body.trim().slice(0, 200);
  const message = `The server answered with status ${status}${start ? `: ${start}` : " and without a message"}.`;
  return new ApiError(status, { code: "unexpected_answer", message });
}

/** Whether the server has dropped what was asked for. */
export function isGone(error: unknown): boolean {
  return (
    error instanceof ApiError && (error.status === 410 || error.code === "gone" || error.code === "not_found")
  );
}
