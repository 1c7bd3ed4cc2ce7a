#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "algebra3d/values/types/scalars.h"
#include "queries/store/detail/relation_layout.h"

namespace queries {

// Form of column chunks, as those know it who encode and who decode: docs/file_format.md, "Row groups".

/// The first byte of a chunk.
enum class ChunkForm : std::uint8_t { integers, reals, fixed, texts, words };
/// The flag, in the second byte, of a chunk with a mask of undefined values.
inline constexpr std::uint8_t kHasUndefined = 1;

inline bool is_integer(AttributeForm form) {
  return form == AttributeForm::integer || form == AttributeForm::boolean;
}

template <typename Number>
Number load_number(const char* from) {
  Number number;
  std::memcpy(&number, from, sizeof number);
  return number;
}

/// The least number of bytes, 0, 1, 2, 4 or 8, for numbers up to this one.
inline std::uint8_t width_for(std::uint64_t greatest) {
  if (greatest == 0) return 0;
  if (greatest <= UINT8_MAX) return 1;
  if (greatest <= UINT16_MAX) return 2;
  return greatest <= UINT32_MAX ? 4 : 8;
}

inline bool is_width(std::uint8_t width) {
  return width == 0 || width == 1 || width == 2 || width == 4 || width == 8;
}

inline void append_number(std::string& bytes, std::uint64_t number, std::uint8_t width) {
  bytes.append(reinterpret_cast<const char*>(&number), width);  // NOLINT(*-reinterpret-cast)
}

inline std::uint64_t number_at(const char* numbers, std::uint8_t width, std::size_t index) {
  switch (width) {
    case 1:
      return load_number<std::uint8_t>(numbers + index);
    case 2:
      return load_number<std::uint16_t>(numbers + 2 * index);
    case 4:
      return load_number<std::uint32_t>(numbers + 4 * index);
    case 8:
      return load_number<std::uint64_t>(numbers + 8 * index);
    default:
      return 0;
  }
}

/// Calls `visit(row, number)` for some rows; the width is chosen once.
template <typename Visit>
void for_each_number(const char* numbers, std::uint8_t width, std::size_t first, std::size_t count, Visit visit) {
  const auto all = [&]<typename Number>(Number /*kind*/) {
    const char* const from = numbers + sizeof(Number) * first;
    for (std::size_t i = 0; i < count; ++i) visit(i, std::uint64_t{load_number<Number>(from + sizeof(Number) * i)});
  };
  switch (width) {
    case 1:
      return all(std::uint8_t{});
    case 2:
      return all(std::uint16_t{});
    case 4:
      return all(std::uint32_t{});
    case 8:
      return all(std::uint64_t{});
    default:
      for (std::size_t i = 0; i < count; ++i) visit(i, std::uint64_t{0});
  }
}

inline algebra3d::Value text_value(const algebra3d::Type& type, std::string_view bytes) {
  if (&type == &algebra3d::TypeOf<algebra3d::Text>::type())
    return algebra3d::Value::of(algebra3d::Text{std::string(bytes)});
  return algebra3d::Value::of(std::string(bytes));
}

}  // namespace queries
