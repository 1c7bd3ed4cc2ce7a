#include "queries/importer/detail/import_summary.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"
#include "base/progress_display.h"

namespace queries {
namespace {

using algebra3d::grouped;

constexpr std::size_t kReasonsShown = 8;
constexpr std::size_t kLongestReason = 72;

// How import_solid words what is wrong with a solid.
constexpr std::string_view kDefects = "no valid solid: ";
constexpr std::string_view kNotRepaired = "; not repaired: ";
constexpr std::string_view kRepaired = "repaired";
constexpr std::string_view kWrongCount = "wrong count: ";
constexpr std::string_view kAtLeast = "at least ";

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

std::string without_parentheses(std::string_view text) {
  std::string rest;
  int depth = 0;
  for (const char letter : text) {
    if (letter == '(') {
      ++depth;
      if (!rest.empty() && rest.back() == ' ') rest.pop_back();
    } else if (letter == ')' && depth > 0) {
      --depth;
    } else if (depth == 0) {
      rest += letter;
    }
  }
  return rest;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  if (from.empty()) return;
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// "12 boundary edges" and "1 boundary edge" give "boundary edges".
std::string defect_kind(std::string_view text) {
  if (text.starts_with(kAtLeast)) text.remove_prefix(kAtLeast.size());
  const bool is_one = text.starts_with("1 ");
  while (!text.empty() && (is_digit(text.front()) || text.front() == ' ')) text.remove_prefix(1);
  std::string kind(text);
  if (!is_one) return kind;
  for (const std::string_view noun : {"edge", "triangle", "pair", "shell"}) {
    const std::size_t at = kind.find(noun);
    if (at != std::string::npos) return kind.insert(at + noun.size(), "s");
  }
  return kind;
}

std::vector<std::string> defect_kinds(std::string_view defects) {
  std::vector<std::string> kinds;
  const std::string text = without_parentheses(defects);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(", ", begin), text.size());
    kinds.push_back(defect_kind(std::string_view(text).substr(begin, end - begin)));
    begin = end + 2;
  }
  return kinds;
}

/// Every run of digits becomes N, but for those in words such as 3MF.
std::string without_numbers(std::string_view text) {
  const auto is_letter = [&](std::size_t at) {
    return at < text.size() && std::isalpha(static_cast<unsigned char>(text[at])) != 0;
  };
  std::string rest;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_digit(text[end])) ++end;
    if (end == at)
      rest += text[at++];
    else
      rest += is_letter(end) || is_letter(at - 1) ? std::string(text.substr(at, end - at)) : "N";
    at = std::max(at, end);
  }
  return rest;
}

/// The kinds in front of the remark on the count, and that.
std::vector<std::string> kinds_with_wrong_count(LoadedFile file, std::size_t at) {
  constexpr std::string_view kSeparator = "; ";
  file.status.resize(at > kSeparator.size() ? at - kSeparator.size() : 0);
  std::vector<std::string> kinds = file.status.empty() ? std::vector<std::string>() : reason_kinds(file);
  kinds.emplace_back("wrong counts of triangles in the header");
  return kinds;
}

}  // namespace

ImportSummary::ImportSummary(const FileList& list) : file_count(list.files.size()), skipped(list.skipped) {
  for (const ListedFile& file : list.files) byte_count += file.size;
}

void ImportSummary::count(const LoadedFile& file, RelationWriter::Written written) {
  done_bytes += file.size;
  if (written == RelationWriter::Written::known) {
    ++known_count;
    return;
  }
  if (written == RelationWriter::Written::inserted) ++inserted_count;
  if (written == RelationWriter::Written::replaced) ++replaced_count;
  if (written == RelationWriter::Written::kept) ++kept_count;
  if (file.solid) {
    ++solid_count;
    if (file.status.starts_with(kRepaired)) ++repaired_count;
    if (file.status.find(kWrongCount) != std::string::npos) ++wrong_count;
    triangle_count += file.solid->mesh().face_count();
    return;
  }
  if (written != RelationWriter::Written::kept) ++undefined_count;
  for (std::string& kind : reason_kinds(file)) ++reasons[std::move(kind)];
}

double ImportSummary::megabytes_per_second() const {
  const double passed = seconds();
  return passed > 0 ? static_cast<double>(done_bytes) / 1e6 / passed : 0;
}

std::vector<std::string> reason_kinds(const LoadedFile& file) {
  if (const std::size_t at = file.status.find(kWrongCount); at != std::string::npos)
    return kinds_with_wrong_count(file, at);
  if (const std::size_t at = file.status.find(kNotRepaired); at != std::string::npos)
    return {"not repaired: " + without_numbers(without_parentheses(file.status.substr(at + kNotRepaired.size())))};
  if (file.status.starts_with(kDefects)) return defect_kinds(std::string_view(file.status).substr(kDefects.size()));
  std::string kind = file.status;
  const std::string file_name = file.path.substr(file.path.find_last_of('/') + 1);
  replace_all(kind, file.path, "FILE");
  replace_all(kind, file_name, "FILE");
  kind = without_numbers(kind);
  replace_all(kind, "\n", " ");
  if (kind.size() <= kLongestReason) return {kind};
  return {std::string(algebra3d::utf8_prefix(kind, kLongestReason)) + "..."};
}

std::string summary_table(const ImportSummary& summary, std::string_view relation, std::uint64_t batch_count) {
  std::string table = fmt::format("import into {}\n", relation);
  const auto row = [&](std::string_view label, std::string_view value) {
    table += fmt::format("  {:<28}{:>14}\n", label, value);
  };
  row("files", grouped(summary.done_count()));
  if (summary.done_count() < summary.file_count)
    row("  not reached", grouped(summary.file_count - summary.done_count()));
  if (summary.known_count > 0) row("  imported before", grouped(summary.known_count));
  row("  solids", grouped(summary.solid_count));
  if (summary.repaired_count > 0) row("  of these repaired", grouped(summary.repaired_count));
  if (summary.wrong_count > 0) row("  with a wrong count", grouped(summary.wrong_count));
  row("  undefined", grouped(summary.undefined_count));
  if (summary.replaced_count > 0) row("  of these replaced", grouped(summary.replaced_count));
  if (summary.kept_count > 0) row("  unreadable, left as before", grouped(summary.kept_count));
  if (summary.dropped_count > 0) row("deleted with their files", grouped(summary.dropped_count));
  row("triangles", grouped(summary.triangle_count));
  row("batches", grouped(batch_count));
  row("seconds", fmt::format("{:.1f}", summary.seconds()));
  row("MB/s", fmt::format("{:.1f}", summary.megabytes_per_second()));
  if (!summary.skipped.empty())
    table += fmt::format("ignored because of their endings: {}\n", skipped_text(summary.skipped));
  if (summary.reasons.empty()) return table;

  std::vector<std::pair<std::string, std::uint64_t>> reasons(summary.reasons.begin(), summary.reasons.end());
  std::stable_sort(reasons.begin(), reasons.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  table += "why undefined or unreadable (a file may have several reasons)\n";
  for (std::size_t i = 0; i < std::min(reasons.size(), kReasonsShown); ++i)
    table += fmt::format("  {:>8}  {}\n", grouped(reasons[i].second), reasons[i].first);
  if (reasons.size() > kReasonsShown)
    table += fmt::format("  and {} other kinds; the attribute Status has the reason of every file\n",
                         reasons.size() - kReasonsShown);
  return table;
}

}  // namespace queries
