// Parts of the subject of an error.
#include "base/error_subject.h"

#include <string>

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

Error about_tuple() {
  return Error{ErrorCode::database_corrupt, "it is damaged"}.about("tuple 5").about("Parts");
}

TEST(ErrorSubject, APlaceThatNamesItLeavesItOut) {
  EXPECT_EQ(without_subject(about_tuple(), "Parts").text(), "tuple 5: it is damaged");
  EXPECT_EQ(without_subject(without_subject(about_tuple(), "Parts"), "tuple 5").text(), "it is damaged");
}

TEST(ErrorSubject, OtherSubjectsStay) {
  for (const char* what : {"", "Part", "Parts: ", "tuple 5", "it is damaged"})
    EXPECT_EQ(without_subject(about_tuple(), what).text(), "Parts: tuple 5: it is damaged") << what;
  EXPECT_EQ(without_subject({ErrorCode::internal, "Parts: no subject"}, "Parts").text(), "Parts: no subject");
}

TEST(ErrorSubject, AFileStandsBeforeThePlaceInItsText) {
  EXPECT_EQ(in_text_of("a.csv", Error{ErrorCode::file_format, "no number"}.about("line 3")).text(),
            "a.csv line 3: no number");
  EXPECT_EQ(in_text_of("a.csv", {ErrorCode::file_format, "has no records"}).text(), "a.csv has no records");
}

}  // namespace
}  // namespace algebra3d
