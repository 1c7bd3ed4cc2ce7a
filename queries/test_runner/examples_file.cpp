// `.examples` files (docs/language.md, "Examples") as steps of a test file.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "algebra3d/values/types/nested_list.h"
#include "base/number_text.h"
#include "base/propagate.h"
#include "queries/test_runner/detail/test_file.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::NestedList;
using algebra3d::Result;
using algebra3d::Status;

constexpr std::array<std::string_view, 10> kKeys = {"Sequential", "Database", "Restore", "Operator", "Number",
                                                    "Signature",  "Example",  "Result",  "Remark",   "Tolerance"};
constexpr std::string_view kPlatform = "linux";
// Relative, and so small that the floor of the comparison holds.
constexpr std::string_view kDefaultTolerance = "%1e-13";

/// `Key : value`, with the lines that continue it.
struct Entry {
  std::string key;
  std::string value;
  int line = 0;
};

std::optional<Entry> entry_of(std::string_view line, int number) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const std::string_view key = trimmed(line.substr(0, colon));
  if (std::ranges::find(kKeys, key) == kKeys.end()) return std::nullopt;
  return Entry{std::string(key), std::string(trimmed(line.substr(colon + 1))), number};
}

/// The lines between one `Operator` and the next.
struct Block {
  std::string name;
  std::string alias;  ///< the name, unless another one was given
  int line = 0;
  std::map<std::string, Entry> entries;

  const Entry* find(const std::string& key) const {
    const auto found = entries.find(key);
    return found == entries.end() ? nullptr : &found->second;
  }
  const std::string& text(const std::string& key) const { return entries.at(key).value; }
};

class ExamplesReader {
 public:
  explicit ExamplesReader(const std::string& file) : file_(file) {}

  Result<std::vector<TestStep>> read(std::string_view content) {
    A3D_TRY(read_entries(content));
    const auto first = std::ranges::find(entries_, "Operator", &Entry::key);
    A3D_TRY(add_header({entries_.begin(), first}));
    for (auto begin = first; begin != entries_.end();) {
      const auto end = std::find_if(begin + 1, entries_.end(), [](const Entry& e) { return e.key == "Operator"; });
      A3D_ASSIGN(const Block block, block_of({begin, end}));
      A3D_TRY(add_block(block));
      begin = end;
    }
    return std::move(steps_);
  }

 private:
  Error error(int line, std::string message) const { return {ErrorCode::file_format, at(line) + std::move(message)}; }
  std::string at(int line) const { return fmt::format("{}:{}: ", file_, line); }

  void add(std::string word, std::string argument, int line) {
    steps_.emplace_back(Directive{std::move(word), std::move(argument), line});
  }
  void add_command(std::string text, int line) { steps_.emplace_back(CommandText{std::move(text), {file_, line, 1}}); }

  Status read_entries(std::string_view content) {
    for (int number = 1; !content.empty(); ++number) {
      const std::string_view line = take_line(content);
      if (trimmed(line).empty() || line.starts_with('#')) continue;
      if (auto entry = entry_of(line, number)) {
        entries_.push_back(std::move(*entry));
        continue;
      }
      if (entries_.empty())
        return error(number, "expected `Database: NAME` or `Operator : NAME`, found '" + std::string(line) + "'");
      entries_.back().value += '\n' + std::string(trimmed(line));
    }
    return {};
  }

  Status add_header(const std::vector<Entry>& entries) {
    std::string database;
    bool restores = false;
    int line = 1;
    for (const Entry& entry : entries) {
      if (entry.key == "Database") {
        database = entry.value;
        line = entry.line;
      } else if (entry.key == "Restore") {
        restores = entry.value == "YES" || entry.value == "yes";
        if (!restores && entry.value != "NO" && entry.value != "no")
          return error(entry.line, "expected `Restore : YES` or `Restore : no`, found '" + entry.value + "'");
      } else if (entry.key != "Sequential") {
        return error(entry.line, "'" + entry.key + "' stands before the first Operator");
      }
    }
    add("setup", "examples", line);
    if (database.empty()) return {};
    if (restores) {
      add_command(fmt::format("restore database {0} from {0}", database), line);
      return {};
    }
    // The folder of the run is empty, so that the database cannot be there.
    add_command("create database " + database, line);
    add_command("open database " + database, line);
    return {};
  }

