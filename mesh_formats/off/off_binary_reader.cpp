#include "mesh_formats/off/off_binary_reader.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/padding.h"
#include "base/reading.h"
#include "base/soup_capacity.h"
#include "base/text.h"
#include "mesh_formats/off/off_attributes.h"
#include "mesh_formats/off/off_remarks.h"

namespace mesh_formats {

using algebra3d::counted;
using algebra3d::ErrorCode;
using algebra3d::Result;
using algebra3d::Vec3;

static_assert(std::endian::native == std::endian::little, "big-endian words are the ones that are turned");

namespace {

constexpr std::size_t kWordBytes = 4;
constexpr std::size_t kWordsPerPoll = 65536;
constexpr std::uint32_t kMostColourWords = 4;

struct OffLayout {
  bool is_big_endian = true;
  bool has_colour_counts = true;
};

/// How far a file agrees with a layout.
struct OffAgreement {
  bool fills_file = false;
  std::size_t words = 0;
};

/// The words of a binary file behind its header; an incomplete last word does not count.
class OffWords {
 public:
  OffWords(std::string_view bytes, bool is_big_endian) : bytes_(bytes), is_big_endian_(is_big_endian) {}

  [[nodiscard]] std::size_t count() const { return bytes_.size() / kWordBytes; }
  [[nodiscard]] std::uint32_t operator[](std::size_t index) const {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes_.data() + index * kWordBytes, kWordBytes);
    return is_big_endian_ ? __builtin_bswap32(word) : word;
  }
  [[nodiscard]] float real(std::size_t index) const { return std::bit_cast<float>((*this)[index]); }

 private:
  std::string_view bytes_;
  bool is_big_endian_;
};

class OffBinaryReader : Reading {
 public:
  OffBinaryReader(std::string_view bytes, const OffHeader& header, std::string_view file_name, Wanted wanted,
                  const std::atomic<bool>* cancel)
      : Reading(bytes, file_name, cancel), header_(header), layout_(likeliest_layout()), words_(words_of(layout_)) {
    if (wanted == Wanted::attributes) attributes_.emplace(header);
  }

  Result<ReadMesh> read() {
    if (!(read_counts() && read_vertices() && read_faces())) return take_error();
    if (!layout_.is_big_endian) read_.remarks.emplace_back("numbers are little-endian; the format has them big-endian");
    if (!layout_.has_colour_counts && face_count_ > 0)
      read_.remarks.emplace_back("faces lack the number of their colour floats");
    if (attributes_) {
      read_.soup.attributes = std::move(*attributes_).finish(read_.soup.face_count());
    } else {
      ignored_.normals = header_.has_normals ? vertex_count_ : 0;
      ignored_.vertex_colours = header_.has_colours ? vertex_count_ : 0;
      ignored_.texture_coordinates = header_.has_texture_coordinates ? vertex_count_ : 0;
    }
    add_remarks(ignored_, read_);
    if (const std::size_t rest = bytes_.size() - offset_of(next_); rest > 0) {
      read_.remarks.push_back(fmt::format("{} after the last face ignored", counted(rest, "trailing byte")));
      if (!is_padding(bytes_.substr(offset_of(next_)))) read_.unread.push_back(read_.remarks.back());
    }
    return std::move(read_);
  }

 private:
  [[nodiscard]] OffWords words_of(const OffLayout& layout) const {
    return {bytes_.substr(header_.bytes), layout.is_big_endian};
  }
  [[nodiscard]] std::size_t first_count() const { return header_.has_dimension ? 1 : 0; }
  [[nodiscard]] std::size_t words_per_vertex() const {
    return 3U + (header_.has_weights ? 1U : 0U) + (header_.has_normals ? 3U : 0U) + (header_.has_colours ? 4U : 0U) +
           (header_.has_texture_coordinates ? 2U : 0U);
  }

