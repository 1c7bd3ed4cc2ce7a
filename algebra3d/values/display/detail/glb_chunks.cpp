#include "algebra3d/values/display/detail/glb_chunks.h"

#include <bit>
#include <cstring>
#include <limits>
#include <utility>

namespace algebra3d::detail {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2;  // "glTF"
constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

std::size_t filled_up(std::size_t bytes) {
  return (bytes + 3) / 4 * 4;
}

void append_word(std::string& file, std::size_t word) {
  const auto narrow = static_cast<std::uint32_t>(word);
  file.append(std::string_view(reinterpret_cast<const char*>(&narrow), sizeof narrow));
}

void append_narrowed(std::string& file, std::span<const std::byte> numbers) {
  const std::size_t begin = file.size(), count = numbers.size() / 4;
  file.resize(begin + 2 * count);
  for (std::size_t i = 0; i < count; ++i) std::memcpy(file.data() + begin + 2 * i, numbers.data() + 4 * i, 2);
}

}  // namespace

GlbChunks::GlbChunks() {
  json_["asset"] = {{"version", "2.0"}, {"generator", "algebra3d"}};
}

std::size_t GlbChunks::add_piece(const Piece& piece, BufferTarget target, std::size_t stride) {
  Json view = {{"buffer", 0}, {"byteOffset", size_}, {"byteLength", piece.size()}};
  if (stride != 0) view["byteStride"] = stride;
  if (target != BufferTarget::none) view["target"] = static_cast<int>(target);
  pieces_.push_back(piece);
  size_ += filled_up(piece.size());
  Json& views = json_["bufferViews"];
  views.push_back(std::move(view));
  return views.size() - 1;
}

std::size_t GlbChunks::add_view(std::span<const std::byte> bytes, BufferTarget target, std::size_t stride) {
  return add_piece({bytes, false}, target, stride);
}

std::size_t GlbChunks::add_accessor(std::size_t view, ComponentType component, std::size_t count, const char* type) {
  Json& accessors = json_["accessors"];
  accessors.push_back(
      {{"bufferView", view}, {"componentType", static_cast<int>(component)}, {"count", count}, {"type", type}});
  return accessors.size() - 1;
}

std::size_t GlbChunks::add_indices(std::span<const std::uint32_t> indices, std::size_t largest) {
  // The largest number of a type cannot be an index: it restarts primitives.
  const bool is_narrow = largest < std::numeric_limits<std::uint16_t>::max();
  const std::size_t view = add_piece({std::as_bytes(indices), is_narrow}, BufferTarget::indices, 0);
  return add_accessor(view, is_narrow ? ComponentType::unsigned_short : ComponentType::unsigned_int, indices.size(),
                      "SCALAR");
}

Result<std::string> GlbChunks::file() && {
  if (size_ > 0) json_["buffers"] = Json::array({{{"byteLength", size_}}});
  std::string json = json_.dump();
  json.resize(filled_up(json.size()), ' ');
  const std::size_t total =
      kHeaderBytes + kChunkHeaderBytes + json.size() + (size_ > 0 ? kChunkHeaderBytes + size_ : 0);
  if (total > std::numeric_limits<std::uint32_t>::max())
    return Error(ErrorCode::limit_exceeded, "binary glTF of {} bytes; the format allows less than 4 GB", total);
  std::string file;
  file.reserve(total);
  for (const std::size_t word : {std::size_t{kMagic}, std::size_t{kVersion}, total, json.size(), std::size_t{kJson}})
    append_word(file, word);
  file += json;
  if (size_ == 0) return file;
  append_word(file, size_);
  append_word(file, kBinary);
  for (const Piece& piece : pieces_) {
    if (piece.is_narrowed)
      append_narrowed(file, piece.bytes);
    else
      file.append(reinterpret_cast<const char*>(piece.bytes.data()), piece.bytes.size());
    file.resize(filled_up(file.size()), '\0');
  }
  return file;
}

}  // namespace algebra3d::detail
