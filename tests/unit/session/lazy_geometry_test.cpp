// A filter on boxes reads no geometry: issue "the main job", lazy loading.
#include <gtest/gtest.h>

#include "unit/session/example_session.h"

namespace queries {
namespace {

class LazyGeometry : public testing::Test {
 protected:
  LazyGeometry() : session_(folder_.path()) {
    EXPECT_TRUE(session_.session().open_file(folder_.path() / "lazy.db").ok());
    EXPECT_EQ(session_.run(
                  "let Parts = intstream(1, 10000) transformstream extend[Solid: createCube(makePoint3D(.Elem, 0, 0), "
                  "makePoint3D(.Elem + 1, 1, 1))] consume"),
              "");
    EXPECT_EQ(session_.run("let B = rectangle3(100, 200, 0, 1, 0, 1)"), "");
  }
  std::uint64_t loads() { return session_.session().store()->geometry_loads(); }

  TestFolder folder_;
  TestSession session_;
};

TEST_F(LazyGeometry, a_filter_on_boxes_reads_none_of_10000_solids) {
  // Cubes [n, n+1] that meet [100, 200]: n = 99 .. 200.
  EXPECT_EQ(session_.run("query Parts feed filter[bbox(.Solid) intersects B] count"), "102");
  EXPECT_EQ(session_.run("query Parts feed filter[size(.Solid) = 12] count"), "10000");
  EXPECT_EQ(session_.run("let Index = Parts creatertree[Solid]"), "");
  EXPECT_EQ(session_.run("query Index Parts windowintersects[B] count"), "102");
  EXPECT_EQ(session_.run("query Parts feed {a} Parts feed {b} itSpatialJoin[Solid_a, Solid_b] count"), "29998");
  EXPECT_EQ(loads(), 0U);
}

TEST_F(LazyGeometry, only_what_is_measured_is_read) {
  EXPECT_EQ(session_.run("query Parts feed filter[bbox(.Solid) intersects B] extend[V: volume(.Solid)] sum[V]"),
            "102.0");
  EXPECT_EQ(loads(), 102U);
}

}  // namespace
}  // namespace queries
