// Random commands, run by a session and by a model that keeps relations in plain vectors: every answer is compared.
// ALGEBRA3D_RANDOM_SECONDS says how long (default: 5), ALGEBRA3D_RANDOM_SEED where it begins (default: 1).
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <map>
#include <optional>
#include <random>

#include <fmt/format.h>

#include "unit/session/example_session.h"

namespace queries {
namespace {

struct Row {
  int key = 0;
  int value = 0;
  friend bool operator==(const Row&, const Row&) = default;
};
using Rows = std::vector<Row>;

/// What a database holds, as a person would write it down.
struct Model {
  std::map<std::string, Rows> relations;
  std::map<std::string, int> numbers;

  bool has(const std::string& name) const { return relations.contains(name) || numbers.contains(name); }
  void remove(const std::string& name) {
    relations.erase(name);
    numbers.erase(name);
  }
};

std::string text_of(const Rows& rows) {
  std::string text;
  for (const Row& row : rows) text += fmt::format("{}({} {})", text.empty() ? "" : " ", row.key, row.value);
  return "(" + text + ")";
}

class RandomSession {
 public:
  explicit RandomSession(unsigned seed) : random_(seed), session_(folder_.path()) {
    expect("create database d", "");
    expect("open database d", "");
  }

  void step() {
    switch (below(18)) {
      case 0:
      case 1:
        return let_relation();
      case 2:
        return let_number();
      case 3:
        return let_again();
      case 4:
        return insert();
      case 5:
        return erase();
      case 6:
        return remove();
      case 7:
        return rename();
      case 8:
        return update();
      case 9:
        return failing();
      case 10:
        return transaction();
      case 11:
        return reopen();
      case 12:
        return below(8) == 0 ? save_and_restore() : sums();
      case 13:
        return groups();
      case 14:
        return join();
      case 15:
        return sorted();
      default:
        return whole();
    }
  }
  bool has_failed() const { return has_failed_; }

 private:
  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }
  std::string relation_name() { return "R" + std::to_string(below(3)); }
  std::string number_name() { return "n" + std::to_string(below(2)); }

  void expect(const std::string& command, const std::string& answer) {
    history_ += command + "\n";
    const std::string found = session_.run(command);
    const bool is_right = answer == "error" ? found.starts_with("error: ") : found == answer;
    if (is_right) return;
    has_failed_ = true;
    ADD_FAILURE() << history_ << "expected: " << answer << "\nfound: " << found;
  }
  /// A command that gives nothing, or an error if the name is in the wrong state.
  void expect_change(const std::string& command, bool succeeds) { expect(command, succeeds ? "" : "error"); }
  void expect_query(const std::string& expression, const Rows* rows, const std::string& answer) {
    expect("query " + expression, rows == nullptr ? "error" : answer);
  }

  const Rows* find(const std::string& name) const {
    const auto found = model_.relations.find(name);
    return found == model_.relations.end() ? nullptr : &found->second;
  }

  void let_relation() {
    const std::string name = relation_name();
    Rows rows;
    for (int count = below(6); count > 0; --count) rows.push_back({below(4), below(100) - 50});
    expect_change("let " + name + " = [const rel(tuple([K: int, V: int])) value " + text_of(rows) + "]",
                  !model_.has(name));
    if (!model_.has(name)) model_.relations[name] = rows;
  }

  void let_number() {
    const std::string name = number_name();
    const int number = below(1000);
    expect_change(fmt::format("let {} = {} + 0", name, number), !model_.has(name));
    if (!model_.has(name)) model_.numbers[name] = number;
  }

  void let_again() {
    const std::string target = relation_name();
    const std::string source = relation_name();
    const int limit = below(60) - 30;
    const Rows* rows = find(source);
    expect_change(fmt::format("let_ {} = {} feed filter[.V > {}] consume", target, source, limit), rows != nullptr);
    if (rows == nullptr) return;
    Rows kept;
    std::ranges::copy_if(*rows, std::back_inserter(kept), [&](const Row& row) { return row.value > limit; });
    model_.relations[target] = kept;
  }

  void insert() {
    const std::string name = relation_name();
    const Row row{below(4), below(100) - 50};
    expect_query(fmt::format("{} inserttuple[{}, {}] count", name, row.key, row.value), find(name), "1");
    if (find(name) != nullptr) model_.relations[name].push_back(row);
  }

  void erase() {
    const std::string name = relation_name();
    const int key = below(4);
    const std::string command = fmt::format("{} feed filter[.K = {}] {} deletesearch count > -1", name, key, name);
    expect_query(command, find(name), "TRUE");
    if (find(name) != nullptr) std::erase_if(model_.relations[name], [&](const Row& row) { return row.key == key; });
  }

  void remove() {
    const std::string name = below(3) == 0 ? number_name() : relation_name();
    expect_change((below(2) == 0 ? "delete " : "kill ") + name, model_.has(name));
    model_.remove(name);
  }

