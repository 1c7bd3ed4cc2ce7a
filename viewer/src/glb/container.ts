/**
 * The container of binary glTF 2.0: a header of 12 bytes, then a JSON chunk and a binary chunk. Little endian.
 * Source: Khronos glTF 2.0 specification, section 4.
 */

const kMagic = 0x46546c67; // "glTF"
const kJsonChunk = 0x4e4f534a; // "JSON"
const kBinaryChunk = 0x004e4942; // "BIN\0"

/** A file that is not what docs/http-api.md describes; the message says what was found and where. */
export class ShapeFormatError extends Error {
  override readonly name = "ShapeFormatError";
}

export interface Container {
  readonly json: unknown;
  /** The buffer that was given; no copy. */
  readonly buffer: ArrayBuffer;
  /** Where the binary chunk lies in it. */
  readonly binaryOffset: number;
  readonly binaryLength: number;
}

/** Divides binary glTF into its chunks, without a copy. Errors: ShapeFormatError. Cost: that of parsing the JSON. */
export function readContainer(buffer: ArrayBuffer): Container {
  const view = new DataView(buffer);
  if (buffer.byteLength < 20) {
    throw new ShapeFormatError(`shapes: ${buffer.byteLength} bytes are too few for binary glTF`);
  }
  if (view.getUint32(0, true) !== kMagic) {
    throw new ShapeFormatError("shapes: byte 0: expected binary glTF (glTF), found something else");
  }
  const version = view.getUint32(4, true);
  if (version !== 2) throw new ShapeFormatError(`shapes: byte 4: expected glTF version 2, found ${version}`);
  const length = view.getUint32(8, true);
  if (length > buffer.byteLength) {
    throw new ShapeFormatError(`shapes: the header announces ${length} bytes, ${buffer.byteLength} came`);
  }
  const jsonLength = chunkLength(view, 12, kJsonChunk, length);
  const text = new TextDecoder().decode(new Uint8Array(buffer, 20, jsonLength));
  const next = 20 + jsonLength;
  if (next + 8 > length) return { json: JSON.parse(text), buffer, binaryOffset: length, binaryLength: 0 };
  const binaryLength = chunkLength(view, next, kBinaryChunk, length);
  return { json: JSON.parse(text), buffer, binaryOffset: next + 8, binaryLength };
}

function chunkLength(view: DataView, at: number, type: number, end: number): number {
  const length = view.getUint32(at, true);
  if (view.getUint32(at + 4, true) !== type) {
    throw new ShapeFormatError(`shapes: byte ${at + 4}: unexpected type of chunk`);
  }
  if (at + 8 + length > end) {
    throw new ShapeFormatError(
      `shapes: byte ${at}: a chunk of ${length} bytes goes beyond the end at ${end}`,
    );
  }
  return length;
}
