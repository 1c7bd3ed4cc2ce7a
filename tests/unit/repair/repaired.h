#pragma once

#include "algebra3d/kernel/repair/solid_from_soup.h"
#include "unit/repair/soups.h"

// What tests of the whole repair ask of its result.

namespace algebra3d::soups {

/// What is left of a soup, which has to be a solid.
inline SolidFromSoup repaired(const TriangleSoup& soup, const RepairOptions& options = {}) {
  Result<SolidFromSoup> made = solid_from_soup(soup, options);
  EXPECT_TRUE(made.ok());
  if (!made.ok()) return {};
  EXPECT_TRUE(made->mesh) << made->status();
  if (made->mesh) expect_valid_volume(*made->mesh);
  return std::move(made).value();
}

inline Rational volume_of(const SolidFromSoup& made) {
  return made.mesh ? solids::exact_volume_of(*made.mesh) : Rational(-1);
}

inline double deviation_of(const SolidFromSoup& made) {
  return made.repair ? made.repair->deviation() : 0;
}

/// -1 if a double cannot hold it.
inline double value_of(const Amount& amount) {
  return amount.in_doubles().value_or(-1);
}

template <typename T>
RepairOptions with(T RepairOptions::*option, double value) {
  RepairOptions options;
  options.*option = value;
  return options;
}

/// No solid can be made of these, and there is a reason.
inline void expect_no_solid(const TriangleSoup& soup) {
  const auto made = solid_from_soup(soup);
  ASSERT_TRUE(made.ok());
  EXPECT_FALSE(made->mesh) << made->status();
  EXPECT_NE(made->reason, "");
}

/// Whatever comes out, it is a solid, or there is a reason.
inline void expect_solid_or_reason(const TriangleSoup& soup) {
  const auto made = solid_from_soup(soup);
  ASSERT_TRUE(made.ok());
  if (made->mesh)
    expect_valid_volume(*made->mesh);
  else
    EXPECT_NE(made->reason, "");
}

inline void expect_exactly(const TriangleSoup& soup, const Rational& volume) {
  const SolidFromSoup made = repaired(soup);
  EXPECT_EQ(volume_of(made), volume) << made.status();
  EXPECT_EQ(deviation_of(made), 0) << made.status();
}

inline TriangleSoup wall_at(double z, double x0, double y0, double x1, double y1) {
  TriangleSoup soup;
  soup.triangles = {{Vec3{x0, y0, z}, Vec3{x1, y0, z}, Vec3{x1, y1, z}},
                    {Vec3{x0, y0, z}, Vec3{x1, y1, z}, Vec3{x0, y1, z}}};
  return soup;
}

}  // namespace algebra3d::soups
