// Rewritten plans: they give what the plain plans give, tuple by tuple, and are really used. ALGEBRA3D_RANDOM_SEED says
// where the random queries begin (default: 1).
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <random>
#include <regex>
#include <set>
#include <sstream>

#include "unit/session/example_session.h"

namespace queries {
namespace {

/// A query, and what its plan says of each rewrite that it must have.
struct Sample {
  std::string query;
  std::vector<std::string> rewrites;
};

class PlanRewrites : public testing::Test {
 protected:
  PlanRewrites() { EXPECT_TRUE(session_.session().open_file(folder_.path() / "plans.db").ok()); }

  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }
  template <typename Choices>
  auto one_of(const Choices& choices) {
    return choices[static_cast<std::size_t>(below(static_cast<int>(std::size(choices))))];
  }

  std::string key() {
    if (below(8) == 0) return "undefined";
    static const std::vector<std::string> limits{"9223372036854775807", "-9223372036854775808", "-9223372036854775807"};
    return below(12) == 0 ? one_of(limits) : std::to_string(below(12) - 3);
  }
  std::string word() {
    static const std::vector<std::string> words{"\"\"", "\"a\"", "\"ab\"", "\"b\"", "undefined"};
    return one_of(words);
  }
  std::string box() {
    if (below(8) == 0) return "undefined";
    const int x = below(40), y = below(4);
    return fmt::format("({} {} {} {} 0 1)", x, x + 1 + below(3), y, y + 1);
  }

  void make_relation(const std::string& name, int count) {
    std::string rows;
    for (int row = 0; row < count; ++row)
      rows += fmt::format("({} {} {} {} {}) ", row, key(), word(), below(6) == 0 ? "undefined" : "0.5", box());
    ASSERT_EQ(
        session_.run(fmt::format(
            "let {} = [const rel(tuple([N: int, K: int, W: string, X: real, B: rect3])) value ({})]", name, rows)),
        "");
    for (const char* attribute : {"K", "W"})
      ASSERT_EQ(session_.run(fmt::format("let {0}_{1} = {0} createbtree[{1}]", name, attribute)), "");
    ASSERT_EQ(session_.run(fmt::format("let {0}_B = {0} creatertree[B]", name)), "");
  }
  void delete_relation(const std::string& name) { ASSERT_EQ(session_.run("delete " + name), ""); }

  /// A further condition, which may be undefined, or overflow with a note.
  std::string further() {
    static const std::vector<std::string> conditions{"",
                                                     " and (.N # 3)",
                                                     " and (.K + 9223372036854775800 > 0)",
                                                     " and (10 div .K > 1)",
                                                     " and (.X < 1.0)",
                                                     " and [const bool value undefined]"};
    return one_of(conditions);
  }

  Sample inner_filter() {
    static const std::vector<std::pair<std::string, std::string>> conditions{
        {".K = attr(t, K)", "K"},         {"attr(t, K) = .K", "K"},     {".W = attr(t, W)", "W"},
        {".K > attr(t, K)", "K"},         {".K = attr(t, K) + 1", "K"}, {".B intersects attr(t, B)", "B"},
        {"attr(t, B) intersects .B", "B"}};
    const auto [condition, attribute] = one_of(conditions);
    const std::string filter = fmt::format("S feed filter[({}){}]", condition, further());
    if (below(2) == 0)
      return {fmt::format("R feed loopsel[fun(t: TUPLE) {}] consume", filter), {"by the index S_" + attribute}};
    return {fmt::format("R feed loopjoin[fun(t: TUPLE) {} {{s}}] consume", filter), {"by the index S_" + attribute}};
  }

  Sample top() {
    static const std::vector<std::string> sorts{"sortby[K]", "sortby[K desc, W]", "sortby[W desc, K]", "sortby[X]",
                                                "sort"};
    static const std::vector<int> counts{0, 1, 3, 10, 1000};
    const int count = one_of(counts);
    return {fmt::format("R feed extend[L: .K * 4611686018427387904] {} head[{}] consume", one_of(sorts), count),
            {fmt::format("keeps the first {}", count)}};
  }

