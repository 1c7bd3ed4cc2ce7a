#pragma once

#include <string>
#include <utility>

#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/detail/codec_points.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {

/// The common base of the types point3d and vector3d: class T has one exact triple.
template <typename T, ExactPoint T::*kTriple>
class ExactTripleType : public DescribedType {
 public:
  Result<Value> from_nested(const NestedList& list, Context& /*context*/) const override {
    A3D_ASSIGN(auto triple, point_from_nested(list, name()));
    return Value::of(T{std::move(triple)});
  }
  NestedList to_nested(const Value& value) const override { return point_to_nested(triple_of(value)); }

  std::strong_ordering compare(const Value& a, const Value& b) const override { return triple_of(a) <=> triple_of(b); }
  std::size_t hash(const Value& value) const override { return triple_of(value).hash(); }
  std::size_t heap_bytes(const Value& value) const override {
    return object_bytes<T>() + (triple_of(value).is_double() ? 0 : object_bytes<RationalVec3>());
  }

  void encode(const Value& value, std::string& bytes) const override {
    ByteWriter writer(bytes);
    write_point(writer, triple_of(value));
  }
  Result<Value> decode(std::string_view bytes, bool /*trusted*/) const override {
    ByteReader reader(bytes, name());
    auto triple = read_point(reader);
    A3D_TRY(reader.finish());
    return Value::of(T{std::move(triple)});
  }

 protected:
  explicit ExactTripleType(Description description) : DescribedType(std::move(description)) {}

 private:
  static const ExactPoint& triple_of(const Value& value) { return value.get<T>().*kTriple; }
};

}  // namespace algebra3d
