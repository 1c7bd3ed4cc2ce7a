// Bytes that are not text come from outside in many ways; none is stored.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>

#include "algebra3d/values/types/utf8.h"
#include "queries/language/session_parameters.h"
#include "unit/session/example_session.h"

namespace queries {
namespace {

using std::string_literals::operator""s;

class ForeignText : public testing::Test {
 protected:
  ForeignText() : session_(folder_.path()) { EXPECT_TRUE(session_.session().open_file(folder_.path() / "t.db").ok()); }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
  }
  // `LINE:COLUMN MESSAGE` of a command that fails.
  std::string failure(const std::string& command) {
    algebra3d::Diagnostics diagnostics;
    Context context{diagnostics, nullptr, folder_.path()};
    const Status status = session_.session().execute(command, {"test", 1, 1}, session_, context);
    if (status) return "no error";
    return fmt::format("{}:{} {}", status.error().place.line, status.error().place.column, status.error().text());
  }

  TestFolder folder_;
  TestSession session_;
};

TEST_F(ForeignText, a_command_with_it_fails_and_stores_nothing) {
  EXPECT_EQ(failure("let a = \"\xC3\xBC\xFF\""), "1:11 expected UTF-8, found the byte 0xff");
  EXPECT_EQ(failure("let a = 'x\ny\0'"s), "2:2 expected text, found a zero byte");
  EXPECT_EQ(session_.run("list objects"), "(inquiry (objects (OBJECTS)))");
}

TEST_F(ForeignText, a_restored_file_with_it_fails_and_stores_nothing) {
  write("a.obj", "(OBJECT a ()\n string \"\xC3\xBC\xFF\" ())");
  EXPECT_EQ(failure("restore a from 'a.obj'"), "2:11 object 'a': expected UTF-8, found the byte 0xff");
  write("b.obj", "(OBJECT b () (rel (tuple ((A string) (T text))))\n ((\"x\" 'y')\n (\"x\" '\0')) ())"s);
  EXPECT_EQ(failure("restore b from 'b.obj'"), "3:8 object 'b': expected text, found a zero byte");
  EXPECT_EQ(session_.run("list objects"), "(inquiry (objects (OBJECTS)))");
}

TEST_F(ForeignText, an_environment_variable_with_it_fails) {
  setenv("ALGEBRA3D_TEST_BYTES", "a\xFF", 1);
  write("c.obj", "(OBJECT c () string \"$(ALGEBRA3D_TEST_BYTES)\" ())");
  EXPECT_EQ(failure("restore c from 'c.obj'"), "1:23 object 'c': expected UTF-8, found the byte 0xff");
  unsetenv("ALGEBRA3D_TEST_BYTES");
}

TEST_F(ForeignText, a_parameter_with_it_is_refused_with_its_place) {
  const auto failure_of = [&](std::string_view given) {
    const auto parameter = parse_session_parameter(given, session_.session().registry());
    return parameter ? "no error" : parameter.error().text();
  };
  EXPECT_EQ(failure_of("a=caf\xE9"), R"(-p "a=caf\xe9": 1:6: expected UTF-8, found the byte 0xe9)");
  EXPECT_EQ(failure_of("a:text=\xC3\xBC\n\xC3\xBC\xFF"),
            R"(-p "a:text=ü ü\xff": 2:2: expected UTF-8, found the byte 0xff)");
  EXPECT_EQ(failure_of("\xE9=1"), R"(-p "\xe9=1": 1:1: expected UTF-8, found the byte 0xe9)");
  EXPECT_EQ(failure_of("a=caf\xC3\xA9"), "no error");
}

TEST_F(ForeignText, names_of_files_are_given_with_their_bytes_and_a_note) {
  std::filesystem::create_directory(folder_.path() / "parts");
  write("parts/a\xFF.stl", "");
  write("parts/b.stl", "");
  EXPECT_EQ(session_.run("query getDirectory('parts') transformstream consume"),
            "(('parts/a\\\\xff.stl') ('parts/b.stl'))");
  EXPECT_NE(session_.notes().find("a file name is not UTF-8"), std::string::npos) << session_.notes();
}

TEST_F(ForeignText, a_database_in_a_file_of_any_name_is_saved_and_restored) {
  for (const std::string name : {"caf\xE9", "my parts", "a(b", "it's", "5x", "a;b"}) {
    TestSession session(folder_.path());
    ASSERT_TRUE(session.session().open_file(folder_.path() / (name + ".db")).ok());
    EXPECT_EQ(session.run("let a = 'x'"), "");
    EXPECT_EQ(session.run("save database to 'saved.list'"), "");
    EXPECT_EQ(algebra3d::first_no_text(session.run("list databases")), std::string_view::npos);
    EXPECT_EQ(session.run("close database"), "");
    EXPECT_EQ(session.run("restore database copy from 'saved.list'"), "") << name;
    EXPECT_EQ(session.run("query a"), "'x'");
    EXPECT_EQ(session.run("close database"), "");
    EXPECT_EQ(session.run("delete database copy"), "");
  }
}

TEST_F(ForeignText, the_name_in_an_stl_file_may_be_anything) {
  write("named.stl", "solid caf\xE9\nendsolid\n");
  EXPECT_EQ(session_.run("query importSTL('named.stl')"), "()");
  EXPECT_EQ(algebra3d::first_no_text(session_.notes()), std::string_view::npos);
}

TEST_F(ForeignText, a_function_with_a_file_atom_reads_the_file_when_it_is_used) {
  write("greeting", "foo");
  EXPECT_EQ(session_.run("let f = fun() <file>greeting</file--->"), "");
  EXPECT_EQ(session_.run("query f()"), "'Zm9v'");
  write("greeting", "foobar");
  EXPECT_EQ(session_.run("query f()"), "'Zm9vYmFy'");
  write("t.obj", "(OBJECT t () text <file>greeting</file---> ())");
  EXPECT_EQ(session_.run("restore t from 't.obj'"), "");
  std::filesystem::remove(folder_.path() / "greeting");
  EXPECT_EQ(session_.run("query t"), "'Zm9vYmFy'");
  EXPECT_NE(session_.run("query f()").find("file atom 'greeting': there is no such file"), std::string::npos);
}

}  // namespace
}  // namespace queries
