#include "queries/test_runner/test_runner.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <system_error>

#include "algebra3d/base/number_text.h"
#include "queries/session/session.h"
#include "queries/test_runner/expectation.h"
#include "queries/test_runner/test_file.h"

namespace queries {
namespace {

using algebra3d::Diagnostics;
using algebra3d::Registry;
namespace fs = std::filesystem;

Result<std::string> read_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file)) return Error{ErrorCode::file_missing, "cannot read '{}'", file.string()};
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

/// A folder that is removed with everything in it.
class ScratchFolder {
 public:
  static Result<std::unique_ptr<ScratchFolder>> make() {
    std::string name = (fs::temp_directory_path() / "algebra3d-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) return Error{ErrorCode::io_error, "cannot make the folder '{}'", name};
    return std::unique_ptr<ScratchFolder>(new ScratchFolder(name));
  }
  ~ScratchFolder() {
    std::error_code ignored;  // a destructor has nobody to tell
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  explicit ScratchFolder(fs::path path) : path_(std::move(path)) {}
  fs::path path_;
};

class ResultCollector final : public Presenter {
 public:
  Status present(const TypeExpr& type, const Datum& value, Context& context) override {
    ASSIGN_OR_RETURN(result_, result_list(type, value, context));
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

/// What the next command is to give. A kind persists; a value, an error text and an expression are used up by a
/// command.
struct Expectation {
  enum class Kind : std::uint8_t { value, set, equal, undefined, success, error };
  Kind kind = Kind::value;
  NestedList value;
  std::string text;
  std::string problem;  ///< why the directive could not be understood

  void clear_value() {
    value = NestedList();
    text.clear();
    problem.clear();
    if (kind == Kind::set || kind == Kind::equal || kind == Kind::undefined) kind = Kind::value;
  }
};

std::string replaced(std::string text, std::string_view from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

// `$(NAME)` stands for the environment variable, and for nothing if there is none.
std::string with_variables(const std::string& text) {
  std::string result;
  for (std::size_t position = 0; position < text.size();) {
    const std::size_t begin = text.find("$(", position);
    const std::size_t end = begin == std::string::npos ? begin : text.find(')', begin);
    result += text.substr(position, begin - position);
    if (end == std::string::npos) break;
    const char* value = std::getenv(text.substr(begin + 2, end - begin - 2).c_str());  // NOLINT(concurrency-mt-unsafe)
    if (value != nullptr) result += value;
    position = end + 1;
  }
  return result;
}

class TestRun {
 public:
  TestRun(const fs::path& file, fs::path scratch, const Registry& registry, TestOptions options)
      : folder_(fs::absolute(file).parent_path()),
        scratch_(std::move(scratch)),
        options_(std::move(options)),
        session_(registry, {.folder = scratch_, .read_only = false}) {}

  Result<TestOutcome> run(const std::vector<TestStep>& steps) {
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

 private:
  enum class Section : std::uint8_t { start, setup, cases, broken, teardown };

  void print(const std::string& line) const { options_.print(line); }

  void fail(int line, const std::string& why) {
    ++outcome_.failed;
    outcome_.failures.push_back(fmt::format("{}@{}", case_number_, line));
    print(fmt::format("  FAILED {}@{} {}: {}", case_number_, line, case_name_, why));
  }

  void obey(const Directive& directive) {
    if (directive.word == "setup") section_ = Section::setup;
    if (directive.word == "description") print(directive.argument);
    if (directive.word == "stop" && section_ == Section::start)
      outcome_.skipped = directive.argument.empty() ? "stopped" : directive.argument;
    if (directive.word == "teardown") section_ = Section::teardown;
    if (directive.word == "tolerance_real") set_tolerance(directive);
    if (directive.word == "testcase" && (section_ == Section::setup || section_ == Section::cases)) {
      section_ = Section::cases;
      ++case_number_;
      case_name_ = directive.argument;
      expectation_.clear_value();
    }
    if (directive.word == "yields" && section_ == Section::cases) set_expectation(directive);
  }

  void set_tolerance(const Directive& directive) {
    const bool is_relative = directive.argument.starts_with('%');
    const auto value = algebra3d::parse_real(directive.argument.substr(is_relative ? 1 : 0));
    if (!value || *value < 0)
      return fail(directive.line, "#tolerance_real: expected a number, got " + directive.argument);
    tolerance_ = {is_relative ? *value / 100 : *value, is_relative};
  }

  void set_expectation(const Directive& directive) {
    using Kind = Expectation::Kind;
    const std::string& text = directive.argument;
    expectation_ = {};
    if (text == "success") {
      expectation_.kind = Kind::success;
    } else if (text.starts_with("error")) {
      expectation_.kind = Kind::error;
      if (text != "error") set_quoted_text(text.substr(5));
    } else if (text.starts_with("undefined")) {
      expectation_.kind = Kind::undefined;
      set_quoted_text(text.substr(9));
    } else if (text.starts_with("equal ")) {
      expectation_.kind = Kind::equal;
      expectation_.text = text.substr(6);
    } else if (text.starts_with("set ")) {
      expectation_.kind = Kind::set;
      set_value(text.substr(4));
    } else if (text.starts_with('@')) {
      const fs::path file = folder_ / with_variables(text.substr(1));
      auto content = read_file(file);
      content ? set_value(with_variables(*content)) : set_problem(content.error().message);
    } else if (text.starts_with('*')) {
      set_value_of(text.substr(1));
    } else if (text.starts_with('(')) {
      set_value(text);
    } else {
      set_problem("unknown yields value: " + text);
    }
  }

  void set_problem(std::string problem) { expectation_.problem = std::move(problem); }

  void set_quoted_text(const std::string& quoted) {
    auto parsed = NestedList::parse(quoted);
    if (!parsed || !parsed->is_string()) return set_problem("#yields: expected a string, got " + quoted);
    expectation_.text = parsed->as_string();
  }

  void set_value(const std::string& text) {
    auto parsed = NestedList::parse(text);
    if (!parsed) return set_problem("#yields: " + parsed.error().message);
    expectation_.value = std::move(parsed).value();
  }

  void set_value_of(const std::string& name) {
    auto result = execute({"query " + name, {}});
    if (!result) return set_problem("query " + name + ": " + result.error().message);
    expectation_.value = std::move(result).value();
  }

  Result<NestedList> execute(const CommandText& command) {
    diagnostics_.clear();
    Context context{diagnostics_, options_.cancel, folder_};
    const std::string text = replaced(command.text, "$(SCRATCH)", scratch_.string());
    ResultCollector collector;
    RETURN_IF_ERROR(session_.execute(text, command.start, collector, context));
    return collector.take();
  }

  void run_command(const CommandText& command) {
    if (section_ == Section::broken) return;
    if (section_ == Section::cases && expectation_.kind == Expectation::Kind::equal) return check_equal(command);
    auto result = execute(command);
    if (section_ == Section::cases) {
      check(command, result);
      return;
    }
    if (result) return;
    print(fmt::format("  line {}: {}", command.start.line, result.error().message));
    // Errors before the setup and in the teardown do not count.
    if (section_ != Section::setup) return;
    fail(command.start.line, "the setup failed");
    section_ = Section::broken;
  }

  void check_equal(const CommandText& command) {
    CommandText comparison = command;
    const std::string expression = command.text.starts_with("query") ? command.text.substr(5) : "";
    comparison.text = "query (" + expression + ") = (" + expectation_.text + ")";
    auto result = execute(comparison);
    expectation_.kind = Expectation::Kind::value;
    expectation_.value = NestedList::list(NestedList::symbol("bool"), NestedList(true));
    check(command, result);
  }

  void check(const CommandText& command, const Result<NestedList>& result) {
    const std::string why = !expectation_.problem.empty() ? expectation_.problem : verdict(result);
    if (why.empty()) {
      ++outcome_.passed;
    } else {
      fail(command.start.line, why);
      print("    command: " + command.text);
      if (!result) print("    error: " + result.error().message);
      for (const std::string& line : diagnostics_.summary()) print("    note: " + line);
    }
    expectation_.clear_value();
  }

  /// Empty if the result is as expected.
  std::string verdict(const Result<NestedList>& result) const {
    using Kind = Expectation::Kind;
    if (expectation_.kind == Kind::error) {
      if (result) return "expected an error, found " + result->print_short(200);
      if (result.error().message.find(expectation_.text) != std::string::npos) return "";
      return R"(expected an error that contains ")" + expectation_.text + R"(")";
    }
    if (!result) return "expected no error";
    if (expectation_.kind == Kind::success) return "";
    if (expectation_.kind == Kind::undefined) return undefined_verdict(*result);
    if (expectation_.kind == Kind::set)
      return first_difference(with_sorted_tuples(expectation_.value), with_sorted_tuples(*result), tolerance_);
    return first_difference(expectation_.value, *result, tolerance_);
  }

  /// The value is undefined, and a note says why.
  std::string undefined_verdict(const NestedList& result) const {
    const bool is_undefined = result.is_list() && result.elements().size() == 2 && result.elements()[1].is_undefined();
    if (!is_undefined) return "expected an undefined value, found " + result.print_short(200);
    for (const std::string& note : diagnostics_.summary())
      if (note.find(expectation_.text) != std::string::npos) return "";
    return R"(expected a note that contains ")" + expectation_.text + R"(")";
  }

  fs::path folder_;
  fs::path scratch_;
  TestOptions options_;
  Session session_;
  Diagnostics diagnostics_;
  Section section_ = Section::start;
  Expectation expectation_;
  Tolerance tolerance_;
  int case_number_ = 0;
  std::string case_name_;
  TestOutcome outcome_;
};

}  // namespace

Result<TestOutcome> run_test_file(const fs::path& file, const Registry& registry, const TestOptions& options) {
  ASSIGN_OR_RETURN(const std::string content, read_file(file));
  ASSIGN_OR_RETURN(const auto scratch, ScratchFolder::make());
  return TestRun(file, scratch->path(), registry, options).run(read_test_steps(content, file.string()));
}

}  // namespace queries
