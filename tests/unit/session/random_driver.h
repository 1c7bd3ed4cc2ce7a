#pragma once

#include <optional>
#include <random>
#include <string>

#include "unit/session/example_session.h"
#include "unit/session/random_model.h"

namespace queries {

/// A session and its model, side by side: every command is given with the answer that the model has for it.
class RandomDriver {
 public:
  explicit RandomDriver(unsigned seed) : random_(seed), session_(folder_.path()) {
    expect("create database d", "");
    expect("open database d", "");
  }

  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }
  std::string relation_name() { return "R" + std::to_string(below(3)); }
  std::string number_name() { return "n" + std::to_string(below(2)); }
  std::string derived_name() { return "d" + std::to_string(below(2)); }
  std::string index_name() { return "I" + std::to_string(below(2)); }
  Row row() {
    const int key = below(4);
    return {key, below(100) - 50};
  }

  Model& model() { return model_; }
  const Rows* find(const std::string& name) const { return model_.find(name); }

  /// `answer` is what the command prints, or "error".
  void expect(const std::string& command, const std::string& answer) {
    history_ += command + "\n";
    const std::string found = session_.run(command);
    const bool is_right = answer == "error" ? found.starts_with("error: ") : found == answer;
    if (is_right) return;
    has_failed_ = true;
    ADD_FAILURE() << history_ << "expected: " << answer << "\nfound: " << found;
  }
  /// A command that gives nothing, or an error if the names are in the wrong state.
  bool expect_change(const std::string& command, bool succeeds) {
    expect(command, succeeds ? "" : "error");
    return succeeds;
  }
  /// A query that is an error if what it needs is not there.
  void expect_query(const std::string& expression, bool is_possible, const std::string& answer) {
    expect("query " + expression, is_possible ? answer : "error");
  }

  // Transactions over several statements.
  bool is_in_transaction() const { return before_.has_value(); }
  void begin() { before_ = model_; }
  void end(bool keeps) {
    if (!keeps) model_ = *before_;
    before_.reset();
  }

  /// What was saved last, and can be restored.
  std::optional<Rows> saved;

  bool has_failed() const { return has_failed_; }

 private:
  TestFolder folder_;
  std::mt19937 random_;
  TestSession session_;
  Model model_;
  std::optional<Model> before_;  // the transaction that is open
  std::string history_;
  bool has_failed_ = false;
};

/// One kind of command; a step with twice the weight comes twice as often.
struct RandomStep {
  int weight;
  void (*run)(RandomDriver&);
};

}  // namespace queries
