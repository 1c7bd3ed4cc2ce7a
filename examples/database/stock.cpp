// Stores plates in a database, and asks which of them a drill meets and what it leaves of them.
#include <iostream>
#include <string>

#include "algebra3d/database/database.h"

using algebra3d::Result;
using algebra3d::Solid;
using algebra3d::Status;
using algebra3d::database::Database;
using algebra3d::database::Row;
using algebra3d::database::Rows;

namespace {

Status store_plates(Database& database) {
  ALGEBRA3D_RETURN_IF_ERROR(
      database.execute("let Plates = [const rel(tuple([Name: string, Shape: volume3d])) value ()];"
                       "let Plates_Shape = Plates creatertree[Shape];"));
  for (int number = 1; number <= 4; ++number) {
    const double left = 10 * number;
    ALGEBRA3D_ASSIGN_OR_RETURN(const Solid plate, Solid::box({left, 0, 0}, {left + 8, 5, 2}));
    ALGEBRA3D_RETURN_IF_ERROR(database.execute("query Plates inserttuple[$name, $shape] count",
                                               {{"name", "plate " + std::to_string(number)}, {"shape", plate}}));
  }
  return {};
}

Status print_drilled(Database& database, const Solid& drill) {
  const std::string statement =
      "query Plates_Shape Plates windowintersects[bbox($drill)] projectextend[Name; Left: volume(.Shape minus $drill)]";
  ALGEBRA3D_ASSIGN_OR_RETURN(Rows rows, database.query(statement, {{"drill", drill}}));
  return rows.for_each([](const Row& row) { std::cout << row["Name"] << " " << row["Left"] << "\n"; });
}

Status run() {
  ALGEBRA3D_ASSIGN_OR_RETURN(Database database, Database::temporary());  // or Database::open("stock.db")
  ALGEBRA3D_RETURN_IF_ERROR(store_plates(database));
  ALGEBRA3D_ASSIGN_OR_RETURN(const Solid drill, Solid::box({27, 1, -1}, {31, 2, 3}));
  ALGEBRA3D_RETURN_IF_ERROR(print_drilled(database, drill));
  ALGEBRA3D_ASSIGN_OR_RETURN(const auto count, database.value("query Plates count"));
  std::cout << "of " << count << " plates\n";
  return {};
}

}  // namespace

int main() {
  const Status status = run();
  if (!status) std::cerr << status.error().text() << "\n";
  return status ? 0 : 1;
}
