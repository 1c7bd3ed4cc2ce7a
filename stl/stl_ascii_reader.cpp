#include "stl/stl_ascii_reader.h"

#include <array>
#include <string>
#include <utility>

#include "base/ascii_cursor.h"
#include "base/padding.h"
#include "base/reading.h"
#include "base/soup_capacity.h"
#include "stl/solid_names.h"

namespace mesh_formats {

using algebra3d::AsciiCursor;
using algebra3d::counted;
using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::found_text;
using algebra3d::is_blank;
using algebra3d::Keyword;
using algebra3d::line_number;
using algebra3d::NumberKind;
using algebra3d::Result;
using algebra3d::TriangleSoup;
using algebra3d::trimmed;
using algebra3d::Vec3;

namespace {

constexpr Keyword kLoop("loop");
constexpr Keyword kVertex("vertex");
constexpr Keyword kEndloop("endloop");
constexpr Keyword kEndfacet("endfacet");

constexpr std::size_t kFacetsPerPoll = 65536;
// After so many facets the length of one is known well enough to reserve room for the rest.
constexpr std::size_t kFacetsForEstimate = 256;

/// The text between the numbers of a facet, as an earlier one had it. Nearly all files have the same in every facet, so
/// that one comparison takes the place of several words. Views of the file.
struct FacetLayout {
  std::string_view before_normal;                 // from behind `endfacet`, or where the facets of the solid begin
  std::array<std::string_view, 3> before_corner;  // from behind the number before
  std::string_view to_end;                        // behind `endfacet`
};

class AsciiReader : Reading {
 public:
  AsciiReader(std::string_view bytes, std::string_view file_name, const std::atomic<bool>* cancel)
      : Reading(bytes, file_name, cancel),
        cursor_(bytes.data(), bytes.data() + bytes.size()),
        names_(bytes.data(), bytes.data() + bytes.size()) {}

  Result<ReadStl> read() {
    if (bytes_.starts_with("\xef\xbb\xbf")) cursor_.move_to(bytes_.data() + 3);
    if (!read_solids()) return take_error();
    read_.format = Encoding::ascii;
    add_remarks();
    return std::move(read_);
  }

 private:
  bool read_solids() {
    for (;;) {
      cursor_.skip_space();
      if (read_.solid_count > 0 && (cursor_.is_at_end() || skip_padding())) return true;
      if (!cursor_.take(kSolid)) return fail_expected("'solid'");
      if (!read_solid()) return false;
    }
  }

  // Behind `solid`, up to the line of `endsolid`.
  bool read_solid() {
    const char* name_begin = cursor_.position();
    cursor_.move_to(names_.end_of_solid_name(name_begin));
    if (read_.solid_count++ == 0)
      read_.soup.name = trimmed({name_begin, static_cast<std::size_t>(cursor_.position() - name_begin)});
    const std::size_t first_facet = read_.soup.triangles.size();
    for (;;) {
      while (take_facet_as_before())
        if (is_cancelled_here()) return false;
      begin_gap();
      cursor_.skip_space();
      if (cursor_.take(kFacet)) {
        if (!read_facet()) return false;
      } else if (take_end(cursor_, kEndsolid, kSolid)) {
        cursor_.move_to(names_.end_of_endsolid_name(cursor_.position()));
        return true;
      } else if (cursor_.is_at(kSolid) || (cursor_.is_at_end() && read_.soup.triangles.size() > first_facet)) {
        ++missing_end_count_;
        return true;
      } else {
        return fail_expected("'facet' or 'endsolid'");
      }
    }
  }

  bool read_facet() {
    Vec3 normal;
    TriangleSoup::Triangle corners;
    cursor_.skip_space();
    const bool has_normal = !cursor_.is_at(kOuter);
    if (has_normal && !(expect(kNormal) && read_normal(normal))) return false;
    if (!(expect(kOuter) && expect(kLoop) && read_corner(corners, 0) && read_corner(corners, 1) &&
          read_corner(corners, 2) && expect_endloop() && expect_end(kEndfacet, kFacet)))
      return false;
    layout_.to_end = gap();
    if (!has_normal) {
      layout_ = {};
      ++missing_normal_count_;
    }
    add_facet(corners, normal);
    return !is_cancelled_here();
  }

  // The facet here, if the text between its numbers is that of an earlier one; else nothing is taken. All in one
  // function and with a cursor that is not a member, so that the place stays in a register.
  bool take_facet_as_before() {
    Vec3 normal;
    TriangleSoup::Triangle corners;
    AsciiCursor cursor = cursor_;
    if (layout_.to_end.empty() || !cursor.take_text(layout_.before_normal) || !cursor.take_plain_numbers(normal))
      return false;
    for (std::size_t i = 0; i < 3; ++i)
      if (!cursor.take_text(layout_.before_corner[i]) || !cursor.take_plain_numbers(corners[i])) return false;
    if (!cursor.take_text(layout_.to_end) || cursor.is_at_end() || !is_blank(*cursor.position())) return false;
    cursor_ = cursor;
    add_facet(corners, normal);
    return true;
  }

