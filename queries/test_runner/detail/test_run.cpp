#include "queries/test_runner/detail/test_run.h"

#include <fnmatch.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iterator>

#include "base/propagate.h"
#include "base/text.h"
#include "queries/session/variables.h"
#include "queries/test_runner/detail/text_of_file.h"

namespace queries {
namespace {

using algebra3d::Registry;
namespace fs = std::filesystem;

// The algebras of SECONDO of which something is here; a file that needs another one is left out.
constexpr std::array<std::string_view, 14> kAlgebras = {
    "algebra3d", "spatial3d", "standard", "function", "relation", "extrelation", "stream",
    "ftext",     "rectangle", "rtree",    "btree",    "spatial",  "datetime",    "tupleidentifier"};

class ResultCollector final : public Presenter {
 public:
  Status present(const TypeExpr& type, const Datum& value, Context& context) override {
    A3D_ASSIGN(result_, result_list(type, value, context));
    return {};
  }
  Status present_inquiry(const NestedList& result) override {
    result_ = result;
    return {};
  }
  /// The result list of the last command; empty for commands without one.
  NestedList take() { return std::exchange(result_, NestedList()); }

 private:
  NestedList result_;
};

// `ExtRelation-C++` and `RTreeAlgebra` are written with and without their endings.
bool is_known_algebra(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const std::string_view ending : {"-c++", "algebra"})
    if (name.ends_with(ending) && name.size() > ending.size()) name.resize(name.size() - ending.size());
  return std::ranges::find(kAlgebras, name) != kAlgebras.end();
}

// The expression behind `query` or `querynt`; nothing for other commands.
std::optional<std::string> queried_expression(std::string_view command) {
  std::size_t end = 0;
  while (end < command.size() && (std::isalnum(static_cast<unsigned char>(command[end])) != 0)) ++end;
  const std::string_view word = command.substr(0, end);
  if (word != "query" && word != "querynt") return std::nullopt;
  return std::string(command.substr(end));
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  for (text = trimmed(text); !text.empty();) {
    const std::size_t end = text.find_first_of(" \t");
    words.emplace_back(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view() : trimmed(text.substr(end));
  }
  return words;
}

}  // namespace

TestRun::TestRun(TestFolders folders, const Registry& registry, const TestOptions& options, const Variation* variation)
    : folders_(std::move(folders)),
      options_(options),
      variation_(variation),
      session_(variation != nullptr ? variation->registry() : registry,
               {.folder = folders_.scratch, .read_only = false}),
      file_variations_(kVariationKinds.begin(), kVariationKinds.end()) {}

Result<TestOutcome> TestRun::run(const std::vector<TestStep>& steps) {
  for (const TestStep& step : steps) {
    if (options_.cancel != nullptr && options_.cancel->load()) return Error{ErrorCode::interrupted, "interrupted"};
    if (const auto* directive = std::get_if<Directive>(&step))
      obey(*directive);
    else
      run_command(std::get<CommandText>(step));
    if (!outcome_.skipped.empty()) break;
  }
  if (section_ == Section::start && outcome_.skipped.empty()) fail(0, "the file has no #setup");
  return std::move(outcome_);
}

void TestRun::note(int line, const std::string& text) const {
  if (variation_ == nullptr) print(fmt::format("  line {}: {}", line, text));
}

void TestRun::fail(int line, const std::string& why) {
  const std::string varied = variation_ != nullptr ? fmt::format(" ({})", name_of(variation_->kind())) : "";
  ++outcome_.failed;
  outcome_.failures.push_back(fmt::format("{}@{}{}", case_number_, line, varied));
  print(fmt::format("  FAILED {}@{}{} {}: {}", case_number_, line, varied, case_name_, why));
}

void TestRun::misuse(const Directive& directive, const std::string& why) {
  const std::string text = "#" + directive.word + ": " + why;
  if (case_is_left_out_) return note(directive.line, text);
  fail(directive.line, text);
}

void TestRun::obey(const Directive& directive) {
  const std::string& word = directive.word;
  if (word == "teardown") section_ = Section::teardown;
  if (word == "description" && variation_ == nullptr) print(directive.argument);
  if (word == "setup") return begin_setup(directive);
  if (word == "stop") {
    if (section_ != Section::start) return note(directive.line, "#stop after #setup; it is ignored");
    outcome_.skipped = directive.argument.empty() ? "stopped" : directive.argument;
  }
  if (word == "variation") return set_variations(directive);
  if (word == "testcase" && (section_ == Section::setup || section_ == Section::cases)) return begin_case(directive);
  if (section_ == Section::broken || section_ == Section::teardown) return;
  const bool is_for_a_case = word == "testcase" || word == "yields" || word == "tolerance_real" || word == "unjudged";
  if (!is_for_a_case) return;
  if (section_ != Section::cases) return note(directive.line, "#" + word + " before a test case; it is ignored");
  if (word == "yields") set_expectation(directive.argument);
  if (word == "tolerance_real") set_tolerance(directive);
  if (word == "unjudged") case_is_unjudged_ = true;
}

void TestRun::begin_setup(const Directive& directive) {
  if (section_ != Section::start) return fail(directive.line, "a second #setup");
  section_ = Section::setup;
  const std::vector<std::string> words = words_of(directive.argument);
  for (std::size_t i = 1; i < words.size(); ++i)
    if (!is_known_algebra(words[i])) outcome_.skipped = "there is no algebra '" + words[i] + "'";
}

void TestRun::begin_case(const Directive& directive) {
  section_ = Section::cases;
  ++case_number_;
  case_name_ = directive.argument;
  case_is_unjudged_ = false;
  const std::string pattern = "*" + options_.filter + "*";
  case_is_left_out_ = !options_.filter.empty() && fnmatch(pattern.c_str(), case_name_.c_str(), 0) != 0;
  case_variations_ = file_variations_;
  expectation_.use_up();
}

void TestRun::set_tolerance(const Directive& directive) {
  const auto tolerance = Tolerance::parse(directive.argument);
  if (!tolerance) return misuse(directive, "expected a number, or % and a number, got " + directive.argument);
  tolerance_ = *tolerance;
}

// `#variation none REASON` or `#variation axes,operands REASON`: those that hold here.
void TestRun::set_variations(const Directive& directive) {
  const std::size_t end = std::min(directive.argument.find(' '), directive.argument.size());
  std::string names = directive.argument.substr(0, end);
  std::set<VariationKind> kinds;
  bool is_understood = end < directive.argument.size();  // a reason follows
  std::ranges::replace(names, ',', ' ');
  for (const std::string& name : words_of(names)) {
    const auto kind = variation_named(name);
    if (kind) kinds.insert(*kind);
    is_understood = is_understood && (kind || name == "none");
  }
  if (!is_understood) return misuse(directive, "expected none, or some of offset,axes,operands, and a reason");
  (section_ == Section::cases ? case_variations_ : file_variations_) = std::move(kinds);
}

void TestRun::set_expectation(const std::string& text) {
  if (text.starts_with('@'))
    expectation_ = expectation_from_file(text.substr(1));
  else if (text.starts_with('*'))
    expectation_ = expectation_from_object(text.substr(1));
  else
    expectation_ = Expectation::parse(text);
}

Expectation TestRun::expectation_from_file(const std::string& name) const {
  const std::string written = algebra3d::with_replaced(name, "$(SCRATCH)", folders_.scratch.string());
  const fs::path file = folders_.file / with_variables(written);
  const auto content = read_text(file, options_.cancel);
  if (!content) return Expectation::with_problem("#yields: " + content.error().text());
  auto list = NestedList::parse(with_variables(*content));
  if (!list) return Expectation::with_problem("#yields: " + file.string() + ": " + list.error().text());
  return Expectation::of_value(std::move(list).value());
}

Expectation TestRun::expectation_from_object(const std::string& name) {
  auto result = execute({"query " + name, {}});
  if (!result) return Expectation::with_problem("query " + name + ": " + result.error().text());
  return Expectation::of_value(std::move(result).value());
}

Result<NestedList> TestRun::execute(const CommandText& command) {
  diagnostics_.clear();
  Context context{diagnostics_, options_.cancel, folders_.file};
  std::string text = algebra3d::with_replaced(command.text, "$(SCRATCH)", folders_.scratch.string());
  if (variation_ != nullptr) {
    A3D_ASSIGN(text, variation_->moved_command(text, folders_));
  }
  ResultCollector collector;
  A3D_TRY(session_.execute(text, command.start, collector, context));
  NestedList result = collector.take();
  return variation_ != nullptr ? variation_->original_result(result) : result;
}

void TestRun::run_command(const CommandText& command) {
  if (section_ == Section::broken) return;
  if (section_ == Section::cases) {
    if (is_judged()) return expectation_.kind == Expectation::Kind::equal ? check_equal(command) : check(command);
    if (variation_ != nullptr && !case_is_left_out_ && !case_is_unjudged_) ++outcome_.left_out;
    (void)execute(command);  // whatever it gives
    return expectation_.use_up();
  }
  const auto result = execute(command);
  if (result) return;
  note(command.start.line, result.error().text());
  // Errors before the setup and in the teardown do not count.
  if (section_ != Section::setup) return;
  fail(command.start.line, "the setup failed: " + result.error().text());
  print("    command: " + command.text);
  section_ = Section::broken;
}

bool TestRun::is_judged() const {
  if (case_is_unjudged_ || case_is_left_out_) return false;
  return variation_ == nullptr || case_variations_.contains(variation_->kind());
}

void TestRun::check(const CommandText& command) {
  auto result = execute(command);
  const std::vector<std::string> notes = diagnostics_.summary();
  expectation_.value = comparable(std::move(expectation_.value));
  if (result) result = comparable(std::move(result).value());
  conclude(command, result, judge(expectation_, result, notes, tolerance_));
}

// Without the order that does not count, so that the place of a difference is one in the shown text.
NestedList TestRun::comparable(NestedList list) const {
  if (variation_ != nullptr)
    list = with_changed_value(list, [&](const TypeExpr& type, const NestedList& value) {
      return frame_free(variation_->registry(), type, value);
    });
  return expectation_.kind == Expectation::Kind::set ? with_sorted_tuples(std::move(list)) : list;
}

// The type's own equality is asked for by a query; both values are asked for only after a failure.
void TestRun::check_equal(const CommandText& command) {
  const auto expression = queried_expression(command.text);
  if (!expression) {
    expectation_ = Expectation::with_problem("#yields equal: expected a query");
    return check(command);
  }
  const CommandText comparison{"query (" + *expression + ") = (" + expectation_.text + ")", command.start};
  const auto answer = execute(comparison);
  const NestedList yes = NestedList::list(NestedList::symbol("bool"), NestedList(true));
  if (answer && *answer == yes) return conclude(command, answer, {});
  if (!answer) return conclude(comparison, answer, {.is_right = false, .why = "expected no error"});
  const auto wanted = execute({"query " + expectation_.text, command.start});
  const auto found = execute(command);
  Verdict verdict{.is_right = false, .why = "expected an equal value"};
  if (wanted && found)
    if (auto difference = first_difference(*wanted, *found, {})) verdict.why += ", but " + difference->text();
  conclude(command, found, verdict);
}

void TestRun::conclude(const CommandText& command, const Result<NestedList>& result, const Verdict& verdict) {
  if (verdict.is_right) {
    ++outcome_.passed;
    return expectation_.use_up();
  }
  fail(command.start.line, verdict.why);
  print("    command: " + command.text);
  print("    expected: " + expectation_.shown(verdict.difference));
  if (result)
    print("    found: " + excerpt(*result, verdict.difference.path));
  else
    print("    found: error: " + result.error().text());
  for (const std::string& line : diagnostics_.summary()) print("    note: " + line);
  expectation_.use_up();
}

}  // namespace queries
