#include "algebra3d/values/types/codec.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <memory>
#include <new>
#include <optional>

#include <xxhash.h>
#include <zstd.h>
#include <zstd_errors.h>

#include "algebra3d/kernel/exact/rational_text.h"
#include "algebra3d/values/types/binary_io.h"
#include "algebra3d/values/types/detail/codec_points.h"
#include "base/interruption_scope.h"
#include "base/memory_limit.h"
#include "base/propagate.h"

// The format is that of docs/file_format.md, which is changed first.

namespace algebra3d {
namespace {

constexpr std::string_view kMagic =
    "\x89"
    "A3D";
constexpr std::uint16_t kVersion = 1;
constexpr std::uint16_t kDefined = 1;
constexpr std::uint16_t kCompressed = 2;
constexpr std::size_t kTypeBytes = 12;
constexpr std::size_t kChecksumOffset = 88;
constexpr std::size_t kCompressFrom = 64;
constexpr std::size_t kSkippableHead = 8;  // of a Zstandard frame that holds nothing
constexpr std::uint64_t kMaxRatio = 1024;
constexpr int kCompressionLevel = 3;

/// The 96 bytes before a body.
struct Frame {
  std::uint16_t flags = 0;
  std::string type;
  GeometryHeader geometry;
  std::uint64_t stored_bytes = 0;
  std::uint64_t body_bytes = 0;
  std::uint64_t checksum = 0;

