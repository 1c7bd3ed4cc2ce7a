#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "queries/importer/detail/file_loader.h"
#include "queries/importer/detail/import_summary.h"

namespace queries {

/// What is done of an import, as a part of 1.
double done_part(const ImportSummary& summary);

/// The progress in figures; fits beside a bar into 80 columns except for extremely large numbers and long names of
/// files. `pending_count`: files that are not committed yet. A file that has been `at_work` for some seconds is named.
std::string progress_text(const ImportSummary& summary, std::uint64_t pending_count,
                          const std::optional<FileLoader::AtWork>& at_work = {});

}  // namespace queries
