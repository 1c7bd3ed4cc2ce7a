// What repairReport and checkSTL say of files that cannot be read, or are not repaired.
#include <fstream>
#include <string>

#include "unit/session/example_session.h"

namespace queries {
namespace {

class RepairReports : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << content;
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  TestFolder folder_;
  TestSession session_{folder_.path()};
};

TEST_F(RepairReports, say_why_a_file_has_none) {
  write("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 x\n");
  write("text.txt", "Once upon a time\n");
  for (const auto& [name, reason] :
       {std::pair{"missing.stl", ": No such file or directory"},
        std::pair{"bad.off", ": byte 26, line 5: vertex 3 of 3: expected a number, found 'x'"},
        std::pair{"text.txt",
                  ": neither content nor name is that of a mesh file; expected STL, "
                  "OBJ or OFF"}}) {
    EXPECT_EQ(session_.run(std::string("query repairReport('") + name + "') count"), "0");
    EXPECT_EQ(session_.notes(), "repairReport: " + path(name) + reason + "\n");
  }
  EXPECT_EQ(session_.run("query checkSTL('missing.stl')"), "'" + path("missing.stl") + ": No such file or directory'");
}

TEST_F(RepairReports, say_why_there_is_no_solid) {
  write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n");
  EXPECT_EQ(session_.run("query repairReport('open.off', 'strict') count"), "1");
  EXPECT_TRUE(session_.notes().starts_with("repairReport: open.off: no valid solid: 3 boundary edges (triangle "))
      << session_.notes();
  EXPECT_EQ(session_.run("query repairReport('open.off') filter[.Phase = \"changed\"] count"), "1");
  EXPECT_EQ(session_.notes(), "");
}

}  // namespace
}  // namespace queries