  bool is_defined() const { return (flags & kDefined) != 0; }
  bool is_compressed() const { return (flags & kCompressed) != 0; }
};

std::uint64_t checksum_of(std::string_view frame, std::string_view body) {
  const std::uint64_t seed = XXH3_64bits(frame.data(), kChecksumOffset);
  return XXH3_64bits_withSeed(body.data(), body.size(), seed);
}

Error corrupt(std::size_t byte, std::string_view expectation) {
  return {ErrorCode::database_corrupt, "stored value: byte {}: expected {}", byte, expectation};
}

void write_corner(ByteWriter& writer, const Vec3& corner) {
  for (std::size_t axis = 0; axis < 3; ++axis) writer.f64(corner[axis]);
}

Vec3 read_corner(ByteReader& reader) {
  Vec3 corner;
  for (std::size_t axis = 0; axis < 3; ++axis) corner[axis] = reader.f64();
  return corner;
}

/// The bytes before the checksum.
void write_frame(ByteWriter& writer, const Frame& frame) {
  writer.raw(kMagic);
  writer.u16(kVersion);
  writer.u16(frame.flags);
  writer.u32(frame.geometry.size);
  assert(frame.type.size() <= kTypeBytes);
  writer.raw(frame.type);
  for (std::size_t i = frame.type.size(); i < kTypeBytes; ++i) writer.u8(0);
  write_corner(writer, frame.geometry.box.min);
  write_corner(writer, frame.geometry.box.max);
  writer.u64(frame.stored_bytes);
  writer.u64(frame.body_bytes);
}

Status check_box(const Box3& box) {
  if (box == Box3() || !box.is_empty()) return {};
  return corrupt(24, "the empty box, or corners in order");
}

Status check_lengths(const Frame& frame) {
  if (!frame.is_compressed() && frame.body_bytes != frame.stored_bytes)
    return corrupt(80, fmt::format("{}, the stored bytes, found {}", frame.stored_bytes, frame.body_bytes));
  if (frame.body_bytes / kMaxRatio > frame.stored_bytes ||
      (frame.body_bytes / kMaxRatio == frame.stored_bytes && frame.body_bytes % kMaxRatio != 0))
    return corrupt(80, fmt::format("at most {} times the {} stored bytes, found {}", kMaxRatio, frame.stored_bytes,
                                   frame.body_bytes));
  if (!frame.is_defined() && frame.stored_bytes != 0)
    return corrupt(72, fmt::format("no body of an undefined value, found {} bytes", frame.stored_bytes));
  return {};
}

/// The zero-padded name; empty if it is not a name.
std::string read_type(ByteReader& reader) {
  const std::string_view field = reader.raw(kTypeBytes);
  const std::string_view name = field.substr(0, field.find('\0'));
  const bool is_name = std::ranges::all_of(name, [](char c) { return ' ' < c && c < 127; });
  const bool is_padded = std::ranges::all_of(field.substr(name.size()), [](char c) { return c == '\0'; });
  return is_name && is_padded ? std::string(name) : std::string();
}

Status read_version(ByteReader& reader) {
  if (reader.raw(kMagic.size()) != kMagic) return corrupt(0, "the bytes 89 41 33 44");
  const std::uint16_t version = reader.u16();
  if (version > kVersion)
    return Error{ErrorCode::database_version, "stored value: format version {}, this program reads versions up to {}",
                 version, kVersion};
  if (version != kVersion) return corrupt(4, fmt::format("version {}, found {}", kVersion, version));
  return {};
}

Result<Frame> read_frame(std::string_view bytes) {
  if (bytes.size() < kCodecHeaderBytes)
    return corrupt(bytes.size(), fmt::format("{} bytes before the body, found the end", kCodecHeaderBytes));
  ByteReader reader(bytes, "stored value");
  A3D_TRY(read_version(reader));
  Frame frame;
  frame.flags = reader.u16();
  if (frame.flags > (kDefined | kCompressed) || frame.flags == kCompressed)
    return corrupt(6, fmt::format("known flags, found {}", frame.flags));
  frame.geometry.size = reader.u32();
  frame.type = read_type(reader);
  if (frame.type.empty()) return corrupt(12, "the name of a type");
  frame.geometry.box.min = read_corner(reader);
  frame.geometry.box.max = read_corner(reader);
  A3D_TRY(check_box(frame.geometry.box));
  frame.stored_bytes = reader.u64();
  frame.body_bytes = reader.u64();
  A3D_TRY(check_lengths(frame));
  frame.checksum = reader.u64();
  return frame;
}

// A context for each thread, since making one costs more than compressing or decompressing a small value. Null without
// memory.
ZSTD_CCtx* compression_context() {
  struct Free {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  };
  thread_local const std::unique_ptr<ZSTD_CCtx, Free> context(ZSTD_createCCtx());
  return context.get();
}

ZSTD_DCtx* decompression_context() {
  struct Free {
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
  };
  thread_local const std::unique_ptr<ZSTD_DCtx, Free> context(ZSTD_createDCtx());
  return context.get();
}

void append_padding(std::string& compressed, std::size_t body_bytes) {
  const std::size_t least = (body_bytes + kMaxRatio - 1) / kMaxRatio;
  if (compressed.size() >= least) return;
  const std::size_t padding = least - std::min(least, compressed.size() + kSkippableHead);
  ByteWriter writer(compressed);
  writer.u32(ZSTD_MAGIC_SKIPPABLE_START);
  writer.u32(static_cast<std::uint32_t>(padding));
  compressed.append(padding, '\0');
}

/// Compresses into `stored`, which has room, in pieces between which an interrupt is heard. The size, or an error code.
std::size_t compress(ZSTD_CCtx* context, std::string& stored, const std::string& body) {
  constexpr std::size_t kPiece = std::size_t{1} << 20U;
  ZSTD_CCtx_reset(context, ZSTD_reset_session_and_parameters);
  ZSTD_CCtx_setParameter(context, ZSTD_c_compressionLevel, kCompressionLevel);
  ZSTD_CCtx_setPledgedSrcSize(context, body.size());
  ZSTD_outBuffer out{stored.data(), stored.size(), 0};
  ZSTD_inBuffer in{body.data(), 0, 0};
  while (true) {
    poll_interruption();
    in.size = std::min(body.size(), in.pos + kPiece);
    const std::size_t left =
        ZSTD_compressStream2(context, &out, &in, in.size == body.size() ? ZSTD_e_end : ZSTD_e_continue);
    if (ZSTD_isError(left) != 0U) return left;
    if (left == 0 && in.pos == body.size()) return out.pos;
  }
}

/// The body compressed, if that makes it shorter.
std::optional<std::string> compressed_body(const std::string& body) {
  ZSTD_CCtx* const context = compression_context();
  if (body.size() < kCompressFrom || context == nullptr) return std::nullopt;
  std::string stored(ZSTD_compressBound(body.size()), '\0');
  const std::size_t size = compress(context, stored, body);
  if (ZSTD_isError(size) != 0U) return std::nullopt;
  stored.resize(size);
  append_padding(stored, body.size());
  return stored.size() < body.size() ? std::optional(std::move(stored)) : std::nullopt;
}

/// Bytes that are allocated without being written to, so that a wrong length costs no memory before it is found out.
struct Buffer {
  std::unique_ptr<char[]> bytes;
  std::size_t size = 0;

