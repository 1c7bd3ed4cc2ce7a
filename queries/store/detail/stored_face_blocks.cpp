#include "queries/store/detail/stored_face_blocks.h"

#include <utility>

#include "algebra3d/values/types/spatial.h"
#include "base/propagate.h"
#include "queries/store/detail/database.h"

namespace queries {
namespace {

using algebra3d::Error;
using algebra3d::ErrorCode;
using algebra3d::FaceBlockList;
using algebra3d::Result;
using algebra3d::Status;
using algebra3d::Surface3d;
using algebra3d::TriangleMesh;
using algebra3d::TypeOf;
using algebra3d::Volume3d;

/// Loading fewer faces, with a hierarchy for them, takes some milliseconds.
constexpr std::size_t kFewestFaces = 50'000;
/// Numbers of levels of detail are numbers of triangles, which are smaller.
constexpr std::uint64_t kListNumber = std::uint64_t{1} << 62U;

std::uint64_t number_of_block(std::size_t block) {
  return kListNumber + 1 + block;
}

class StoredFaceBlocks final : public algebra3d::FaceBlocks {
 public:
  StoredFaceBlocks(FaceBlockList list, std::shared_ptr<Database> database, const LevelPlace& place,
                   std::uint64_t checksum)
      : FaceBlocks(std::move(list)),
        database_(std::move(database)),
        statement_(database_->statement()),
        place_(place),
        checksum_(checksum) {}

 protected:
  Result<TriangleMesh> faces_of(std::uint32_t block) const override {
    A3D_TRY(database_->check_statement(statement_));
    const FaceBlockList::Block& listed = list().blocks[block];
    Result<TriangleMesh> mesh = TriangleMesh();
    A3D_ASSIGN(const bool is_there,
               read_level(database_->connection(), {place_, checksum_, number_of_block(block)},
                          [&](std::string_view bytes) { mesh = decode_face_block(bytes, listed); }));
    if (!is_there)
      return Error{ErrorCode::database_corrupt, "a block of faces of a stored value is missing"}.about(
          database_->connection().file());
    database_->note_block_faces(place_, checksum_, listed.face_count);
    return mesh;
  }

 private:
  std::shared_ptr<Database> database_;
  std::uint64_t statement_;
  LevelPlace place_;
  std::uint64_t checksum_;
};

const algebra3d::Geometry& geometry_of(const algebra3d::Value& value) {
  return &value.type() == &TypeOf<Volume3d>::type() ? value.get<Volume3d>().geometry()
                                                    : value.get<Surface3d>().geometry();
}

}  // namespace

bool may_have_face_blocks(const algebra3d::Type& type, std::size_t face_count) {
  return (&type == &TypeOf<Volume3d>::type() || &type == &TypeOf<Surface3d>::type()) && face_count >= kFewestFaces;
}

Result<std::shared_ptr<const algebra3d::FaceBlocks>> find_face_blocks(const std::shared_ptr<Database>& database,
                                                                      const LevelPlace& place, std::uint64_t checksum,
                                                                      const algebra3d::GeometryHeader& header) {
  using FoundBlocks = std::shared_ptr<const algebra3d::FaceBlocks>;
  constexpr std::size_t kPart = 2;
  if (database->block_faces(place, checksum) * kPart > header.size) return FoundBlocks();
  Result<FaceBlockList> list = FaceBlockList();
  A3D_ASSIGN(const bool is_there,
             read_level(database->connection(), {place, checksum, kListNumber}, [&](std::string_view bytes) {
               list = decode_face_block_list(bytes, header.box, header.size);
             }));
  if (!is_there) return FoundBlocks();
  if (!list) return std::move(list).error().about(database->connection().file());
  return FoundBlocks(std::make_shared<StoredFaceBlocks>(*std::move(list), database, place, checksum));
}

Status write_face_blocks(SqliteConnection& connection, const BlockedValue& value) {
  const auto write = [&](std::uint64_t number, std::string_view bytes) {
    return write_level(connection, {value.place, value.checksum, number}, bytes);
  };
  return algebra3d::encode_face_blocks(
      geometry_of(value.value), [&](std::string_view bytes) { return write(kListNumber, bytes); },
      [&](std::size_t block, std::string_view bytes) { return write(number_of_block(block), bytes); });
}

bool is_of_face_blocks(std::uint64_t number) {
  return number >= kListNumber;
}

}  // namespace queries
