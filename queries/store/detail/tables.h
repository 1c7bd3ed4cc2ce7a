#pragma once

#include <array>
#include <cstdint>

namespace queries {

/// Application id in the header of every algebra3d database: "A3DB".
inline constexpr std::int64_t kApplicationId = 0x41334442;
/// Application id of a database under construction, until it gets its name: "A3DR".
inline constexpr std::int64_t kDraftApplicationId = 0x41334452;
/// Version of new databases, docs/file_format.md. Newer versions are refused.
inline constexpr std::int64_t kDatabaseVersion = 5;
/// The first version with row groups. A file of the version before becomes one when its first row group is written.
inline constexpr std::int64_t kFirstVersionWithRowGroups = 5;
/// The table that came with it.
inline constexpr const char* kRowGroupsTable = "row_groups";
/// The last version whose pages have no checksums. Older files are upgraded to it at the first write: room for
/// checksums is made with a file only.
inline constexpr std::int64_t kLastVersionWithoutPageSums = 3;
/// The first version with stored spatial indexes.
inline constexpr std::int64_t kFirstVersionWithIndexPages = 3;
/// The table that came with it.
inline constexpr const char* kIndexPagesTable = "index_pages";

inline constexpr const char* kCreateCatalogue =
    "CREATE TABLE catalogue(id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE COLLATE BINARY, type TEXT NOT NULL, "
    "has_value INTEGER NOT NULL, function_text TEXT NOT NULL, table_number INTEGER NOT NULL, tuple_count INTEGER NOT "
    "NULL, next_tuple INTEGER NOT NULL, tuple_sum INTEGER NOT NULL, index_relation TEXT NOT NULL, index_attribute TEXT "
    "NOT NULL, value_sum INTEGER NOT NULL, derived_text TEXT NOT NULL, checksum INTEGER NOT NULL)";
inline constexpr const char* kCreateNamedTypes =
    "CREATE TABLE named_types(name TEXT PRIMARY KEY NOT NULL, type TEXT NOT NULL, checksum INTEGER NOT NULL)";
inline constexpr const char* kCreateAbandoned =
    "CREATE TABLE abandoned(number INTEGER PRIMARY KEY, name TEXT NOT NULL)";

inline constexpr const char* kCreateIndexPages =
    "CREATE TABLE index_pages(place INTEGER PRIMARY KEY, checksum INTEGER NOT NULL, bytes BLOB NOT NULL)";

inline constexpr const char* kCreateChunks =
    "CREATE TABLE chunks(owner INTEGER NOT NULL, tuple INTEGER NOT NULL, attribute INTEGER NOT NULL, part INTEGER NOT "
    "NULL, bytes BLOB NOT NULL)";
inline constexpr const char* kCreateChunkIndex =
    "CREATE UNIQUE INDEX chunks_by_place ON chunks(owner, tuple, attribute, part)";

/// Row groups of relations, and their column chunks: docs/file_format.md, "Row groups".
inline constexpr const char* kCreateRowGroups =
    "CREATE TABLE row_groups(relation INTEGER NOT NULL, first INTEGER NOT NULL, last INTEGER NOT NULL, count INTEGER "
    "NOT NULL, ids BLOB NOT NULL, dead BLOB NOT NULL, columns BLOB NOT NULL, checksum INTEGER NOT NULL, PRIMARY "
    "KEY(relation, first)) WITHOUT ROWID";
inline constexpr const char* kCreateColumnChunks =
    "CREATE TABLE column_chunks(relation INTEGER NOT NULL, attribute INTEGER NOT NULL, first INTEGER NOT NULL, bytes "
    "BLOB NOT NULL, PRIMARY KEY(relation, attribute, first)) WITHOUT ROWID";

/// Levels of detail, in files that have some. Programs that know nothing of them go on working: they leave levels of
/// values that they change, which are found for no other value.
inline constexpr const char* kCreateShapeLevels =
    "CREATE TABLE IF NOT EXISTS shape_levels(owner INTEGER NOT NULL, tuple INTEGER NOT NULL, attribute INTEGER NOT "
    "NULL, number INTEGER NOT NULL, value_sum INTEGER NOT NULL, checksum INTEGER NOT NULL, bytes BLOB NOT NULL, "
    "PRIMARY KEY(owner, tuple, attribute, number))";

/// How much of tables of a server was put into relations, in files that have some. Programs that know nothing of it go
/// on working: they leave rows of relations that they remove.
inline constexpr const char* kCreatePulledTables =
    "CREATE TABLE IF NOT EXISTS pulled_tables(relation INTEGER NOT NULL, source TEXT NOT NULL, place TEXT NOT NULL, "
    "count INTEGER NOT NULL, checksum INTEGER NOT NULL, PRIMARY KEY(relation, source))";

/// SQL statements that create the tables of a new database; relations add their own.
inline constexpr std::array kCreateTables = {
    "CREATE TABLE meta(id INTEGER PRIMARY KEY, next_number INTEGER NOT NULL, object_count INTEGER NOT NULL, "
    "object_sum INTEGER NOT NULL)",
    "INSERT INTO meta VALUES(1, 1, 0, 1)",
    kCreateCatalogue,
    kCreateNamedTypes,
    kCreateAbandoned,
    "CREATE TABLE object_values(id INTEGER PRIMARY KEY, value BLOB)",
    kCreateChunks,
    kCreateChunkIndex,
    kCreateIndexPages,
    kCreateRowGroups,
    kCreateColumnChunks,
    "CREATE TABLE imported_files(relation INTEGER NOT NULL, path TEXT NOT NULL, size INTEGER NOT NULL, hash INTEGER "
    "NOT NULL, PRIMARY KEY(relation, path))",
};

}  // namespace queries
