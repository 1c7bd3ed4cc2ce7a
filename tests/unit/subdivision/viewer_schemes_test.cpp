// The list of schemes in the viewer's sources is that of the kernel. With ALGEBRA3D_UPDATE=1 it is written anew.
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "algebra3d/kernel/subdivision/scheme.h"

namespace algebra3d {
namespace {

std::string list_of_schemes() {
  std::string text =
      "/** The subdivision schemes, as the kernel describes them; tests/unit/subdivision/viewer_schemes_test.cpp "
      "writes "
      "this. */\nexport const subdivisionSchemes = [\n";
  const auto word = [](bool value) { return value ? std::string("true") : std::string("false"); };
  for (const SubdivisionScheme& scheme : subdivision_schemes()) {
    std::string variants;
    for (const std::string_view variant : variants_of(scheme))
      variants += (variants.empty() ? "\"" : ", \"") + std::string(variant) + "\"";
    text += "  { name: \"" + std::string(name_of(scheme)) +
            "\", takesTrianglesOnly: " + word(takes_triangles_only(scheme)) + ", hasLimit: " + word(has_limit(scheme)) +
            ", variants: [" + variants + "] },\n";
  }
  return text + "] as const;\n";
}

TEST(ViewerSchemes, list_is_that_of_the_kernel) {
  const std::string path = std::string(ALGEBRA3D_SOURCE) + "/viewer/src/state/subdivision_schemes.ts";
  if (const char* update = std::getenv("ALGEBRA3D_UPDATE"); update != nullptr && std::string(update) == "1")
    std::ofstream(path) << list_of_schemes();
  std::stringstream content;
  content << std::ifstream(path).rdbuf();
  EXPECT_EQ(content.str(), list_of_schemes()) << "ALGEBRA3D_UPDATE=1 subdivision_test --gtest_filter=ViewerSchemes.*";
}

}  // namespace
}  // namespace algebra3d
