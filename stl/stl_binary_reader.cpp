#include "stl/stl_binary_reader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "base/file_error.h"
#include "base/propagate.h"
#include "base/soup_capacity.h"
#include "base/text.h"

namespace mesh_formats {

using algebra3d::counted;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::interrupted_reading;
using algebra3d::is_blank;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::TriangleSoup;
using algebra3d::trimmed;
using algebra3d::Vec3;

static_assert(std::endian::native == std::endian::little, "facets are copied as the file has them");

namespace {

// Facets are converted in blocks that fit into the second-level cache: making room in the vectors writes zeros, which
// then never reach memory.
constexpr std::size_t kBlockFacets = 2048;
constexpr std::size_t kBlocksPerPoll = 32;

using Floats = std::array<float, 12>;

template <std::endian kOrder>
Floats floats_of(const char* facet) {
  Floats floats;
  std::memcpy(floats.data(), facet, sizeof floats);
  if constexpr (kOrder == std::endian::big)
    for (float& value : floats) value = std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
  return floats;
}

// Sign bit set exactly if the float is NaN or infinite.
std::uint32_t not_finite_mark(float value) {
  return (std::bit_cast<std::uint32_t>(value) & 0x7fffffffU) + 0x00800000U;
}

class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, std::string_view file_name) : bytes_(bytes), file_name_(file_name) {}

  Result<ReadStl> read(const std::atomic<bool>* cancel) {
    A3D_ASSIGN(const std::size_t facet_count, settle_facet_count());
    read_.soup.name = header_name();
    reserve_triangles(read_.soup, facet_count);
    std::size_t block = 0;
    for (std::size_t first = 0; first < facet_count; first += kBlockFacets, ++block) {
      if (cancel != nullptr && block % kBlocksPerPoll == 0 && cancel->load(std::memory_order_relaxed))
        return interrupted_reading(file_name_);
      const std::size_t count = std::min(kBlockFacets, facet_count - first);
      A3D_TRY(is_big_endian_ ? read_block<std::endian::big>(first, count)
                             : read_block<std::endian::little>(first, count));
    }
    read_.format = Encoding::binary;
    read_.solid_count = 1;
    add_remarks();
    return std::move(read_);
  }

 private:
  Result<std::size_t> settle_facet_count() {
    const std::size_t announced = announced_facet_count(bytes_);
    const std::size_t behind = bytes_.size() - kBinaryPrefixBytes;
    const std::size_t whole = behind / kBinaryFacetBytes;
    const std::size_t rest = behind % kBinaryFacetBytes;
    if (announced == whole && rest == 0) return announced;
    if (is_big_endian(bytes_, bytes_.size())) {
      is_big_endian_ = true;
      remark("the numbers are big-endian; they are read as that");
      return whole;
    }
    if (rest == 0 && whole > 0) {
      read_.wrong_count = WrongCount{announced, whole, whole};
      remark(fmt::format("header announces {}, file has {}: all in the file are read", counted(announced, "triangle"),
                         whole));
      return whole;
    }
    if (whole < announced)
      return Error{ErrorCode::file_format,
                   "byte {}: header announces {} ({} bytes), file has {} bytes",
                   kBinaryPrefixBytes,
                   counted(announced, "triangle"),
                   kBinaryPrefixBytes + announced * kBinaryFacetBytes,
                   bytes_.size()}
          .about(file_name_);
    if (announced == 0 && whole > 0)
      return Error{ErrorCode::file_format,
                   "byte 80: header announces 0 triangles, but {} bytes follow; expected none or a multiple "
                   "of {}",
                   behind, kBinaryFacetBytes}
          .about(file_name_);
    const std::size_t trailing = behind - announced * kBinaryFacetBytes;
    read_.wrong_count = WrongCount{announced, whole, announced};
    if (whole == announced) read_.wrong_count->trailing_bytes = trailing;
    remark(fmt::format("{} after the last facet ignored", counted(trailing, "trailing byte")));
    return announced;
  }

