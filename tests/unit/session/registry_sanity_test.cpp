// The registry as data: every operator is described completely, and its examples and errors are what really happens.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "unit/session/example_session.h"

namespace queries {
namespace {

using algebra3d::Operator;
using algebra3d::Overload;

class EveryOperator : public testing::TestWithParam<const Operator*> {
 protected:
  // A database with the objects that examples use.
  std::string answer(const std::string& query) {
    const TestFolder folder;
    TestSession session(folder.path());
    EXPECT_TRUE(session.session().open_file(folder.path() / "examples.db").ok());
    if (query.find("Boxes") != std::string::npos) {
      for (const std::string& command : example_objects()) EXPECT_EQ(session.run(command), "");
    }
    return session.run(query.starts_with("query ") ? query : "query " + query);
  }
  static std::string references() {
    std::ifstream file(std::string(ALGEBRA3D_SOURCE) + "/docs/references.md");
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

TEST_P(EveryOperator, is_documented) {
  const Operator& op = *GetParam();
  EXPECT_TRUE(op.doc.ends_with('.')) << op.doc;
  EXPECT_TRUE(op.detail.empty() || op.detail.ends_with('.')) << op.detail;
  EXPECT_FALSE(op.errors.empty());
  EXPECT_FALSE(op.all_signatures().empty());
}

TEST_P(EveryOperator, has_an_example_with_a_value_and_one_with_undefined) {
  const Operator& op = *GetParam();
  EXPECT_TRUE(std::ranges::any_of(op.examples, [](const auto& e) { return e.result != "undefined"; }));
  const bool has_arguments = op.stream == nullptr;
  EXPECT_TRUE(!has_arguments || std::ranges::any_of(op.examples, [](const auto& e) {
    return e.query.find("undefined") != std::string::npos;
  }));
}

TEST_P(EveryOperator, examples_give_what_they_say) {
  for (const auto& [query, result] : GetParam()->examples) EXPECT_EQ(answer(query), result) << query;
}

TEST_P(EveryOperator, errors_say_what_they_say) {
  for (const auto& [query, message] : GetParam()->errors) {
    const std::string found = answer(query);
    EXPECT_TRUE(found.starts_with("error: ") && found.find(message) != std::string::npos)
        << query << "\nfound:    " << found << "\nexpected: " << message;
  }
}

TEST_P(EveryOperator, syntax_has_a_place_for_every_parameter) {
  const Operator& op = *GetParam();
  const auto& syntax = test_registry().syntax(op);
  for (const Overload& overload : op.overloads) {
    EXPECT_GE(overload.parameters.size(), syntax.place_count()) << overload.signature();
    EXPECT_TRUE(syntax.is_open_ended || overload.parameters.size() == syntax.place_count()) << overload.signature();
  }
}

TEST_P(EveryOperator, no_two_overloads_accept_the_same_arguments) {
  std::set<std::string> seen;
  for (const Overload& overload : GetParam()->overloads) {
    const std::string signature = overload.signature();
    EXPECT_TRUE(seen.insert(signature.substr(0, signature.find(" ->"))).second) << signature;
  }
}

TEST_P(EveryOperator, sources_are_in_the_references) {
  const std::string known = references();
  for (const std::string& key : GetParam()->sources) EXPECT_NE(known.find("[" + key + "]"), std::string::npos) << key;
}

std::string test_name(const testing::TestParamInfo<const Operator*>& info) {
  std::string name;
  for (const char c : info.param->name)
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? std::string(1, c)
                                                             : "x" + std::to_string(static_cast<int>(c));
  return name;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryOperator, testing::ValuesIn(test_registry().operators()), test_name);

TEST(EveryType, is_described_and_reads_its_own_example) {
  for (const algebra3d::Type* type : test_registry().types()) {
    EXPECT_TRUE(type->doc().ends_with('.')) << type->name();
    const TestFolder folder;
    TestSession session(folder.path());
    const std::string found =
        session.run("query [const " + std::string(type->name()) + " value " + std::string(type->example()) + "]");
    EXPECT_FALSE(found.starts_with("error")) << type->name() << ": " << found;
    EXPECT_NE(found, "undefined") << type->name();
  }
}

}  // namespace
}  // namespace queries