  std::string_view view() const { return {bytes.get(), size}; }
};

/// Decompresses all frames in pieces between which an interrupt is heard. The size, or an error code.
std::size_t decompress_in_pieces(ZSTD_DCtx* context, const Buffer& buffer, std::string_view stored) {
  constexpr std::size_t kPiece = std::size_t{1} << 20U;
  ZSTD_outBuffer out{buffer.bytes.get(), 0, 0};
  ZSTD_inBuffer in{stored.data(), stored.size(), 0};
  for (std::size_t left = 1; left != 0 || in.pos < in.size;) {
    poll_interruption();
    const std::size_t known = in.pos + out.pos;
    out.size = std::min(buffer.size, out.pos + kPiece);
    left = ZSTD_decompressStream(context, &out, &in);
    if (ZSTD_isError(left) != 0U) return left;
    if (in.pos + out.pos == known) break;  // the bytes end within a frame, or it has more than there is room for
  }
  return in.pos == in.size ? out.pos : buffer.size + 1;
}

/// Decompresses in one piece if the body is small, or if its window is larger than ours are, which would take as much
/// memory again; else piece by piece.
std::size_t decompress_into(ZSTD_DCtx* context, const Buffer& buffer, std::string_view stored) {
  constexpr std::size_t kLarge = std::size_t{16} << 20U;
  constexpr int kLargestWindow = 22;  // its logarithm; that of kCompressionLevel is 21
  if (buffer.size > kLarge) {
    ZSTD_DCtx_reset(context, ZSTD_reset_session_and_parameters);
    ZSTD_DCtx_setParameter(context, ZSTD_d_windowLogMax, kLargestWindow);
    const std::size_t size = decompress_in_pieces(context, buffer, stored);
    ZSTD_DCtx_reset(context, ZSTD_reset_session_and_parameters);
    if (ZSTD_getErrorCode(size) != ZSTD_error_frameParameter_windowTooLarge) return size;
  }
  return ZSTD_decompressDCtx(context, buffer.bytes.get(), buffer.size, stored.data(), stored.size());
}

Result<Buffer> decompress(std::string_view stored, std::uint64_t body_bytes) {
  if (body_bytes > std::numeric_limits<std::size_t>::max() / 2) return corrupt(80, "a length within memory");
  // The size that the first frame announces is checked before anything is allocated.
  const auto announced = ZSTD_getFrameContentSize(stored.data(), stored.size());
  if (announced != body_bytes) return corrupt(kCodecHeaderBytes, fmt::format("a frame of {} bytes", body_bytes));
  A3D_TRY(require_memory(body_bytes, "stored value"));
  Buffer buffer{std::unique_ptr<char[]>(new (std::nothrow) char[body_bytes]), static_cast<std::size_t>(body_bytes)};
  ZSTD_DCtx* const context = decompression_context();
  if (buffer.bytes == nullptr || context == nullptr)
    return Error{ErrorCode::out_of_memory, "stored value: no memory for {} bytes", body_bytes};
  const std::size_t size = decompress_into(context, buffer, stored);
  if (ZSTD_isError(size) != 0U)
    return corrupt(kCodecHeaderBytes, fmt::format("compressed bytes ({})", ZSTD_getErrorName(size)));
  if (size != buffer.size)
    return corrupt(kCodecHeaderBytes, fmt::format("{} bytes after decompression, found {}", body_bytes, size));
  return buffer;
}

/// The limit of digits for values of an origin, within the scope.
class DigitLimit {
 public:
  explicit DigitLimit(Origin origin) : before_(most_digits) {
    if (origin == Origin::elsewhere) most_digits = max_digits_read();
  }
  ~DigitLimit() { most_digits = before_; }
  DigitLimit(const DigitLimit&) = delete;
  DigitLimit& operator=(const DigitLimit&) = delete;

