// The registry as data: every operator is described completely, and its examples and errors are what really happens.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "algebra3d/operators/registry/detail/host_name.h"
#include "queries/language/example_queries.h"
#include "unit/session/example_session.h"

namespace queries {
namespace {

using algebra3d::Operator;
using algebra3d::OperatorKind;
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
  EXPECT_FALSE(op.all_signatures().empty());
  EXPECT_TRUE(op.language_note.empty() || op.language_note.ends_with('.')) << op.language_note;
}

// An aggregate over every type accepts whatever it is given.
bool can_fail(const Operator& op) {
  return op.kind() != OperatorKind::aggregate || op.overloads.size() < test_registry().types().size();
}

TEST_P(EveryOperator, has_an_example_of_an_error) {
  EXPECT_EQ(failing_queries(test_registry(), *GetParam()).empty(), !can_fail(*GetParam()));
}

TEST_P(EveryOperator, says_what_it_costs_and_touches) {
  const Operator& op = *GetParam();
  EXPECT_FALSE(op.family.empty());
  EXPECT_NE(op.cost, algebra3d::Cost::unknown);
  EXPECT_TRUE(!op.is_pure || (!op.reads_files && !op.writes_files)) << "what touches files is not pure";
  EXPECT_TRUE(!op.is_pure || !op.changes_relations) << "what changes relations is not pure";
  EXPECT_EQ(op.cost == algebra3d::Cost::file, op.reads_files || op.writes_files);
  // What is called so is about files.
  EXPECT_EQ(op.name.starts_with("import"), op.reads_files && op.name.starts_with("import"));
  EXPECT_EQ(op.name.starts_with("export"), op.writes_files);
}

TEST_P(EveryOperator, has_examples_of_its_own_kind) {
  const Operator& op = *GetParam();
  const bool is_relational = op.kind() == OperatorKind::relational;
  EXPECT_EQ(is_relational, op.examples.empty());
  EXPECT_TRUE(!is_relational || op.errors.empty());
  EXPECT_TRUE(is_relational || (op.query_examples.empty() && op.query_errors.empty()));
}

TEST_P(EveryOperator, has_an_example_with_a_value_and_one_with_undefined) {
  const Operator& op = *GetParam();
  const auto examples = example_queries(test_registry(), op);
  EXPECT_TRUE(std::ranges::any_of(examples, [](const auto& e) { return e.result != "undefined"; }));
  const bool has_arguments = op.kind() != OperatorKind::relational && !op.overloads.front().parameters.empty();
  EXPECT_TRUE(!has_arguments || std::ranges::any_of(examples, [](const auto& e) {
    return e.query.find("undefined") != std::string::npos;
  }));
}

TEST_P(EveryOperator, examples_give_what_they_say) {
  for (const auto& [query, result] : example_queries(test_registry(), *GetParam()))
    EXPECT_EQ(answer(query), result) << query;
}

bool gives_one_tuple(const Operator& op) {
  return op.gives_one_tuple || std::ranges::any_of(op.overloads, &Overload::has_one_row);
}

// Streams that are shown without `consume` have one tuple at most.
TEST_P(EveryOperator, streams_of_at_most_one_tuple_need_no_consume) {
  const std::string consume = " consume";
  for (const auto& [query, result] : example_queries(test_registry(), *GetParam())) {
    if (!query.ends_with(" " + GetParam()->name + consume) && !query.ends_with(")" + consume)) continue;
    const std::string shown = answer(query.substr(0, query.size() - consume.size()));
    if (!gives_one_tuple(*GetParam())) continue;
    EXPECT_EQ(shown, result) << query;
    EXPECT_EQ(answer("query ((" + query + ") count) <= 1"), "TRUE") << query;
  }
}

TEST(Operators, that_give_at_most_one_tuple) {
  std::vector<std::string> found;
  for (const Operator* op : test_registry().operators()) {
    if (!gives_one_tuple(*op)) continue;
    found.push_back(op->name);
    EXPECT_TRUE(op->gives_one_tuple || std::ranges::all_of(op->overloads, &Overload::has_one_row)) << op->name;
  }
  EXPECT_EQ(found,
            (std::vector<std::string>{"boundingCylinder", "boundingSphere", "clash", "closestPair", "closestPoints",
                                      "closestSelfPair", "commonPoint", "congruence", "deletebyid", "halfedge",
                                      "inertia", "inserttuple", "minimalBox", "relation", "updatebyid"}));
}

TEST_P(EveryOperator, errors_say_what_they_say) {
  for (const auto& [query, message] : failing_queries(test_registry(), *GetParam())) {
    const std::string found = answer(query);
    EXPECT_TRUE(found.starts_with("error: ") && found.find(message) != std::string::npos)
        << query << "\nfound:    " << found << "\nexpected: " << message;
  }
}

TEST_P(EveryOperator, syntax_has_a_place_for_every_parameter) {
  const Operator& op = *GetParam();
  const auto& syntax = test_registry().syntax(op);
  for (const Overload& overload : op.overloads) {
    if (overload.kind() == OperatorKind::aggregate) continue;  // a stream and the name of an attribute
    // `-x`: a sign.
    if (op.name == "-" && overload.parameters.size() == 1) continue;
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

// A function may be called with undefined for one of its operands alone; then they are not alike.
bool has_alike_operands(const Overload& overload) {
  const auto& parameters = overload.parameters;
  return overload.kind() == OperatorKind::scalar && parameters.size() == 2 &&
         parameters[0].type == parameters[1].type && parameters[0].accepts_undefined == parameters[1].accepts_undefined;
}

/// What became of the calls with two operands of one type in the examples of an operator.
struct Exchanges {
  int of_symmetric = 0;      ///< calls of overloads that say that they are symmetric
  int differing = 0;         ///< of these: another answer to exchanged operands
  int differing_others = 0;  ///< of the other overloads
};

/// The operator as it is, but every call with two operands of one type is made with exchanged operands as well.
Operator exchanging(Operator op, Exchanges& exchanges) {
  for (Overload& overload : op.overloads) {
    if (!has_alike_operands(overload)) continue;
    overload.function = [plain = overload.function, &exchanges, is_symmetric = overload.is_symmetric](
                            std::span<const algebra3d::Value> values, algebra3d::Context& context) {
      auto answer = plain(values, context);
      const std::array exchanged = {values[1], values[0]};
      const auto other = plain(exchanged, context);
      const auto* const a = std::get_if<algebra3d::Value>(&*answer);
      // Exchanged, the operands may be an error.
      const auto* const b = other.ok() ? std::get_if<algebra3d::Value>(&*other) : nullptr;
      const bool differs =
          answer.ok() != other.ok() || (a == nullptr) != (b == nullptr) || (a != nullptr && compare(*a, *b) != 0);
      exchanges.of_symmetric += is_symmetric ? 1 : 0;
      (is_symmetric ? exchanges.differing : exchanges.differing_others) += differs ? 1 : 0;
      return answer;
    };
  }
  return op;
}

TEST_P(EveryOperator, is_symmetric_where_it_says_so_and_nowhere_else) {
  const Operator& tested = *GetParam();
  Exchanges exchanges;
  algebra3d::Registry registry;
  for (const algebra3d::Type* type : test_registry().types()) registry.add(*type);
  for (const Operator* op : test_registry().operators()) registry.add(op == &tested ? exchanging(*op, exchanges) : *op);
  const TestFolder folder;
  TestSession session(folder.path(), registry);
  for (const auto& [query, result] : example_queries(test_registry(), tested)) session.run("query " + query);

  bool has_symmetric = false;
  bool has_others = false;
  for (const Overload& overload : tested.overloads) {
    if (!has_alike_operands(overload)) continue;
    (overload.is_symmetric ? has_symmetric : has_others) = true;
  }
  EXPECT_EQ(exchanges.differing, 0);
  EXPECT_TRUE(!has_symmetric || exchanges.of_symmetric > 0) << "no example calls the symmetric overload";
  EXPECT_TRUE(!has_others || exchanges.differing_others > 0) << "no example would notice exchanged operands";
}

// Words of the query language have their place in language notes and at its own operators.
TEST_P(EveryOperator, texts_speak_of_no_host) {
  const Operator& op = *GetParam();
  if (op.kind() == OperatorKind::relational) return;
  static const std::regex words(R"(\b(feed|consume|query|queries|let|stream|streams|tuple|tuples|relation|relations|)"
                                R"(attribute|attributes|session|command|groupby)\b|\w\[|\{\w+\})");
  std::smatch found;
  for (const std::string& text : {op.doc, op.detail})
    EXPECT_FALSE(std::regex_search(text, found, words)) << found.str() << "\nin: " << text;
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

// A host that has no types of arguments to tell functions apart still needs names without quotes.
TEST(EveryHost, names_are_unique_per_signature_and_not_reserved) {
  std::map<std::string, std::string> seen;
  const std::regex snake_case("[a-z][a-z0-9]*(_[a-z0-9]+)*");
  for (const Operator* op : test_registry().operators()) {
    if (op->kind() == OperatorKind::relational) continue;
    EXPECT_TRUE(std::regex_match(op->host_name, snake_case)) << op->name << ": " << op->host_name;
    EXPECT_FALSE(op->host_name.starts_with("st_")) << op->name;
    EXPECT_FALSE(algebra3d::is_reserved_in_a_host(op->host_name)) << op->name << ": " << op->host_name;
    for (const Overload& overload : op->overloads) {
      const std::string signature = overload.signature();
      const auto [other, is_new] = seen.emplace(op->host_name + signature.substr(0, signature.find(" ->")), op->name);
      EXPECT_TRUE(is_new) << other->first << ": " << other->second << " and " << op->name;
    }
  }
}

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