  void rename() {
    const std::string from = relation_name();
    const std::string to = relation_name();
    const bool succeeds = model_.has(from) && !model_.has(to);
    if (from == to) return;
    expect_change("changename " + from + " to " + to, succeeds);
    if (!succeeds) return;
    model_.relations[to] = model_.relations[from];
    model_.relations.erase(from);
  }

  void update() {
    const std::string name = number_name();
    const int by = below(10);
    const auto found = model_.numbers.find(name);
    expect_change(fmt::format("update {} := {} + {}", name, name, by), found != model_.numbers.end());
    if (found != model_.numbers.end()) found->second += by;
    expect("query " + name, found == model_.numbers.end() ? "error" : std::to_string(found->second));
  }

  // Fails in the middle of its work; nothing of it may stay.
  void failing() {
    const std::string name = relation_name();
    expect(fmt::format("query {} inserttuple[1, 2] projecttransform[V] count", name), "error");
    expect(fmt::format("{{ let temporary = 1 | update temporary := {} }}", "nothing"), "error");
    expect("delete temporary", "");
  }

  void transaction() {
    if (!before_) {
      before_ = model_;
      return expect("begin transaction", "");
    }
    const bool aborts = below(2) == 0;
    expect(aborts ? "abort transaction" : "commit transaction", "");
    if (aborts) model_ = *before_;
    before_.reset();
  }

  // What is not committed is lost.
  void reopen() {
    if (below(4) != 0) return;
    expect("close database", "");
    if (before_) model_ = *before_;
    before_.reset();
    expect("open database d", "");
    expect("check database", "(inquiry (findings ()))");
  }

  void save_and_restore() {
    if (before_) return;
    expect("save database to 'saved.txt'", "");
    expect("close database", "");
    expect("restore database d from 'saved.txt'", "");
  }

  void sums() {
    const std::string name = relation_name();
    const Rows* rows = find(name);
    int sum = 0;
    for (const Row& row : rows != nullptr ? *rows : Rows()) sum += row.value;
    expect_query(name + " feed sum[V]", rows, std::to_string(sum));
  }

  void groups() {
    const std::string name = relation_name();
    const Rows* rows = find(name);
    std::map<int, std::pair<int, int>> found;
    for (const Row& row : rows != nullptr ? *rows : Rows()) {
      ++found[row.key].first;
      found[row.key].second += row.value;
    }
    std::string text;
    for (const auto& [key, group] : found)
      text += fmt::format("{}({} {} {})", text.empty() ? "" : " ", key, group.first, group.second);
    expect_query(name + " feed sortby[K] groupby[K; N: group count, S: group feed sum[V]] consume", rows,
                 "(" + text + ")");
  }

  void join() {
    const std::string left = relation_name();
    const std::string right = relation_name();
    const Rows* left_rows = find(left);
    const Rows* right_rows = find(right);
    int pairs = 0;
    for (const Row& a : left_rows != nullptr ? *left_rows : Rows())
      for (const Row& b : right_rows != nullptr ? *right_rows : Rows()) pairs += a.key == b.key ? 1 : 0;
    expect_query(fmt::format("{} feed {{a}} {} feed {{b}} hashjoin[K_a, K_b] count", left, right),
                 left_rows == nullptr ? nullptr : right_rows, std::to_string(pairs));
  }

  void sorted() {
    const std::string name = relation_name();
    const Rows* rows = find(name);
    Rows copy = rows != nullptr ? *rows : Rows();
    std::ranges::sort(copy,
                      [](const Row& a, const Row& b) { return a.key != b.key ? a.key < b.key : a.value > b.value; });
    expect_query(name + " feed sortby[K, V desc] consume", rows, text_of(copy));
  }

  void whole() {
    const std::string name = relation_name();
    const Rows* rows = find(name);
    expect_query(name, rows, rows != nullptr ? text_of(*rows) : "");
  }

  TestFolder folder_;
  std::mt19937 random_;
  TestSession session_;
  Model model_;
  std::optional<Model> before_;  // the transaction that is open
  std::string history_;
  bool has_failed_ = false;
};

int setting(const char* name, int usual) {
  const char* value = std::getenv(name);
  return value != nullptr ? std::atoi(value) : usual;
}

TEST(RandomSession, gives_the_answers_of_the_model) {
  constexpr int kSteps = 150;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(setting("ALGEBRA3D_RANDOM_SECONDS", 5));
  auto seed = static_cast<unsigned>(setting("ALGEBRA3D_RANDOM_SEED", 1));
  do {
    SCOPED_TRACE(fmt::format("ALGEBRA3D_RANDOM_SEED={}", seed));
    RandomSession session(seed++);
    for (int step = 0; step < kSteps && !session.has_failed(); ++step) session.step();
    ASSERT_FALSE(session.has_failed());
  } while (std::chrono::steady_clock::now() < end);
}

}  // namespace
}  // namespace queries
