#include "algebra3d/values/measures/ray_hits.h"

#include <array>
#include <optional>
#include <utility>

#include "algebra3d/values/measures/detail/ray_sections.h"
#include "algebra3d/values/spatial_relations/point_location.h"

namespace algebra3d {
namespace {

/// A hit whose kind is to be found, and its sections.
struct OpenHit {
  RayHit hit;
  std::size_t section_count = 0;
  int sign = 0;                // of all sections, if they agree
  bool do_signs_agree = true;  // on a sign that is not 0
};

/// Joins sections that meet each other.
std::vector<OpenHit> joined(const Ray& ray, std::vector<RaySection> sections) {
  std::vector<OpenHit> hits;
  for (RaySection& section : sections) {
    if (hits.empty() || section.first > hits.back().hit.last)
      hits.push_back(
          {{section.first, section.first, {}, {}, RayHitKind::touching, section.face}, 0, section.sign, true});
    OpenHit& open = hits.back();
    ++open.section_count;
    open.do_signs_agree = open.do_signs_agree && section.sign != 0 && section.sign == open.sign;
    if (section.last > open.hit.last) open.hit.last = std::move(section.last);
  }
  for (OpenHit& open : hits) {
    open.hit.first_point = ExactPoint(ray.at(open.hit.first));
    open.hit.last_point = ExactPoint(ray.at(open.hit.last));
  }
  return hits;
}

/// Whether the ray is inside of the solid between two hits, or before the first one.
class Gaps {
 public:
  Gaps(const Ray& ray, const Volume3d& solid, const std::vector<OpenHit>& hits)
      : ray_(ray), solid_(solid), hits_(hits) {}

  /// Before the hit, of which nothing is known if the ray begins with it.
  std::optional<bool> is_inside_before(std::size_t hit) const {
    if (hit == hits_.size()) return false;
    if (hit == 0 && hits_[0].hit.first.sign() == 0) return std::nullopt;
    // A single triangle is passed through its inside.
    if (hits_[hit].section_count == 1 && hits_[hit].sign != 0) return hits_[hit].sign > 0;
    if (hit > 0 && hits_[hit - 1].section_count == 1 && hits_[hit - 1].sign != 0) return hits_[hit - 1].sign < 0;
    const Rational begin = hit == 0 ? Rational(0) : hits_[hit - 1].hit.last;
    const ExactPoint middle(ray_.at((begin + hits_[hit].hit.first) / 2));
    return place_in_solid(middle, solid_.geometry()) == Placement::inside;
  }

 private:
  const Ray& ray_;
  const Volume3d& solid_;
  const std::vector<OpenHit>& hits_;
};

RayHitKind kind_of(std::optional<bool> is_inside_before, bool is_inside_after) {
  if (is_inside_before == is_inside_after) return RayHitKind::touching;
  return is_inside_after ? RayHitKind::entering : RayHitKind::leaving;
}

}  // namespace

std::string_view name_of(RayHitKind kind) {
  constexpr std::array<std::string_view, 3> kNames{"entering", "leaving", "touching"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<RayHit> ray_hits(const Volume3d& solid, const RationalVec3& origin, const RationalVec3& direction) {
  const Ray ray{origin, direction};
  const std::vector<OpenHit> open = joined(ray, sections_of(ray, solid.geometry()));
  const Gaps gaps(ray, solid, open);
  std::vector<RayHit> hits;
  std::optional<bool> is_inside = gaps.is_inside_before(0);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::optional<bool> is_inside_after = gaps.is_inside_before(i + 1);
    hits.push_back(open[i].hit);
    hits.back().kind = kind_of(is_inside, *is_inside_after);
    is_inside = is_inside_after;
  }
  return hits;
}

std::vector<RayHit> ray_hits(const Surface3d& surface, const RationalVec3& origin, const RationalVec3& direction) {
  const Ray ray{origin, direction};
  std::vector<RayHit> hits;
  for (OpenHit& open : joined(ray, sections_of(ray, surface.geometry()))) {
    if (open.do_signs_agree) open.hit.kind = open.sign < 0 ? RayHitKind::entering : RayHitKind::leaving;
    hits.push_back(std::move(open.hit));
  }
  return hits;
}

}  // namespace algebra3d
