#include <array>
#include <optional>

#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/detail/codec_points.h"
#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"

namespace algebra3d {

namespace {

using Quadruple = std::array<double, 4>;  // d, nx, ny, nz

constexpr std::string_view kZeroNormal = "the normal is zero";

Vec3 normal_of(const Quadruple& quadruple) {
  return {quadruple[1], quadruple[2], quadruple[3]};
}

// The foot of the perpendicular from the origin.
RationalVec3 nearest_to_origin(const ExactPlane& plane) {
  return plane.offset / dot(plane.normal, plane.normal) * plane.normal;
}

// Nothing for a zero normal, or for a plane that is farther away than any double.
std::optional<Plane3d> plane_from(const Quadruple& quadruple) {
  auto plane = ExactPlane::from_distance(quadruple[0], normal_of(quadruple));
  if (!plane) return std::nullopt;
  auto point = nearest_to_origin(*plane);
  return Plane3d{*std::move(plane), std::move(point), std::make_shared<const Quadruple>(quadruple)};
}

std::optional<Plane3d> plane_from(RationalVec3 point, const RationalVec3& normal) {
  auto plane = ExactPlane::through(point, normal);
  if (!plane) return std::nullopt;
  return Plane3d{*std::move(plane), std::move(point), nullptr};
}

class Plane3dType final : public DescribedType {
 public:
  Plane3dType()
      : DescribedType({.name = "plane3d",
                       .doc = "An oriented plane; the normal points to its positive side.",
                       .notation = "(d nx ny nz) with d the distance from the origin along the normal, "
                                   "or ((px py pz) (nx ny nz)) with a point of the plane",
                       .example = "(2.0 0.0 0.0 1.0)",
                       .kinds = {Kind::data},
                       .coordinates = Coordinates::plane}) {}

  Result<Value> from_nested(const NestedList& list, Context& context) const override {
    const auto length = list.is_list() ? list.elements().size() : 0;
    if (length == 4) return from_quadruple(list, context);
    if (length == 2) return from_point_and_normal(list, context);
    return expected("(d nx ny nz) or ((px py pz) (nx ny nz))", list);
  }

  NestedList to_nested(const Value& value) const override {
    const auto& plane = value.get<Plane3d>();
    if (plane.quadruple == nullptr) {
      return NestedList::list(triple_to_nested(plane.point), triple_to_nested(plane.plane.normal));
    }
    NestedList::List elements;
    for (const double number : *plane.quadruple) elements.emplace_back(number);
    return NestedList(std::move(elements));
  }

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    const auto plane_a = value_plane(a).canonical();
    const auto plane_b = value_plane(b).canonical();
    const auto order = plane_a.normal <=> plane_b.normal;
    return std::is_neq(order) ? order : plane_a.offset <=> plane_b.offset;
  }
  std::size_t hash(const Value& value) const override {
    const auto plane = value_plane(value).canonical();
    std::size_t result = plane.offset.hash();
    for (std::size_t axis = 0; axis < 3; ++axis) result = combine_hashes(result, plane.normal[axis].hash());
    return result;
  }

  std::size_t heap_bytes(const Value& /*value*/) const override {
    return object_bytes<Plane3d>() + object_bytes<Quadruple>();
  }

  void encode(const Value& value, std::string& bytes) const override;
  Result<Value> decode(std::string_view bytes, bool trusted) const override;

 private:
  static const ExactPlane& value_plane(const Value& value) { return value.get<Plane3d>().plane; }

  Result<Value> from_quadruple(const NestedList& list, Context& context) const {
    Quadruple quadruple{};
    for (std::size_t i = 0; i < quadruple.size(); ++i) {
      A3D_ASSIGN(quadruple[i], double_from_nested(list.elements()[i], name()));
    }
    if (auto plane = plane_from(quadruple)) return Value::of(*std::move(plane));
    const bool is_zero = normal_of(quadruple) == Vec3{};
    return undefined(is_zero ? kZeroNormal : "distance and normal together are beyond the range of real", list,
                     context);
  }

  Result<Value> from_point_and_normal(const NestedList& list, Context& context) const {
    A3D_ASSIGN(auto point, triple_from_nested(list.elements()[0], "plane3d: point"));
    A3D_ASSIGN(auto normal, triple_from_nested(list.elements()[1], "plane3d: normal"));
    if (auto plane = plane_from(std::move(point), normal)) return Value::of(*std::move(plane));
    return undefined(kZeroNormal, list, context);
  }
};

enum class Form : std::uint8_t { quadruple, point_and_normal };

void Plane3dType::encode(const Value& value, std::string& bytes) const {
  const auto& plane = value.get<Plane3d>();
  ByteWriter writer(bytes);
  if (plane.quadruple != nullptr) {
    writer.u8(static_cast<std::uint8_t>(Form::quadruple));
    for (const double number : *plane.quadruple) writer.f64(number);
    return;
  }
  writer.u8(static_cast<std::uint8_t>(Form::point_and_normal));
  for (std::size_t axis = 0; axis < 3; ++axis) write_rational(writer, plane.point[axis]);
  for (std::size_t axis = 0; axis < 3; ++axis) write_rational(writer, plane.plane.normal[axis]);
}

Quadruple read_quadruple(ByteReader& reader) {
  Quadruple quadruple{};
  for (double& number : quadruple) number = reader.f64();
  return quadruple;
}

RationalVec3 read_triple(ByteReader& reader) {
  auto x = read_rational(reader);
  auto y = read_rational(reader);
  auto z = read_rational(reader);
  return {std::move(x), std::move(y), std::move(z)};
}

Result<Value> Plane3dType::decode(std::string_view bytes, bool /*trusted*/) const {
  ByteReader reader(bytes, name());
  const auto form = reader.u8();
  std::optional<Plane3d> plane;
  if (form == static_cast<std::uint8_t>(Form::quadruple)) {
    plane = plane_from(read_quadruple(reader));
  } else if (form == static_cast<std::uint8_t>(Form::point_and_normal)) {
    auto point = read_triple(reader);
    plane = plane_from(std::move(point), read_triple(reader));
  } else {
    reader.fail("0 (quadruple) or 1 (point and normal)");
  }
  reader.require(plane.has_value(), "a normal that is not zero, and finite numbers");
  A3D_TRY(reader.finish());
  return Value::of(*std::move(plane));
}

}  // namespace

const Type& TypeOf<Plane3d>::type() {
  static const Plane3dType the_type;
  return the_type;
}

}  // namespace algebra3d