  [[nodiscard]] OffLayout likeliest_layout() const {
    const OffLayout big{true, true};
    const OffLayout little{false, true};
    const OffAgreement with_big = agreement(big);
    if (with_big.fills_file) return big;
    if (const OffLayout plain{true, false}; agreement(plain).fills_file) return plain;
    const OffAgreement with_little = agreement(little);
    if (with_little.fills_file) return little;
    if (const OffLayout plain{false, false}; agreement(plain).fills_file) return plain;
    return with_little.words > with_big.words ? little : big;
  }

  [[nodiscard]] OffAgreement agreement(const OffLayout& layout) const {
    const OffWords words = words_of(layout);
    const std::size_t count = words.count();
    const std::size_t begin = first_count();
    if (count < begin + 3 || (header_.has_dimension && words[0] != 3)) return {};
    const std::uint32_t vertex_count = words[begin];
    const std::uint32_t face_count = words[begin + 1];
    if (vertex_count > (count - begin - 3) / words_per_vertex()) return {};
    std::size_t next = begin + 3 + vertex_count * words_per_vertex();
    if (face_count > count - next) return {};
    for (std::uint32_t face = 0; face < face_count; ++face) {
      const std::size_t face_begin = next;
      if (next == count || words[next] >= count - next) return {false, face_begin};
      // In a file that was cut, 0 colour floats are not a face.
      if (!layout.has_colour_counts && words[next] < 3) return {false, face_begin};
      const std::size_t face_end = next + 1 + words[next];
      for (++next; next < face_end; ++next)
        if (words[next] >= vertex_count) return {false, face_begin};
      if (!layout.has_colour_counts) continue;
      if (next == count || words[next] > kMostColourWords || words[next] >= count - next) return {false, face_begin};
      next += 1 + words[next];
    }
    return {offset_of(next) == bytes_.size(), next};
  }

  bool read_counts() {
    next_ = first_count();
    if (words_.count() < next_ + 3)
      return fail_at(words_.count(), "the file ends; expected the numbers of vertices, faces and edges");
    if (header_.has_dimension && words_[0] != 3)
      return fail_at(0, fmt::format("the dimension of the space is {}; expected 3", words_[0]));
    vertex_count_ = words_[next_];
    face_count_ = words_[next_ + 1];
    next_ += 3;
    const std::size_t words = words_.count() - next_;
    if (vertex_count_ > words / words_per_vertex())
      return fail_at(first_count(), fmt::format("{} vertices announced ({} bytes), but {} bytes follow", vertex_count_,
                                                vertex_count_ * words_per_vertex() * kWordBytes, words * kWordBytes));
    if (face_count_ > words - vertex_count_ * words_per_vertex())
      return fail_at(first_count() + 1, fmt::format("{} faces announced, but {} bytes follow the vertices", face_count_,
                                                    (words - vertex_count_ * words_per_vertex()) * kWordBytes));
    return true;
  }

  bool read_vertices() {
    auto& points = read_.soup.points;
    reserve_points(read_.soup, vertex_count_);
    for (; points.size() < vertex_count_; next_ += words_per_vertex()) {
      Vec3 point;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        point[axis] = words_.real(next_ + axis);
        if (!std::isfinite(point[axis])) [[unlikely]]
          return fail_at(next_ + axis, fmt::format("vertex {} of {}: {} is {}; expected a finite number",
                                                   points.size() + 1, vertex_count_, "xyz"[axis], point[axis]));
      }
      if (header_.has_weights && words_.real(next_ + 3) != 1)
        return fail_at(next_ + 3, fmt::format("vertex {} of {}: the weight is {}; expected 1", points.size() + 1,
                                              vertex_count_, words_.real(next_ + 3)));
      points.push_back(point);
      if (attributes_) {
        const std::size_t begin = next_ + 3 + (header_.has_weights ? 1 : 0);
        attributes_->add_vertex(reals(begin, next_ + words_per_vertex()));
      }
      if (points.size() % kWordsPerPoll == 0 && is_cancelled()) return false;
    }
    return true;
  }

