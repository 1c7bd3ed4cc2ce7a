#include <mutex>
#include <string>
#include <vector>

#include "algebra3d/kernel/planar/boundary_polygons.h"
#include "algebra3d/kernel/planar/polygon_validity.h"
#include "algebra3d/values/types/coordinate_text.h"
#include "algebra3d/values/types/described_type.h"
#include "algebra3d/values/types/detail/polygons_codec.h"
#include "algebra3d/values/types/planar.h"
#include "base/interruption_scope.h"
#include "base/propagate.h"

namespace algebra3d {

struct Region::Content {
  Polygons polygons;
  Box3 box;
  mutable std::once_flag once = {};
  mutable Polygons canonical = {};

  Content(Polygons cycles, const Box3& bounds) : polygons(std::move(cycles)), box(bounds) {}
};

namespace {

class RegionType final : public DescribedType {
 public:
  RegionType()
      : DescribedType({.name = "region",
                       .doc = "Faces with holes in the plane, bounded by straight segments with exact coordinates.",
                       .notation = "(face*), face = (outer hole*), cycle = ((x y)+) with at least 3 corners",
                       .example = "((((0 0) (4 0) (4 4)) ((2 1) (3 1) (3 2))))",
                       .kinds = {Kind::data, Kind::spatial2d},
                       .is_large = true}) {}

  Result<Value> from_nested(const NestedList& list, Context& context) const override {
    A3D_ASSIGN(const Polygons polygons, polygons_from(list));
    A3D_ASSIGN(const auto region, Region::prove(polygons, context.monitor()));
    if (!region) return undefined(region.reason(), list, context);
    return Value::of(*region);
  }
  NestedList to_nested(const Value& value) const override;

  std::strong_ordering compare(const Value& a, const Value& b) const override {
    return a.get<Region>().canonical() <=> b.get<Region>().canonical();
  }
  std::size_t hash(const Value& value) const override {
    const Polygons& polygons = value.get<Region>().canonical();
    std::size_t result = polygons.face_ends.size();
    for (std::size_t i = 0; i < polygons.corners.size(); ++i) {
      poll_interruption_at(i);
      result = combine_hashes(result, polygons.corners.point(i).hash());
    }
    return result;
  }

  std::size_t heap_bytes(const Value& value) const override { return value.get<Region>().heap_bytes(); }

  GeometryHeader header(const Value& value) const override {
    const auto& region = value.get<Region>();
    return {region.box(), static_cast<std::uint32_t>(region.polygons().corners.size())};
  }

  void encode(const Value& value, std::string& bytes) const override;
  Result<Value> decode(std::string_view bytes, bool trusted) const override;

 private:
  Result<Polygons> polygons_from(const NestedList& list) const;
  Status add_face(const NestedList& face, Polygons& polygons) const;
};

Status RegionType::add_face(const NestedList& face, Polygons& polygons) const {
  if (!face.is_list() || face.elements().empty()) return expected("a face (outer hole*)", face);
  for (const NestedList& cycle : face.elements()) {
    if (!cycle.is_list() || cycle.elements().size() < 3)
      return expected("a cycle of at least 3 corners ((x y) (x y) (x y) ...)", cycle);
    for (const NestedList& corner : cycle.elements()) {
      A3D_ASSIGN(const ExactPoint point, planar_point_from_nested(corner, name()));
      polygons.corners.push_back(point);
    }
    polygons.cycle_ends.push_back(static_cast<std::uint32_t>(polygons.corners.size()));
  }
  polygons.face_ends.push_back(static_cast<std::uint32_t>(polygons.cycle_ends.size()));
  return {};
}

Result<Polygons> RegionType::polygons_from(const NestedList& list) const {
  if (!list.is_list()) return expected(notation(), list);
  Polygons polygons;
  for (const NestedList& face : list.elements()) A3D_TRY(add_face(face, polygons));
  return polygons;
}

NestedList RegionType::to_nested(const Value& value) const {
  const Polygons& polygons = value.get<Region>().polygons();
  NestedList::List faces;
  for (std::size_t f = 0; f < polygons.face_count(); ++f) {
    poll_interruption_at(f);
    NestedList::List cycles;
    for (std::uint32_t c = polygons.first_cycle(f); c < polygons.face_ends[f]; ++c) {
      NestedList::List corners;
      for (std::uint32_t i = polygons.first_corner(c); i < polygons.cycle_ends[c]; ++i)
        corners.push_back(planar_point_to_nested(polygons.corners[i]));
      cycles.emplace_back(std::move(corners));
    }
    faces.emplace_back(std::move(cycles));
  }
  return NestedList(std::move(faces));
}

void RegionType::encode(const Value& value, std::string& bytes) const {
  ByteWriter writer(bytes);
  write_polygons(writer, value.get<Region>().polygons());
}

Result<Value> RegionType::decode(std::string_view bytes, bool trusted) const {
  ByteReader reader(bytes, name());
  Polygons polygons = read_polygons(reader);
  A3D_TRY(reader.finish());
  if (trusted) return Value::of(Region::trusted(std::move(polygons)));
  if (!is_in_plane(polygons.corners)) return corrupt("expected corners in the plane");
  A3D_ASSIGN(const auto region, Region::prove(polygons));
  if (!region) return Error{ErrorCode::database_corrupt, "{}: {}", name(), region.reason()};
  return Value::of(*region);
}

}  // namespace

Region::Region() {
  // All empty values share one content.
  static const auto empty = std::make_shared<const Content>(Polygons(), Box3());
  content_ = empty;
}

Result<Maybe<Region>> Region::prove(const Polygons& polygons, const Monitor& monitor) {
  A3D_ASSIGN(auto defect, polygon_defect(polygons, monitor));
  if (defect) return Maybe<Region>(Undefined{*std::move(defect)});
  return Maybe<Region>(trusted(oriented(polygons)));
}

Region Region::trusted(Polygons polygons) {
  const Box3 box = box_around(polygons);
  return Region(std::make_shared<const Content>(std::move(polygons), box));
}

const Polygons& Region::polygons() const {
  return content_->polygons;
}

const Box3& Region::box() const {
  return content_->box;
}

const Polygons& Region::canonical() const {
  std::call_once(content_->once, [&] { content_->canonical = *boundary_polygons(content_->polygons); });
  return content_->canonical;
}

std::size_t Region::heap_bytes() const {
  return object_bytes<Region>() + object_bytes<Content>() + content_->polygons.heap_bytes();
}

const Type& TypeOf<Region>::type() {
  static const RegionType the_type;
  return the_type;
}

}  // namespace algebra3d
