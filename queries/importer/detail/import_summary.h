#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "queries/importer/detail/file_loader.h"
#include "queries/importer/detail/relation_writer.h"
#include "queries/importer/file_list.h"

namespace queries {

/// The numbers of an import so far.
struct ImportSummary {
  using Clock = std::chrono::steady_clock;

  std::uint64_t file_count = 0;  ///< number of files
  std::uint64_t byte_count = 0;  ///< their size when they were listed
  Clock::time_point start = Clock::now();

  std::uint64_t known_count = 0;  ///< imported before and unchanged
  std::uint64_t inserted_count = 0;
  std::uint64_t replaced_count = 0;
  std::uint64_t kept_count = 0;       ///< could not be read; their tuples of an earlier import were kept
  std::uint64_t solid_count = 0;      ///< inserted or replaced files with a solid
  std::uint64_t repaired_count = 0;   ///< of the solids
  std::uint64_t wrong_count = 0;      ///< of the solids: the header announces another number of triangles
  std::uint64_t undefined_count = 0;  ///< inserted or replaced files without a solid
  std::uint64_t dropped_count = 0;    ///< deleted tuples of deleted files
  std::uint64_t triangle_count = 0;
  std::uint64_t done_bytes = 0;
  std::map<std::string, std::uint64_t> skipped;  ///< ignored files, by ending
  std::map<std::string, std::uint64_t> reasons;  ///< files by kind of reason; a file may have several

  ImportSummary() = default;
  explicit ImportSummary(const FileList& list);

  /// Counts a file. `written`: what the writer did with it.
  void count(const LoadedFile& file, RelationWriter::Written written);
  std::uint64_t done_count() const { return known_count + inserted_count + replaced_count + kept_count; }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start).count(); }
  double megabytes_per_second() const;
};

/// The kinds of reasons in the status of a file without a solid, without file name, places and numbers, so that similar
/// files have equal kinds. "no valid solid: 12 boundary edges (facet 3, near (0 0 1)), 1 intersecting pair (...)"
/// yields "boundary edges" and "intersecting pairs"; "...; not repaired: 2 holes were left open (...)" yields "not
/// repaired: N holes were left open".
std::vector<std::string> reason_kinds(const LoadedFile& file);

/// The table at the end of an import, for people.
std::string summary_table(const ImportSummary& summary, std::string_view relation, std::uint64_t batch_count);

}  // namespace queries
