#include "queries/importer/detail/import_progress.h"

#include <fmt/format.h>

#include "algebra3d/values/types/utf8.h"

namespace queries {

// By bytes, which is what takes the time, and by files if all of them are empty.
double done_part(const ImportSummary& summary) {
  const std::uint64_t total = summary.byte_count > 0 ? summary.byte_count : summary.file_count;
  const std::uint64_t done = summary.byte_count > 0 ? summary.done_bytes : summary.done_count();
  return total == 0 ? 0 : static_cast<double>(done) / static_cast<double>(total);
}

std::string progress_text(const ImportSummary& summary, std::uint64_t pending_count,
                          const std::optional<FileLoader::AtWork>& at_work) {
  constexpr std::chrono::seconds kLong{3};
  std::string text =
      fmt::format("{}/{} files, {:.1f} MB/s, {} undefined, {} in this batch", summary.done_count(), summary.file_count,
                  summary.megabytes_per_second(), summary.undefined_count, pending_count);
  if (!at_work || at_work->time < kLong) return text;
  return text + fmt::format(", {} for {} s",
                            algebra3d::shown_as_text(at_work->path.substr(at_work->path.rfind('/') + 1)),
                            std::chrono::duration_cast<std::chrono::seconds>(at_work->time).count());
}

}  // namespace queries
