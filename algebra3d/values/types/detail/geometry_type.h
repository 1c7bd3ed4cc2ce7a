#pragma once

#include <string>
#include <utility>

#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/detail/geometry.h"
#include "algebra3d/values/types/detail/mesh_codec.h"
#include "algebra3d/values/types/spatial.h"
#include "algebra3d/values/types/value_text.h"
#include "base/propagate.h"

namespace algebra3d {

/// The common base of the types surface3d and volume3d: class T has a mesh that `T::prove` accepted.
template <typename T>
class GeometryType : public DescribedType, public DirectText {
 public:
  Result<Value> from_nested(const NestedList& list, Context& context) const override {
    A3D_ASSIGN(auto mesh, mesh_from_nested(list, name()));
    A3D_ASSIGN(auto proved, T::prove(std::move(mesh), {.cancel = context.cancel}));
    if (proved) return Value::of(std::move(proved).value());
    context.diagnostics.report_undefined(proved.reason(), list.print_short());
    return Value(*this);
  }
  NestedList to_nested(const Value& value) const override { return mesh_to_nested(value.get<T>().mesh()); }

  void append_text(const Value& value, std::string& text) const override {
    append_mesh_text(value.get<T>().mesh(), text);
  }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    return compare_point_sets(a.get<T>().geometry(), b.get<T>().geometry(), orientation_);
  }
  std::size_t hash(const Value& value) const override {
    return hash_point_set(value.get<T>().geometry(), orientation_);
  }

  std::size_t heap_bytes(const Value& value) const override {
    return object_bytes<T>() + object_bytes<Geometry>() + value.get<T>().mesh().heap_bytes();
  }

  GeometryHeader header(const Value& value) const override {
    const T& content = value.get<T>();
    return {content.box(), static_cast<std::uint32_t>(content.mesh().face_count())};
  }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter writer(bytes);
    write_mesh(writer, value.get<T>().mesh());
  }
  Result<Value> decode(std::string_view bytes, bool trusted) const override {
    ByteReader reader(bytes, name());
    TriangleMesh mesh = read_mesh(reader);
    A3D_TRY(reader.finish());
    if (trusted) return Value::of(T::trusted(std::move(mesh)));
    // The proof requires that points with different indices are distinct.
    if (has_equal_points(mesh)) return corrupt("expected points that differ from each other");
    A3D_ASSIGN(auto proved, T::prove(std::move(mesh), {.thoroughness = Thoroughness::first_defect}));
    if (!proved) return Error{ErrorCode::database_corrupt, "{}", proved.reason()};
    return Value::of(std::move(proved).value());
  }

 protected:
  GeometryType(Description description, Orientation orientation)
      : DescribedType(std::move(description)), orientation_(orientation) {}

 private:
  Orientation orientation_;
};

}  // namespace algebra3d