  void add_facet(const TriangleSoup::Triangle& corners, const Vec3& normal) {
    read_.soup.triangles.push_back(corners);
    read_.soup.normals.push_back(normal);
    if (read_.soup.triangles.size() == kFacetsForEstimate) reserve_rest();
  }
  bool is_cancelled_here() { return read_.soup.triangles.size() % kFacetsPerPoll == 0 && is_cancelled(); }

  void begin_gap() { gap_begin_ = cursor_.position(); }
  [[nodiscard]] std::string_view gap() const {
    return {gap_begin_, static_cast<std::size_t>(cursor_.position() - gap_begin_)};
  }

  bool read_normal(Vec3& normal) {
    cursor_.skip_space();
    layout_.before_normal = gap();
    bool finite = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cursor_.skip_space();
      const NumberKind kind = cursor_.take_number(normal[axis]);
      if (kind == NumberKind::none) return fail_expected("a number");
      finite = finite && kind == NumberKind::finite;
    }
    begin_gap();
    if (finite) [[likely]]
      return true;
    normal = Vec3{};
    ++bad_normal_count_;
    return true;
  }

  bool read_corner(TriangleSoup::Triangle& corners, std::size_t index) {
    if (!expect(kVertex)) return false;
    cursor_.skip_space();
    layout_.before_corner[index] = gap();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cursor_.skip_space();
      const char* number = cursor_.position();
      const NumberKind kind = cursor_.take_number(corners[index][axis]);
      if (kind != NumberKind::finite) [[unlikely]]
        return fail_coordinate(number, kind, index, axis);
    }
    begin_gap();
    return true;
  }

  bool fail_coordinate(const char* number, NumberKind kind, std::size_t corner, std::size_t axis) {
    if (kind == NumberKind::none) return fail_expected("a number");
    cursor_.move_to(number);
    const std::string_view expected =
        kind == NumberKind::too_large ? "a number within the range of double" : "a finite number";
    return fail(at_cursor(fmt::format("facet {}, corner {}: {} is {}; expected {}", facet_number(), corner + 1,
                                      "xyz"[axis], found_text(cursor_.rest()), expected)));
  }

  bool expect(const Keyword& keyword) {
    cursor_.skip_space();
    if (cursor_.take(keyword)) [[likely]]
      return true;
    return fail_expected(fmt::format("'{}'", keyword.text()));
  }

  bool expect_endloop() {
    cursor_.skip_space();
    if (!cursor_.is_at(kVertex)) [[likely]]
      return expect_end(kEndloop, kLoop);
    return fail(
        at_cursor(fmt::format("facet {} has more than 3 corners; expected 'endloop', found 'vertex'", facet_number())));
  }

  bool expect_end(const Keyword& joined, const Keyword& second) {
    cursor_.skip_space();
    if (take_end(cursor_, joined, second)) [[likely]]
      return true;
    return fail_expected(fmt::format("'{}'", joined.text()));
  }

  bool skip_padding() {
    const std::string_view rest = cursor_.rest();
    if (!is_padding(rest)) return false;
    read_.remarks.push_back(fmt::format("{} after the last solid ignored", counted(rest.size(), "trailing byte")));
    return true;
  }

  // An estimate that is too low costs a reallocation; it cannot exceed about the size of the file.
  void reserve_rest() {
    const auto taken = static_cast<std::size_t>(cursor_.position() - bytes_.data());
    const std::size_t rest = (bytes_.size() - taken) / (taken / kFacetsForEstimate);
    reserve_triangles(read_.soup, kFacetsForEstimate + rest + rest / 16);
  }

  void add_remarks() {
    if (missing_end_count_ > 0) read_.wrong_count = WrongCount{.missing_ends = missing_end_count_};
    if (missing_end_count_ == 1) read_.remarks.emplace_back("missing endsolid");
    if (missing_end_count_ > 1)
      read_.remarks.push_back(fmt::format("missing endsolid in {} solids", missing_end_count_));
    if (bad_normal_count_ > 0) read_.remarks.push_back(bad_normals_remark(bad_normal_count_));
    if (missing_normal_count_ > 0)
      read_.remarks.push_back(fmt::format("{} no normal", missing_normal_count_ == 1
                                                              ? "1 facet has"
                                                              : fmt::format("{} facets have", missing_normal_count_)));
  }

  [[nodiscard]] std::size_t facet_number() const { return read_.soup.triangles.size() + 1; }

  [[nodiscard]] Error at_cursor(std::string_view what) const {
    const auto offset = static_cast<std::size_t>(cursor_.position() - bytes_.data());
    return Error{ErrorCode::file_format, "byte {}, line {}: {}", offset, line_number(bytes_, offset), what}.about(
        file_name_);
  }
  bool fail_expected(std::string_view expected) {
    return fail(at_cursor(fmt::format("expected {}, found {}", expected, found_text(cursor_.rest()))));
  }

  AsciiCursor cursor_;
  SolidNames names_;
  FacetLayout layout_;
  const char* gap_begin_ = nullptr;  // where the text after the last number, or after the last facet, begins
  ReadStl read_;
  std::size_t missing_end_count_ = 0;
  std::size_t bad_normal_count_ = 0;
  std::size_t missing_normal_count_ = 0;
};

}  // namespace

Result<ReadStl> read_ascii(std::string_view bytes, std::string_view file_name, const std::atomic<bool>* cancel) {
  return AsciiReader(bytes, file_name, cancel).read();
}

}  // namespace mesh_formats