  Sample pairs() {
    static const std::vector<std::pair<std::string, std::string>> keys{{"K", "K_s"}, {"W", "W_s"}, {"K", "N_s"}};
    const auto [left, right] = one_of(keys);
    const std::string how = fmt::format("by a hash table of {} for {}", right, left);
    const std::string sides = "R feed S feed {s} ";
    if (below(2) == 0)
      return {fmt::format("{} symmjoin[(.{} = ..{}){}] consume", sides, left, right, further()), {how}};
    const bool is_turned = below(2) == 0;
    return {fmt::format("{} product filter[(.{} = .{}){}] consume", sides, is_turned ? right : left,
                        is_turned ? left : right, further()),
            {how}};
  }

  /// A condition on attributes that kernels decide, or do not.
  std::string condition() {
    static const std::vector<std::string> conditions{".K > 2",
                                                     ".K between[0, 5]",
                                                     "not(.W = \"a\")",
                                                     "(.K < 3) or (.X > 0.25)",
                                                     "(.K > 0) and ((10 div .K) > 1)",
                                                     "(10 div .K > 1) or (.K = 0)",
                                                     ".K * 4611686018427387904 > 0",
                                                     "isdefined(.X) and (.W < \"b\")",
                                                     "isdefined(.B)",
                                                     ".X * 2 < .K",
                                                     "ifthenelse(.K > 1, .N, .K) mod 3 = 1",
                                                     ".W + \"b\" > \"ab\"",
                                                     ".K < Limit",
                                                     ".B intersects [const rect3 value (0 20 0 3 0 1)]",
                                                     "[const bool value undefined]",
                                                     "1 / 0 > .X"};
    return one_of(conditions);
  }
  std::string stage() {
    static const std::vector<std::string> stages{"project[W, K, N, X, B]",
                                                 "{q} renameAttr[N: N_q, K: K_q, W: W_q, X: X_q, B: B_q]",
                                                 "replaceAttr[K: .K + 9223372036854775800]",
                                                 "replaceAttr[N: .K, K: .N]",
                                                 "head[20]",
                                                 "remove[]",
                                                 "sortby[K]",
                                                 "extend[Y: .X / .K] renameAttr[Z: Y] remove[Z]"};
    const std::string chosen = one_of(stages);
    if (chosen == "remove[]") return fmt::format("filter[{}]", condition());
    return chosen;
  }
  /// Scans of some attributes, filters and new attributes in columns, and aggregates of them.
  Sample columns() {
    static const std::vector<std::string> ends{"sum[K]",
                                               "avg[X]",
                                               "avg[K]",
                                               "min[X]",
                                               "max[W]",
                                               "min[B]",
                                               "count",
                                               "project[W, N] consume",
                                               "consume",
                                               "project[K] head[3] consume",
                                               "extend[Y: .X / .K] avg[Y]",
                                               "projectextend[N; Y: .K + .N] sum[Y]"};
    std::string query = "R feed";
    for (int stages = below(4); stages > 0; --stages) query += " " + stage();
    return {query + fmt::format(" filter[{}] {}", condition(), one_of(ends)), {}};
  }

  Sample groups() {
    static const std::vector<std::pair<std::string, std::string>> orders{
        {"K", "K"}, {"K desc", "K"}, {"W, K desc", "K, W"}, {"X", "X"}, {"W desc", "W"}};
    static const std::vector<std::string> functions{
        "C: group count",       "S: group feed sum[K]", "A: group feed avg[X]", "L: group feed min[W]",
        "M: group feed max[X]", "P: group feed sum[P]", "F: group feed count",  "D: group feed max[B]"};
    if (below(3) == 0)
      return {"R feed project[K, W, X] replaceAttr[X: .X * -0.0] sort rdup consume", {"by a hash table"}};
    const auto [order, keys] = one_of(orders);
    std::string list;
    for (const std::string& function : functions)
      if (below(2) == 0) list += (list.empty() ? "" : ", ") + function;
    return {
        fmt::format("R feed extend[P: .K * 4611686018427387904] sortby[{}] groupby[{}; {}] consume", order, keys, list),
        {"by a hash table", "left out: the groups are put in order"}};
  }

