// The part of the integrity check that looks at levels of detail. A level that belongs to no value is not a defect:
// programs that know of no levels leave them when they change a value.
#include "base/propagate.h"
#include "queries/store/detail/integrity_check.h"
#include "queries/store/detail/shape_levels.h"
#include "queries/store/detail/stored_face_blocks.h"

namespace queries {

Status IntegrityCheck::check_levels() {
  const Finding where{.message = "the table shape_levels, which holds levels of detail: "};
  const auto has_table = has_level_table(database_->connection());
  if (!has_table) return add(where, has_table.error());
  if (!*has_table) return {};
  auto rows = database_->connection().use(
      "SELECT owner, tuple, attribute, number, value_sum, checksum, bytes FROM shape_levels");
  if (!rows) return add(where, rows.error());
  while (true) {
    A3D_TRY(context_.check_cancelled());
    const auto has_row = rows->step();
    if (!has_row) return add(where, has_row.error());
    if (!*has_row) return {};
    const auto number = [&](int column) { return rows->column(column).integer; };
    const LevelKey key{{number(0), number(1), number(2)}, as_unsigned(number(4)), as_unsigned(number(3))};
    const Cell bytes = rows->column(6);
    if (bytes.is(Cell::Kind::blob) && number(5) == key.checksum(bytes.bytes)) continue;
    Finding damaged = where;
    const bool is_block = is_of_face_blocks(key.number);
    damaged.message += fmt::format(
        "the {} {} of owner {}, tuple {}, attribute {} is not what was written; {}", is_block ? "face block" : "level",
        key.number, key.place.owner, key.place.tuple, key.place.attribute,
        is_block ? "save and restore the database, which leaves face blocks out" : "it is made anew when it is needed");
    add(std::move(damaged));
  }
}

}  // namespace queries
