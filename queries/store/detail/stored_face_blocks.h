#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "algebra3d/values/types/face_blocks.h"
#include "algebra3d/values/types/value.h"
#include "queries/store/detail/shape_levels.h"

namespace queries {

/// A surface or solid in memory that the file holds, and where.
struct BlockedValue {
  LevelPlace place;
  std::uint64_t checksum = 0;  ///< of the encoded value
  std::string presence_sql;    ///< as StoredBytes::presence_sql
  algebra3d::Value value;
};

/// True for surfaces and solids of so many faces that reading blocks of them can pay.
bool may_have_face_blocks(const algebra3d::Type& type, std::size_t face_count);

/// The face blocks of a stored value with this header, in rows of the table of levels: docs/file_format.md. Null if
/// the file lacks them, or if the faces that were read in blocks since it was opened come near to those of the value:
/// then the value is to be loaded. Valid while the running statement runs; may be used by several threads. Errors:
/// database_corrupt.
algebra3d::Result<std::shared_ptr<const algebra3d::FaceBlocks>> find_face_blocks(
    const std::shared_ptr<Database>& database, const LevelPlace& place, std::uint64_t checksum,
    const algebra3d::GeometryHeader& header);
/// Writes them. Call within a transaction.
algebra3d::Status write_face_blocks(SqliteConnection& connection, const BlockedValue& value);

/// Whether the number of a level is that of a face block or of their list.
bool is_of_face_blocks(std::uint64_t number);

}  // namespace queries
