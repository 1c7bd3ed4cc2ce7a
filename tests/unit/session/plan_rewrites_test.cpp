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
    static const std::vector<std::string> sorts{"sortby[K]", "sortby[K desc, W]", "sortby[W desc, K]",
                                                "sortby[X]", "sortby[B desc, X]", "sortby[X desc, K, W desc, N desc]",
                                                "sort"};
    static const std::vector<int> counts{0, 1, 3, 10, 1000};
    static const std::vector<std::string> ends{"consume", "project[N, W] consume", "filter[.K > 1] sum[N]"};
    const int count = one_of(counts);
    return {fmt::format("R feed extend[L: .K * 4611686018427387904] filter[{}] {} head[{}] {}", condition(),
                        one_of(sorts), count, one_of(ends)),
            {fmt::format("keeps the first {}", count)}};
  }

  /// Few of many tuples, whose other attributes are read when they are known, and tuples by an index.
  Sample late() {
    static const std::vector<std::string> ends{"consume", "project[N, W, B] consume", "filter[.X > 0.1] consume",
                                               "count", "sum[K]"};
    static const std::vector<std::string> few{
        "sortby[K] head[3]", "sortby[K desc] head[7]",   "tail[4]", "tail[500]", "tail[5, FALSE]",
        "tail[0]",           "tail[3] sortby[W] head[2]"};
    static const std::vector<std::string> searches{"R_K R exactmatch[3]", "R_K R range[2, 7]", "R_K R rightrange[5]",
                                                   "R_W R leftrange[\"ab\"]",
                                                   "R_B R windowintersects[[const rect3 value (0 20 0 3 0 1)]]"};
    if (below(3) == 0) return {fmt::format("{} filter[{}] {}", one_of(searches), condition(), one_of(ends)), {}};
    if (below(2) == 0) return {fmt::format("R feed filter[.N > 0] {} consume", one_of(few)), {"then reads by ids"}};
    return {fmt::format("R feed filter[{}] {} {}", condition(), one_of(few), one_of(ends)), {}};
  }

  /// Joins by hash tables in columns: pairs and what follows them.
  Sample joins() {
    static const std::vector<std::pair<std::string, std::string>> keys{{"K", "K_s"}, {"W", "W_s"}, {"K", "N_s"},
                                                                       {"N", "K_s"}, {"X", "X_s"}, {"B", "B_s"}};
    static const std::vector<std::string> ends{
        "consume",
        "count",
        "project[N, W_s] consume",
        "head[7] consume",
        "filter[.K_s + .N > 2] extend[Y: .K * .X_s] project[Y, B, N_s] consume",
        "sortby[W_s desc, N] project[N, K_s] consume",
        "sortby[K, W_s] groupby[K, W_s; C: group count, S: group feed sum[N_s]] consume",
        "krduph[W, K_s] project[N, N_s, W] consume",
        "max[W_s]"};
    const auto [left, right] = one_of(keys);
    return {fmt::format("R feed filter[{}] S feed {{s}} hashjoin[{}, {}] {}", condition(), left, right, one_of(ends)),
            {}};
  }

  /// The first tuple of each key.
  Sample first_of_keys() {
    static const std::vector<std::string> selections{"krduph[K]", "krduph[X]",           "krduph[W]", "krduph[K, W]",
                                                     "krduph[B]", "project[K, X] rduph", "krdup[W]"};
    static const std::vector<std::string> ends{"consume", "count", "head[3] consume", "project[K] consume", "sum[K]"};
    return {
        fmt::format("R feed replaceAttr[X: .X * -0.0] filter[{}] {} {}", condition(), one_of(selections), one_of(ends)),
        {}};
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

  /// Filters that are asked below other operators, and by indexes.
  Sample filters() {
    static const std::vector<std::pair<std::string, std::vector<std::string>>> conditions{
        {".K = 3", {"by the index R_K"}},
        {".W = \"ab\"", {"by the index R_W"}},
        {".K between[7, 9223372036854775807]", {"by the index R_K"}},
        {"(.K = 8) or (.W = \"b\")", {"by the index R_K and R_W"}},
        {"(.K = 8) or (.K = 8) or (.K < -2)", {"by the index R_K"}},
        {"not(.K < 8)", {"by the index R_K"}},
        {"not(.K between[-3, 7])", {"by the index R_K"}},
        {"not((.K < 2) or (.K > 2))", {"by the index R_K"}},
        {"(.K = 1 - 2) or (.B intersects [const rect3 value (0 3 0 1 0 1)])", {"by the index R_K and R_B"}},
        {"(.K = 1) or (.X > 0.25)", {}},
        {".N # 3", {}}};
    static const std::vector<std::pair<std::string, std::string>> stages{
        {"", ""},
        {"extend[Y: .K + 9223372036854775800]", "moved below extend"},
        {"projectextend[K, W, X, B, N; Y: 10 div .K]", "moved below projectextend"},
        {"replaceAttr[X: .X / .N]", ""},
        {"project[B, X, W, K, N]", "moved below project"},
        {"sortby[N desc]", "moved below sortby"},
        {"renameAttr[N_r: N] renameAttr[N: N_r]", "moved below renameAttr, moved below renameAttr"}};
    const auto [condition, indexes] = one_of(conditions);
    const auto [stage, moved] = one_of(stages);
    std::vector<std::string> rewrites = indexes;
    if (!moved.empty()) rewrites.push_back(moved);
    static const std::vector<std::string> ends{"consume", "count", "project[N] consume", "head[2] consume"};
    return {fmt::format("R feed {} filter[({}){}] {}", stage, condition, further(), one_of(ends)), rewrites};
  }
  /// Conditions of one side of a join.
  Sample filters_of_pairs() {
    static const std::vector<std::string> joins{"product", "hashjoin[K, K_s]", "symmjoin[.W < ..W_s]"};
    const std::string join = one_of(joins);
    const std::string name = join.substr(0, join.find('['));
    return {fmt::format("R feed head[20] S feed {{s}} head[20] {} filter[(.K_s > 1) and (.N < 15) and (.K < .N_s){}] "
                        "project[N, N_s, W] consume",
                        join, further()),
            {fmt::format("moved below {0} and below {0}", name)}};
  }

  std::string run(const std::string& command, bool rewrites) {
    EXPECT_EQ(session_.run(fmt::format("set \"rewrites\" = {}", rewrites ? "TRUE" : "FALSE")), "");
    return session_.run(command);
  }
  /// The kinds of notes, without numbers: only the first notes of a kind are shown, with the number of the others.
  std::set<std::string> kinds_of_notes() const {
    std::set<std::string> kinds;
    const std::string shown =
        std::regex_replace(session_.notes(), std::regex(" and [0-9]+ more|; [0-9]+ more differ only in numbers"), "");
    std::istringstream lines(std::regex_replace(shown, std::regex("-?[0-9]+"), "N"));
    for (std::string line; std::getline(lines, line);) kinds.insert(line);
    return kinds;
  }

  void begin_random_plans() {
    const char* seed = std::getenv("ALGEBRA3D_RANDOM_SEED");
    random_.seed(static_cast<unsigned>(seed != nullptr ? std::atoi(seed) : 1));
    ASSERT_EQ(session_.run("let Limit = 4"), "");
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
  begin_random_plans();
  for (const int size : {0, 1, 60}) {
    for (const int other_size : {0, 1, 80}) {
      SCOPED_TRACE(fmt::format("{} and {} tuples", size, other_size));
      make_relation("R", size);
      make_relation("S", other_size);
      for (int round = 0; round < 15 && !HasFailure(); ++round) {
        expect_same(inner_filter());
        expect_same(top());
        expect_same(late());
        expect_same(pairs());
        expect_same(columns());
        expect_same(groups());
        expect_same(joins());
        expect_same(first_of_keys());
        expect_same(filters());
        expect_same(filters());
        expect_same(filters_of_pairs());
      }
      delete_relation("R");
      delete_relation("S");
    }
  }
}

TEST_F(PlanRewrites, give_the_tuples_of_plain_plans_in_many_batches) {
  begin_random_plans();
  make_relation("R", 2500);
  make_relation("S", 40);
  for (int round = 0; round < 12 && !HasFailure(); ++round) {
    expect_same(top());
    expect_same(late());
    expect_same(joins());
    expect_same(columns());
    expect_same(groups());
    expect_same(first_of_keys());
    expect_same(filters());
  }
}

// Tuples in row groups, dead ones among them, and tuples beside them.
TEST_F(PlanRewrites, give_the_tuples_of_plain_plans_in_row_groups) {
  begin_random_plans();
  make_relation("R", 270);
  make_relation("S", 20);
  ASSERT_EQ(session_.run("query R feed filter[.N mod 50 = 3] R updatedirect[K: .K - 2, X: .N / 10] count"), "6");
  ASSERT_EQ(session_.run("query R feed filter[.N mod 50 = 4] R deletedirect count"), "6");
  ASSERT_EQ(session_.run("query R inserttuple[1000, 3, \"ab\", 0.25, [const rect3 value undefined]] count"), "1");
  for (int round = 0; round < 6 && !HasFailure(); ++round) {
    expect_same(inner_filter());
    expect_same(top());
    expect_same(late());
    expect_same(late());
    expect_same(columns());
    expect_same(groups());
  }
}

// Large changes in columns, with and without the proof by the plan that the tuples are of the relation: the relation,
// its indexes and the result are the same, whatever is read of this.
TEST_F(PlanRewrites, changes_in_columns_are_those_of_plain_plans) {
  begin_random_plans();
  static const std::vector<std::string> changes{
      "R feed filter[{}] R updatedirect[K: .K + 1] {}",
      "R feed filter[{}] R updatedirect[K: .N mod 5, W: .W + \"x\", X: .N] {}",
      "R feed filter[{}] sortby[W desc] R updatedirect[B: [const rect3 value undefined], N: .N + 1000] {}",
      "R feed filter[{}] R updatedirect[X: ifthenelse(.K > 1, .X, 0.25)] {}",
      "R feed filter[{}] R deletedirect {}",
      "R feed filter[{}] sortby[K] R deletedirect {}"};
  static const std::vector<std::string> ends{"count", "consume", "project[TID, N] consume"};
  const std::vector<std::string> shown{"R feed consume",
                                       "R_K R range[0, 9] consume",
                                       "R_K R leftrange[9] count",
                                       "R_W R leftrange[\"b\"] consume",
                                       "R feed filter[.K = 3] consume",
                                       "R_B R windowintersects[[const rect3 value (0 90 0 9 0 1)]] consume"};
  for (int round = 0; round < 20 && !HasFailure(); ++round) {
    const int size = 300 + below(200);
    const unsigned seed = static_cast<unsigned>(below(1000000));
    std::vector<std::string> answers;
    for (const bool rewrites : {false, true}) {
      random_.seed(seed);
      make_relation("R", size);
      for (int step = 0; step < 3; ++step) {
        const std::string change = fmt::format(fmt::runtime(one_of(changes)), condition(), one_of(ends));
        SCOPED_TRACE(change);
        std::string answer = run("query " + change, rewrites);
        EXPECT_FALSE(answer.starts_with("error")) << answer;
        for (const std::string& query : shown) answer += run("query " + query, rewrites);
        const std::size_t place = static_cast<std::size_t>(step);
        if (!rewrites)
          answers.push_back(answer);
        else
          EXPECT_EQ(answer, answers[place]);
      }
      EXPECT_NE(session_.run("check database").find("(findings ())"), std::string::npos);
      delete_relation("R");
    }
    random_.seed(seed + 1);
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
  expect_same({"R feed sortby[W, K desc] project[N] consume", {}});
  expect_same({"R feed S feed hashjoin[N, N_s] sortby[N] project[N, W_s] consume", {}});
  expect_same({"R feed krduph[W] consume", {}});
  expect_same({"R feed krduph[N, W] project[N] consume", {}});
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
  says("R feed sortby[W] head[2] project[N] consume", "'reads W'");
  says("R feed sortby[W] head[2] project[N] consume", "'keeps the first 2, then reads by ids'");
  says("R feed sortby[W] head[2] project[W] consume", "'keeps the first 2'");
  says("R feed filter[.N > 1] tail[2] consume", "'reads N'");
  says("R_K R range[1, 3] project[W] consume", "'reads W'");
  says("R feed loopsel[fun(t: TUPLE) R feed filter[.N > attr(t, K)]] sum[X]", "'reads N, X'");
  says("R feed loopsel[fun(t: TUPLE) R feed filter[.N > attr(t, K)]] sum[X]", "'reads K'");
  says("R feed krduph[W] project[N] consume", "'reads N, W'");
  // Of a join both sides.
  make_relation("S", 5);
  says("R feed S feed {s} hashjoin[K, N_s] project[W, X_s] consume", "'reads K, W'");
  says("R feed S feed {s} hashjoin[K, N_s] project[W, X_s] consume", "'reads N, X'");
  says("R feed S feed {s} product filter[.K = .N_s] count", "'reads N'");
  says("R feed S feed {s} product filter[.N > 3] sum[K_s]", "'reads K'");
  says("R feed S feed {s} symmjoin[(.K = ..N_s) and (.W < ..W_s)] count", "'reads K, W'");
  says("R feed S feed {s} symmjoin[(.K = ..N_s) and (.W < ..W_s)] count", "'reads N, W'");
  // Operators in columns are counted row by row.
  EXPECT_NE(run("explain query R feed filter[.N < 3] count", true).find("-> bool' 5 0 "), std::string::npos);
}

TEST_F(PlanRewrites, estimates_are_within_a_factor_of_three) {
  ASSERT_EQ(
      session_.run("let R = intstream(1, 5000) transformstream projectextend[; N: .Elem, K: (.Elem * 7919) mod 101, "
                   "X: (.Elem * 31) / 1000, W: ifthenelse((.Elem mod 3) = 0, \"a\", \"b\")] consume"),
      "");
  ASSERT_EQ(session_.run("let R_K = R createbtree[K]"), "");
  const auto number_in = [](const std::string& text, const std::string& pattern) {
    std::smatch found;
    EXPECT_TRUE(std::regex_search(text, found, std::regex(pattern))) << text;
    return found.empty() ? -1 : std::stod(found[1]);
  };
  for (const std::string& stream : std::vector<std::string>{
           "R feed filter[.N < 2500]", "R feed filter[.K = 17]", "R feed filter[(.K = 17) or (.K between[3, 5])]",
           "R feed {r} filter[(.W_r = \"a\") and (.X_r > 50.0)]", "R feed extend[Y: .X / .K] filter[.X > 100.0]",
           "R feed sortby[X desc] head[12]", "R feed project[K, N] filter[not(.N > 700)] sortby[K]",
           "R feed head[30] R feed {s} head[50] product", "R feed filter[.N > 5000]", "R feed filter[.K < 50]"}) {
    SCOPED_TRACE(stream);
    const double count = std::stod(run("query " + stream + " count", true));
    const double estimate =
        number_in(run("explain " + stream + " count", true), "\\(1 [a-zA-Z]+ '[^']*' 0 0 0.0 (-?[0-9]+) ");
    EXPECT_LE(estimate, 3 * count);
    EXPECT_GE(3 * estimate, count);
  }
}

TEST_F(PlanRewrites, constants_are_folded) {
  make_relation("R", 30);
  expect_same({"R feed filter[.N < ((2 * 3) + 4)] consume", {"+ '(int int) -> int' 0 0 0.0 -1 'computed once')"}});
  expect_same({"R feed sortby[W] head[10 - 7] consume", {"keeps the first 3"}});
  // What notes something, and what is undefined, stays.
  expect_same({"R feed filter[.N > (1 div 0)] consume", {}});
  EXPECT_EQ(run("explain R feed filter[.N > (1 div 0)] count", true).find("computed once"), std::string::npos);
}

// A condition below the function would spare it for most tuples.
TEST_F(PlanRewrites, functions_that_write_files_are_called_for_all_tuples) {
  make_relation("R", 3);
  const std::string query =
      "R feed extend[Done: createCube(makePoint3D(0, 0, 0), makePoint3D(1, 1, 1)) exportSTL[\"cube\", '" +
      (folder_.path() / "cube").string() + "' + totext(num2string(.N)) + '.stl', TRUE]] filter[.N = 1] count";
  EXPECT_EQ(run("explain " + query, true).find("moved below"), std::string::npos);
  EXPECT_EQ(run("query " + query, true), "1");
  for (const int number : {0, 1, 2})
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / fmt::format("cube{}.stl", number))) << number;
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
