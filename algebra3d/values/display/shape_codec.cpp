#include "algebra3d/values/display/shape_codec.h"

#include <bit>
#include <cstring>
#include <type_traits>

namespace algebra3d {
namespace {

static_assert(std::endian::native == std::endian::little, "the stored form is little-endian");

constexpr std::uint32_t kMagicOfShapes = 0x53334189;  // 89 "A3S"
constexpr std::uint32_t kVersionOfShapes = 1;

/// Calls visit(field) for each field of a shape in the order of the stored form.
template <typename AnyShape, typename Visit>
void for_each_field(AnyShape& shape, const Visit& visit) {
  visit(shape.kind);
  visit(shape.box);
  visit(shape.origin);
  visit(shape.triangle_count);
  visit(shape.deviation);
  visit(shape.positions);
  visit(shape.normals);
  visit(shape.triangles);
  visit(shape.edges);
  visit(shape.boundary);
  visit(shape.nonmanifold);
  visit(shape.lines);
  visit(shape.points);
  visit(shape.face_ids);
  visit(shape.vertex_ids);
  visit(shape.tree);
}

class ShapeWriter {
 public:
  explicit ShapeWriter(std::string& bytes) : bytes_(bytes) {}

  template <typename T>
  void operator()(const T& number) const requires(std::is_trivially_copyable_v<T>) {
    append(&number, sizeof number);
  }
  void operator()(const std::optional<double>& number) const {
    (*this)(static_cast<std::uint64_t>(number.has_value()));
    (*this)(number.value_or(0));
  }
  template <typename List>
  void operator()(const List& elements) const requires(requires { elements.data(); }) {
    (*this)(static_cast<std::uint64_t>(elements.size()));
    append(elements.data(), elements.size() * sizeof(elements[0]));
  }

 private:
  void append(const void* from, std::size_t count) const {
    if (count > 0) bytes_.append(static_cast<const char*>(from), count);
  }

  std::string& bytes_;
};

class ShapeReader {
 public:
  explicit ShapeReader(std::string_view bytes) : bytes_(bytes) {}

  /// All bytes were read, and there were enough.
  bool is_done() const { return is_sound_ && bytes_.empty(); }

  template <typename T>
  void operator()(T& number) requires(std::is_trivially_copyable_v<T>) {
    take(&number, sizeof number);
  }
  void operator()(std::optional<double>& number) {
    std::uint64_t is_there = 0;
    double value = 0;
    (*this)(is_there);
    (*this)(value);
    if (is_there != 0) number = value;
  }
  template <typename List>
  void operator()(List& elements) requires(requires { elements.resize(1); }) {
    std::uint64_t count = 0;
    (*this)(count);
    is_sound_ = is_sound_ && count <= bytes_.size() / sizeof(elements[0]);
    if (!is_sound_) return;
    elements.resize(count);
    take(elements.data(), count * sizeof(elements[0]));
  }

 private:
  void take(void* to, std::size_t count) {
    is_sound_ = is_sound_ && count <= bytes_.size();
    if (!is_sound_ || count == 0) return;
    std::memcpy(to, bytes_.data(), count);
    bytes_.remove_prefix(count);
  }

  std::string_view bytes_;
  bool is_sound_ = true;
};

}  // namespace

std::string encode_shape(const DrawnShape& shape) {
  constexpr std::size_t kFixedFields = 300;
  std::string bytes;
  bytes.reserve(kFixedFields + content_bytes(shape));
  const ShapeWriter write(bytes);
  write(kMagicOfShapes);
  write(kVersionOfShapes);
  for_each_field(shape, write);
  return bytes;
}

Result<DrawnShape> decode_shape(std::string_view bytes) {
  std::uint32_t magic = 0, version = 0;
  ShapeReader read(bytes);
  read(magic);
  read(version);
  if (magic == kMagicOfShapes && version > kVersionOfShapes)
    return Error(ErrorCode::database_version, "a stored shape of version {}; this program reads version {}", version,
                 kVersionOfShapes);
  DrawnShape shape;
  for_each_field(shape, [&](auto& field) { read(field); });
  if (magic == kMagicOfShapes && version == kVersionOfShapes && read.is_done()) return shape;
  return Error(ErrorCode::database_corrupt, "a stored shape of {} bytes is not what was written", bytes.size());
}

}  // namespace algebra3d