  std::string run(const std::string& command, bool rewrites) {
    EXPECT_EQ(session_.run(fmt::format("set \"rewrites\" = {}", rewrites ? "TRUE" : "FALSE")), "");
    return session_.run(command);
  }
  /// The kinds of notes, without numbers: only the first notes of a kind are shown, with the number of the others.
  std::set<std::string> kinds_of_notes() const {
    std::set<std::string> kinds;
    const std::string shown = std::regex_replace(session_.notes(), std::regex(" and [0-9]+ more"), "");
    std::istringstream lines(std::regex_replace(shown, std::regex("[0-9]+"), "N"));
    for (std::string line; std::getline(lines, line);) kinds.insert(line);
    return kinds;
  }

  void expect_same(const Sample& sample) {
    SCOPED_TRACE(sample.query);
    const std::string plain = run("query " + sample.query, false);
    const std::set<std::string> plain_notes = kinds_of_notes();
    EXPECT_FALSE(plain.starts_with("error")) << plain;
    EXPECT_EQ(run("query " + sample.query, true), plain);
    const std::set<std::string> notes = kinds_of_notes();
    EXPECT_TRUE(std::ranges::includes(plain_notes, notes)) << session_.notes();
    for (const std::string& rewrite : sample.rewrites) {
      EXPECT_NE(run("explain " + sample.query, true).find(rewrite), std::string::npos);
      EXPECT_EQ(run("explain " + sample.query, false).find(rewrite), std::string::npos);
    }
  }

