#include "queries/store/detail/relation_layout.h"

#include <gtest/gtest.h>

#include "algebra3d/values/types/all.h"
#include "support/cloud_type.h"

namespace queries {
namespace {

using algebra3d::TypeExpr;

TEST(RelationLayout, types_say_how_large_their_values_are) {
  algebra3d::Registry registry;
  for (const algebra3d::Type* type : algebra3d::all_types()) registry.add(*type);
  registry.add(algebra3d::TypeOf<Cloud>::type());
  const auto tuple = TypeExpr::tuple({{"C", "cloud3d"},
                                      {"V", "volume3d"},
                                      {"R", "region"},
                                      {"P", "point3d"},
                                      {"Q", "point"},
                                      {"B", "rect3"},
                                      {"D", "vector3d"},
                                      {"N", "int"}});
  const auto layout = RelationLayout::make(registry, tuple, "r", 1);
  ASSERT_TRUE(layout) << layout.error().text();
  std::vector<AttributeForm> forms;
  for (const AttributeColumns& attribute : (*layout)->attributes()) forms.push_back(attribute.form);
  EXPECT_EQ(forms, (std::vector<AttributeForm>{AttributeForm::large, AttributeForm::large, AttributeForm::large,
                                               AttributeForm::spatial, AttributeForm::spatial, AttributeForm::spatial,
                                               AttributeForm::bytes, AttributeForm::integer}));
}

}  // namespace
}  // namespace queries
