import { readFileSync } from "node:fs";
import {
  createServer,
  request,
  type IncomingMessage,
  type Server as HttpServer,
  type ServerResponse,
} from "node:http";
import { extname, join, normalize } from "node:path";

const types: Readonly<Record<string, string>> = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript",
  ".css": "text/css",
  ".svg": "image/svg+xml",
};

/**
 * Serves the pages of a folder, and the API of a program that was built without them (or with older ones), as if both
 * came from one server. Answers with its port.
 */
export async function startFront(
  folder: string,
  apiPort: number,
): Promise<{ port: number; end: () => void }> {
  // The pages must work under the policy of the program.
  const policy = (await fetch(`http://127.0.0.1:${apiPort}/`)).headers.get("Content-Security-Policy") ?? "";
  const front = createServer((incoming, outgoing) => {
    const path = (incoming.url ?? "/").split("?")[0] ?? "/";
    if (path.startsWith("/api/")) passOn(incoming, outgoing, apiPort);
    else sendFile(outgoing, join(folder, normalize(path === "/" ? "/index.html" : path)), policy);
  });
  await new Promise<void>((resolve) => front.listen(0, "127.0.0.1", resolve));
  return { port: portOf(front), end: () => front.close() };
}

function portOf(server: HttpServer): number {
  const address = server.address();
  return typeof address === "object" && address ? address.port : 0;
}

function sendFile(outgoing: ServerResponse, path: string, policy: string): void {
  try {
    const bytes = readFileSync(path);
    const type = types[extname(path)] ?? "application/octet-stream";
    outgoing.writeHead(200, { "Content-Type": type, "Content-Security-Policy": policy }).end(bytes);
  } catch {
    outgoing.writeHead(404).end();
  }
}

function passOn(incoming: IncomingMessage, outgoing: ServerResponse, port: number): void {
  const host = `127.0.0.1:${port}`;
  const headers = { ...incoming.headers, host };
  if (headers.origin) headers.origin = `http://${host}`;
  const { method, url } = incoming;
  const onward = request({ host: "127.0.0.1", port, method, path: url, headers }, (answer) => {
    outgoing.writeHead(answer.statusCode ?? 502, answer.headers);
    answer.pipe(outgoing);
  });
  onward.on("error", () => outgoing.destroy());
  outgoing.on("close", () => onward.destroy());
  incoming.pipe(onward);
}