 private:
  std::size_t before_;
};

Result<Value> decode_framed(const Type& type, const Frame& frame, std::string_view stored, Origin origin) {
  if (!frame.is_compressed()) return decode_body(type, stored, origin);
  A3D_ASSIGN(const Buffer buffer, decompress(stored, frame.body_bytes));
  return decode_body(type, buffer.view(), origin);
}

/// Refuses a value that was encoded since `take_longest_number`, if it has a number that is too long.
Status check_digits(const Value& value) {
  const std::size_t digits = take_longest_number();
  if (digits <= kMaxNumberDigits) return {};
  return Error{ErrorCode::limit_exceeded,
               "a value of type {} has a number of {} digits; at most {} are stored; roundCoordinates makes them fewer",
               value.type().name(), digits, kMaxNumberDigits};
}

/// The header of a value of any type; of a type without headers all zero.
GeometryHeader header_of(const Value& value) {
  return value.is_defined() && value.type().has_header() ? value.header() : GeometryHeader();
}

}  // namespace

std::string encode(const Value& value) {
  Frame frame;
  frame.type = value.type().name();
  frame.geometry = header_of(value);
  std::string body;
  if (value.is_defined()) {
    frame.flags = kDefined;
    value.type().encode(value, body);
  }
  frame.body_bytes = body.size();
  if (auto compressed = compressed_body(body)) {
    frame.flags |= kCompressed;
    body = std::move(*compressed);
  }
  frame.stored_bytes = body.size();

  std::string bytes;
  bytes.reserve(kCodecHeaderBytes + body.size());
  ByteWriter writer(bytes);
  write_frame(writer, frame);
  writer.u64(checksum_of(bytes, body));
  writer.raw(body);
  return bytes;
}

Result<std::string> encode_to_store(const Value& value) {
  take_longest_number();
  std::string bytes = encode(value);
  A3D_TRY(check_digits(value));
  return bytes;
}

Status append_body_to_store(const Value& value, std::string& bytes) {
  take_longest_number();
  value.type().encode(value, bytes);
  return check_digits(value);
}

Result<Value> decode_body(const Type& type, std::string_view body, Origin origin) {
  const DigitLimit limit(origin);
  return type.decode(body, origin == Origin::own_store);
}

Result<Value> decode(const Type& type, std::string_view bytes, Origin origin) {
  A3D_ASSIGN(const Frame frame, read_frame(bytes));
  if (frame.type != type.name()) return corrupt(12, fmt::format("type {}, found {}", type.name(), frame.type));
  const std::string_view stored = bytes.substr(kCodecHeaderBytes);
  if (stored.size() != frame.stored_bytes)
    return corrupt(72, fmt::format("{}, the bytes after the frame, found {}", stored.size(), frame.stored_bytes));
  if (checksum_of(bytes, stored) != frame.checksum)
    return corrupt(kChecksumOffset, "the checksum of these bytes; they were changed");
  Value value(type);
  if (frame.is_defined()) {
    A3D_ASSIGN(value, decode_framed(type, frame, stored, origin));
  }
  const GeometryHeader header = header_of(value);
  if (header.size != frame.geometry.size) return corrupt(8, fmt::format("size {}", header.size));
  if (!(header.box == frame.geometry.box)) return corrupt(24, "the bounding box of the value");
  return value;
}

Result<GeometryHeader> decode_header(std::string_view first_bytes) {
  A3D_ASSIGN(const Frame frame, read_frame(first_bytes));
  return frame.geometry;
}

}  // namespace algebra3d
