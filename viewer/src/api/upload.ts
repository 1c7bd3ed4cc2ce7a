import type { Client } from "./client";
import { ServerGone, errorFromBody } from "./errors";
import type { Upload } from "./types";

/** A name that the server accepts: letters, digits, `.`, `_`, `-` and blanks, not beginning with a point. */
export function uploadName(fileName: string): string {
  const base = fileName.split(/[\\/]/).pop() ?? "";
  const clean = base
    .normalize("NFC")
    .replace(/[^A-Za-z0-9._\- ]/g, "_")
    .replace(/^[. ]+/, "")
    .trim();
  return clean || "file";
}

/** Sends a file to the server. `onProgress` gets the share that has been sent, 0 to 1. */
export function uploadFile(
  client: Client,
  file: File,
  onProgress: (share: number) => void,
  signal?: AbortSignal,
): Promise<Upload> {
  const { url, headers } = client.uploadTarget(uploadName(file.name));
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    request.open("PUT", url);
    for (const [name, value] of Object.entries(headers)) request.setRequestHeader(name, value);
    request.setRequestHeader("Content-Type", "application/octet-stream");
    request.upload.onprogress = (event) => event.lengthComputable && onProgress(event.loaded / event.total);
    request.onerror = () => reject(new ServerGone("the upload broke off"));
    request.onabort = () => reject(new DOMException("The upload was stopped.", "AbortError"));
    request.onload = () => {
      if (request.status >= 200 && request.status < 300) resolve(JSON.parse(request.responseText) as Upload);
      else reject(errorFromBody(request.status, request.responseText));
    };
    signal?.addEventListener("abort", () => request.abort(), { once: true });
    request.send(file);
  });
}
