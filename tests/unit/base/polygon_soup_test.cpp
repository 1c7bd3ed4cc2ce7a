#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "base/polygon_soup.h"

namespace {

using algebra3d::PolygonSoup;

TEST(PolygonSoup, a_new_one_has_no_face) {
  EXPECT_EQ(PolygonSoup().face_count(), 0U);
}

TEST(PolygonSoup, faces_of_any_degree_come_back_in_their_order) {
  const std::vector<std::vector<std::uint32_t>> faces = {{0, 1, 2}, {3, 2, 1, 0}, {}, {4, 4, 4, 4, 4}};
  PolygonSoup soup;
  for (const auto& face : faces) soup.add_face(face);
  ASSERT_EQ(soup.face_count(), 4U);
  for (std::size_t i = 0; i < faces.size(); ++i)
    EXPECT_EQ(std::vector<std::uint32_t>(soup.face(i).begin(), soup.face(i).end()), faces[i]);
  EXPECT_EQ(soup.corners.size(), 12U);
  EXPECT_EQ(soup.face_starts, (std::vector<std::uint32_t>{0, 3, 7, 7, 12}));
}

}  // namespace