  [[nodiscard]] std::string header_name() const {
    std::string_view header = bytes_.substr(0, kBinaryHeaderBytes);
    header = trimmed(header.substr(0, header.find('\0')));
    const std::string_view keyword = header.substr(0, 5);
    const bool is_solid = std::equal(keyword.begin(), keyword.end(), "solid",
                                     [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
    if (is_solid && keyword.size() == 5 && (header.size() == 5 || is_blank(header[5])))
      header = trimmed(header.substr(5));
    return std::string(header);
  }

  // The hot loop: no branches per facet; the defect of a block is searched for afterwards.
  template <std::endian kOrder>
  Status read_block(std::size_t first, std::size_t count) {
    read_.soup.triangles.resize(first + count);
    read_.soup.normals.resize(first + count);
    TriangleSoup::Triangle* triangles = read_.soup.triangles.data() + first;
    Vec3* normals = read_.soup.normals.data() + first;
    std::uint32_t marks = 0;
    std::size_t attribute_count = 0;
    const char* facet = bytes_.data() + kBinaryPrefixBytes + first * kBinaryFacetBytes;
    for (std::size_t i = 0; i < count; ++i, facet += kBinaryFacetBytes) {
      const Floats f = floats_of<kOrder>(facet);
      for (const float value : f) marks |= not_finite_mark(value);
      normals[i] = {f[0], f[1], f[2]};
      triangles[i] = {Vec3{f[3], f[4], f[5]}, Vec3{f[6], f[7], f[8]}, Vec3{f[9], f[10], f[11]}};
      attribute_count += static_cast<std::size_t>((facet[48] | facet[49]) != 0);
    }
    attribute_count_ += attribute_count;
    if ((marks & 0x80000000U) == 0) return {};
    return settle_not_finite(first, count);
  }

  Status settle_not_finite(std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vec3& v = read_.soup.triangles[i][corner];
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (!std::isfinite(v[axis])) return not_finite(i, corner, axis, v[axis]);
      }
      if (!is_finite(read_.soup.normals[i])) {
        read_.soup.normals[i] = Vec3{};
        ++bad_normal_count_;
      }
    }
    return {};
  }

  [[nodiscard]] Error not_finite(std::size_t facet, std::size_t corner, std::size_t axis, double value) const {
    const std::size_t byte = kBinaryPrefixBytes + facet * kBinaryFacetBytes + 12 * (corner + 1) + 4 * axis;
    return Error{ErrorCode::file_format,
                 "byte {}: facet {}, corner {}: {} is {}; expected a finite number",
                 byte,
                 facet + 1,
                 corner + 1,
                 "xyz"[axis],
                 std::isnan(value) ? "nan" : (value > 0 ? "inf" : "-inf")}
        .about(file_name_);
  }

  void add_remarks() {
    if (attribute_count_ > 0)
      remark(fmt::format("{} attribute bytes, which are ignored",
                         attribute_count_ == 1 ? "1 facet carries" : fmt::format("{} facets carry", attribute_count_)));
    if (bad_normal_count_ > 0) remark(bad_normals_remark(bad_normal_count_));
  }

  void remark(std::string text) { read_.remarks.push_back(std::move(text)); }

  std::string_view bytes_;
  std::string_view file_name_;
  ReadStl read_;
  bool is_big_endian_ = false;
  std::size_t attribute_count_ = 0;
  std::size_t bad_normal_count_ = 0;
};

}  // namespace

std::size_t announced_facet_count(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kBinaryHeaderBytes, sizeof count);
  return count;
}

bool has_announced_size(std::string_view head, std::size_t size) {
  return head.size() >= kBinaryPrefixBytes &&
         size == kBinaryPrefixBytes + announced_facet_count(head) * kBinaryFacetBytes;
}

bool is_big_endian(std::string_view head, std::size_t size) {
  if (head.size() < kBinaryPrefixBytes || size == kBinaryPrefixBytes || has_announced_size(head, size)) return false;
  const std::size_t swapped = __builtin_bswap32(static_cast<std::uint32_t>(announced_facet_count(head)));
  return size == kBinaryPrefixBytes + swapped * kBinaryFacetBytes;
}

Result<ReadStl> read_binary(std::string_view bytes, std::string_view file_name, const std::atomic<bool>* cancel) {
  return BinaryReader(bytes, file_name).read(cancel);
}

}  // namespace mesh_formats