  // Attributes; those that are not finite count as none.
  [[nodiscard]] std::vector<double> reals(std::size_t begin, std::size_t end) const {
    std::vector<double> numbers;
    for (std::size_t i = begin; i < end; ++i) {
      const double number = words_.real(i);
      numbers.push_back(std::isfinite(number) ? number : std::numeric_limits<double>::quiet_NaN());
    }
    return numbers;
  }

  bool read_faces() {
    const std::size_t words = words_.count() - next_;
    reserve_faces(read_.soup, face_count_, words - face_count_);
    for (; face_index_ < face_count_; ++face_index_)
      if (!read_face() || ((face_index_ + 1) % kWordsPerPoll == 0 && is_cancelled())) return false;
    return true;
  }

  bool read_face() {
    auto& corners = read_.soup.corners;
    if (next_ == words_.count()) return fail_in_face("the file ends; expected the number of corners");
    const std::uint32_t degree = words_[next_];
    if (degree >= words_.count() - next_)
      return fail_in_face(
          fmt::format("{} corners announced, but {} bytes follow", degree, (words_.count() - next_ - 1) * kWordBytes));
    const std::size_t begin = next_ + 1;
    for (std::uint32_t corner = 0; corner < degree; ++corner) {
      const std::uint32_t index = words_[begin + corner];
      if (index >= vertex_count_)
        return fail_at(begin + corner,
                       off_index_message(face_index_ + 1, face_count_, corner + 1, index, vertex_count_));
      if (degree >= 3) corners.push_back(index);
    }
    if (corners.size() > std::numeric_limits<std::uint32_t>::max())
      return fail(
          algebra3d::Error{ErrorCode::limit_exceeded, "more than 4294967295 corners of faces"}.about(file_name_));
    if (degree < 3)
      ++ignored_.short_faces;
    else
      read_.soup.face_starts.push_back(static_cast<std::uint32_t>(corners.size()));
    next_ = begin + degree;
    return !layout_.has_colour_counts || read_colour(degree >= 3);
  }

  bool read_colour(bool has_face) {
    if (next_ == words_.count()) return fail_in_face("the file ends; expected the number of colour floats");
    const std::uint32_t count = words_[next_];
    if (count > kMostColourWords)
      return fail_in_face(fmt::format("{} colour floats announced; expected at most 4", count));
    if (count >= words_.count() - next_)
      return fail_in_face(fmt::format("{} colour floats announced, but {} bytes follow", count,
                                      (words_.count() - next_ - 1) * kWordBytes));
    const bool is_colour = attributes_ && count >= 3;
    if (count > 0 && !is_colour) ++ignored_.face_colours;
    if (is_colour && has_face)
      attributes_->set_face_colour(read_.soup.face_count() - 1, reals(next_ + 1, next_ + 1 + count));
    next_ += 1 + count;
    return true;
  }

  [[nodiscard]] std::size_t offset_of(std::size_t word) const { return header_.bytes + word * kWordBytes; }

  bool fail_in_face(std::string_view what) {
    return fail_at(next_, fmt::format("face {} of {}: {}", face_index_ + 1, face_count_, what));
  }
  bool fail_at(std::size_t word, std::string_view what) {
    return fail(algebra3d::Error{ErrorCode::file_format, "byte {}: {}", offset_of(word), what}.about(file_name_));
  }

  OffHeader header_;
  OffLayout layout_;
  OffWords words_;
  ReadMesh read_;
  IgnoredInOff ignored_;
  std::size_t vertex_count_ = 0;
  std::size_t face_count_ = 0;
  std::size_t face_index_ = 0;
  std::size_t next_ = 0;                     // the word to be read next
  std::optional<OffAttributes> attributes_;  // nothing if they are not wanted
};

}  // namespace

Result<ReadMesh> read_binary_off(std::string_view bytes, const OffHeader& header, std::string_view file_name,
                                 Wanted wanted, const std::atomic<bool>* cancel) {
  return OffBinaryReader(bytes, header, file_name, wanted, cancel).read();
}

}  // namespace mesh_formats