  Result<Block> block_of(const std::vector<Entry>& entries) {
    Block block;
    block.line = entries.front().line;
    const std::string& name = entries.front().value;
    const std::size_t word_end = name.find_first_of(" \t");
    block.name = name.substr(0, word_end);
    const std::string_view rest = word_end == std::string::npos ? "" : trimmed(std::string_view(name).substr(word_end));
    const bool has_alias = rest.starts_with("alias ");
    block.alias = has_alias ? trimmed(rest.substr(6)) : block.name;
    if (block.name.empty() || (!rest.empty() && !has_alias))
      return error(block.line, "expected `Operator : NAME` or `Operator : NAME alias WORD`, found '" + name + "'");
    for (const Entry& entry : entries)
      if (!block.entries.emplace(entry.key, entry).second)
        return error(entry.line, "duplicate '" + entry.key + "' in one block");
    for (const char* key : {"Number", "Signature", "Example", "Result"})
      if (block.find(key) == nullptr)
        return error(block.line, fmt::format("operator {}: '{}' is missing", block.name, key));
    return block;
  }

  Status add_block(const Block& block) {
    const std::string& number = block.text("Number");
    const int number_line = block.find("Number")->line;
    if (!algebra3d::parse_int(number)) return error(number_line, "expected a number, found '" + number + "'");
    if (!numbers_.emplace(block.name, number).second)
      return error(number_line, fmt::format("operator {} has two examples with the number {}", block.name, number));
    add("testcase", block.name + " " + number, block.line);
    const Entry* tolerance = block.find("Tolerance");
    add("tolerance_real", tolerance != nullptr ? tolerance->value : std::string(kDefaultTolerance),
        tolerance != nullptr ? tolerance->line : block.line);
    A3D_ASSIGN(const bool is_run, add_result(block, block.text("Result")));
    if (!is_run) return {};
    std::string_view command = trimmed(block.text("Example"));
    while (command.ends_with(';')) command = trimmed(command.substr(0, command.size() - 1));
    add_command(std::string(command), block.find("Example")->line);
    return {};
  }

  /// Adds the result of the example; false if it must not be run.
  Result<bool> add_result(const Block& block, const std::string& result) {
    const int line = block.find("Result")->line;
    const Entry* remark = block.find("Remark");
    const std::string reason = remark != nullptr ? remark->value : "";
    if (result == "crashes") {
      add("description", fmt::format("  {} {} is not run: it crashes. {}", block.name, block.text("Number"), reason),
          line);
      return false;
    }
    if (result == "unpredictable" && reason.empty())
      return error(line, "an unpredictable result needs a Remark that says why");
    if (result == "bug")
      add("unjudged", reason, line);
    else if (result == "unpredictable")
      add("yields", "success", line);
    else if (result == "file")
      add("yields", "@" + block.alias + "_" + block.text("Number") + ".result", line);
    else
      return add_list_result(block, result, line);
    return true;
  }

  Result<bool> add_list_result(const Block& block, const std::string& result, int line) {
    auto list = NestedList::parse(result);
    if (!list) return error(line, "Result: " + list.error().text());
    const bool is_choice = list->is_list() && !list->elements().empty() && list->elements()[0].is_symbol("platform");
    if (is_choice) return add_platform_result(block, *list, line);
    if (list->is_int() || list->is_real()) {
      add("yields", "number " + list->print(), line);
      return true;
    }
    const char* type = list->is_bool() ? "bool" : list->is_string() ? "string" : list->is_text() ? "text" : nullptr;
    if (type == nullptr && !list->is_list())
      return error(line, "expected an atom, a list (T V), file, bug, unpredictable, crashes or (platform ...), found " +
                             list->print_short());
    add("yields", type != nullptr ? fmt::format("({} {})", type, list->print()) : result, line);
    return true;
  }

  // `(platform (linux R) (win32 R))`
  Result<bool> add_platform_result(const Block& block, const NestedList& choice, int line) {
    for (const NestedList& row : choice.elements()) {
      const bool is_ours = row.is_list() && row.elements().size() == 2 && row.elements()[0].is_symbol(kPlatform);
      if (is_ours) return add_result(block, row.elements()[1].print());
    }
    return error(line, fmt::format("there is no result for the platform {}", kPlatform));
  }

  const std::string& file_;
  std::vector<Entry> entries_;
  std::set<std::pair<std::string, std::string>> numbers_;
  std::vector<TestStep> steps_;
};

}  // namespace

Result<std::vector<TestStep>> read_example_steps(std::string_view content, const std::string& file) {
  return ExamplesReader(file).read(content);
}

}  // namespace queries