  std::mt19937 random_;
  TestFolder folder_;
  TestSession session_{folder_.path()};
};

TEST_F(PlanRewrites, give_the_tuples_of_plain_plans) {
  const char* seed = std::getenv("ALGEBRA3D_RANDOM_SEED");
  random_.seed(static_cast<unsigned>(seed != nullptr ? std::atoi(seed) : 1));
  ASSERT_EQ(session_.run("let Limit = 4"), "");
  for (const int size : {0, 1, 60}) {
    for (const int other_size : {0, 1, 80}) {
      SCOPED_TRACE(fmt::format("{} and {} tuples", size, other_size));
      make_relation("R", size);
      make_relation("S", other_size);
      for (int round = 0; round < 15 && !HasFailure(); ++round) {
        expect_same(inner_filter());
        expect_same(top());
        expect_same(pairs());
        expect_same(columns());
        expect_same(groups());
      }
      delete_relation("R");
      delete_relation("S");
    }
  }
}

// Tuples in row groups, dead ones among them, and tuples beside them.
TEST_F(PlanRewrites, give_the_tuples_of_plain_plans_in_row_groups) {
  const char* seed = std::getenv("ALGEBRA3D_RANDOM_SEED");
  random_.seed(static_cast<unsigned>(seed != nullptr ? std::atoi(seed) : 1));
  ASSERT_EQ(session_.run("let Limit = 4"), "");
  make_relation("R", 270);
  make_relation("S", 20);
  ASSERT_EQ(session_.run("query R feed filter[.N mod 50 = 3] R updatedirect[K: .K - 2, X: .N / 10] count"), "6");
  ASSERT_EQ(session_.run("query R feed filter[.N mod 50 = 4] R deletedirect count"), "6");
  ASSERT_EQ(session_.run("query R inserttuple[1000, 3, \"ab\", 0.25, [const rect3 value undefined]] count"), "1");
  for (int round = 0; round < 6 && !HasFailure(); ++round) {
    expect_same(inner_filter());
    expect_same(top());
    expect_same(columns());
    expect_same(groups());
  }
}

TEST_F(PlanRewrites, row_groups_are_left_out_and_told) {
  ASSERT_EQ(session_.run("let R = intstream(1, 20000) transformstream projectextend[; N: .Elem, X: .Elem / 4] consume"),
            "");
  ASSERT_EQ(session_.run("query R feed filter[.N = 19000] R updatedirect[N: 5] count"), "1");
  for (const auto& [query, left_out] : {std::pair("R feed filter[.N <= 100] count", 4),
                                        {"R feed filter[.N > 30000] count", 5},
                                        {"R feed filter[(.X >= 1000.0) and (.X < 1001.0)] count", 4},
                                        {"R feed filter[.N = 5] project[X] consume", 4}}) {
    SCOPED_TRACE(query);
    expect_same({query, {}});
    EXPECT_NE(run(fmt::format("explain query {}", query), true).find(fmt::format("{} row groups left out", left_out)),
              std::string::npos)
        << run(fmt::format("explain query {}", query), true);
    EXPECT_EQ(run(fmt::format("explain query {}", query), false).find("row groups left out"), std::string::npos);
  }
}

TEST_F(PlanRewrites, hold_beyond_the_work_memory) {
  ASSERT_EQ(session_.run("set \"memory\" = 1"), "");
  ASSERT_EQ(
      session_.run("let R = intstream(1, 20000) transformstream projectextend[; N: .Elem, K: (.Elem * 7919) mod 101, "
                   "W: \"a long string that fills the memory of one megabyte\"] consume"),
      "");
  ASSERT_EQ(session_.run("let S = R feed {s} head[3000] consume"), "");
  expect_same({"R feed sortby[K desc, N] head[9000] project[N, K] consume", {"keeps the first 9000"}});
  expect_same(
      {"R feed head[300] S feed product filter[.N = .N_s] project[N, K_s] consume", {"by a hash table of N_s for N"}});
}

// More groups than memory: those without room are sorted, and the order is that of all.
TEST_F(PlanRewrites, groups_beyond_the_work_memory_are_sorted) {
  ASSERT_EQ(session_.run("set \"memory\" = 1"), "");
  ASSERT_EQ(session_.run("let R = intstream(1, 20000) transformstream projectextend[; N: .Elem, K: (.Elem * 7919) mod "
                         "9001, X: .Elem / 3] consume"),
            "");
  const std::vector<std::string> hashed{"by a hash table"};
  expect_same(
      {"R feed sortby[K desc] groupby[K; C: group count, S: group feed sum[N], A: group feed avg[X]] consume", hashed});
  expect_same({"R feed project[K] sort rdup consume", hashed});
}

TEST_F(PlanRewrites, plans_say_which_attributes_are_read) {
  make_relation("R", 5);
  const auto says = [&](const std::string& query, const std::string& text) {
    EXPECT_NE(run("explain " + query, true).find(text), std::string::npos) << run("explain " + query, true);
    EXPECT_EQ(run("explain " + query, false).find(text), std::string::npos);
  };
  says("R feed filter[.X > 0.1] count", "'reads X'");
  says("R feed filter[.N # 2] project[W] consume", "'reads N, W'");
  says("R feed extend[Y: .N + .K] {a} max[Y_a]", "'reads N, K'");
  says("R feed sortby[W] groupby[W; S: group feed sum[K]] consume", "'reads K, W'");
  says("R feed count", "'the number that the relation keeps'");
  says("R feed filter[TRUE] count", "'reads no attribute'");
  // Operators in columns are counted row by row.
  EXPECT_NE(run("explain query R feed filter[.N < 3] count", true).find("-> bool' 5 0 "), std::string::npos);
}

TEST_F(PlanRewrites, a_filter_sees_what_the_statement_has_changed) {
  make_relation("S", 50);
  const std::string query =
      "query intstream(1, 6) transformstream loopsel[fun(t: TUPLE) S feed filter[.N = attr(t, "
      "Elem)] S updatedirect[N: .N + 1]] project[N_old, N] consume";
  ASSERT_EQ(session_.run("let S_N = S createbtree[N]"), "");
  std::vector<std::string> answers;
  for (const bool rewrites : {false, true}) {
    ASSERT_EQ(session_.run("begin transaction"), "");
    answers.push_back(run(query, rewrites));
    ASSERT_EQ(session_.run("abort transaction"), "");
  }
  EXPECT_TRUE(answers[0].starts_with("((1 2)")) << answers[0];
  EXPECT_EQ(answers[1], answers[0]);
  EXPECT_NE(session_.run("explain " + query.substr(6)).find("by the index S_N"), std::string::npos);
}

}  // namespace
}  // namespace queries
