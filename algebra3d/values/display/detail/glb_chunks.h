#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "algebra3d/base/error.h"

namespace algebra3d::detail {

/// Numbers that glTF 2.0 gives its words.
enum class ComponentType : std::uint16_t {
  signed_byte = 5120,
  unsigned_short = 5123,
  unsigned_int = 5125,
  single = 5126
};
enum class BufferTarget : std::uint16_t { none = 0, vertices = 34962, indices = 34963 };

/// The two chunks of a binary glTF file while they grow: the description as JSON, and the arrays that it refers to,
/// which must outlive this object.
class GlbChunks {
 public:
  using Json = nlohmann::ordered_json;

  GlbChunks();

  /// The description; its lists are complete but for `buffers`.
  Json& json() { return json_; }

  /// Appends an array and a view of it; the number of the view. `stride` is 0 where elements are not vertices.
  std::size_t add_view(std::span<const std::byte> bytes, BufferTarget target, std::size_t stride = 0);
  /// An accessor of the elements of a new view; its number. `type` is SCALAR or VEC3.
  std::size_t add_accessor(std::size_t view, ComponentType component, std::size_t count, const char* type);
  /// An accessor of numbers up to `largest`, in the narrowest type that can be drawn.
  std::size_t add_indices(std::span<const std::uint32_t> indices, std::size_t largest);

  /// The whole file. Errors: limit_exceeded.
  Result<std::string> file() &&;

 private:
  /// A view's bytes; numbers of 32 bits are written with 16 if `is_narrowed`.
  struct Piece {
    std::span<const std::byte> bytes;
    bool is_narrowed;

    std::size_t size() const { return is_narrowed ? bytes.size() / 2 : bytes.size(); }
  };
  std::size_t add_piece(const Piece& piece, BufferTarget target, std::size_t stride);

  Json json_;
  std::vector<Piece> pieces_;
  std::size_t size_ = 0;  // of the arrays, each filled up to four bytes
};

}  // namespace algebra3d::detail
