// How far `check database` has come, and that it can be ended.
#include <gtest/gtest.h>

#include <atomic>

#include "unit/session/example_session.h"

namespace queries {
namespace {

/// Remembers what a statement says of itself; ends it with the first word if it is told to.
class Listener final : public Presenter {
 public:
  Status present(const TypeExpr&, const Datum&, Context&) override { return {}; }
  Status present_inquiry(const NestedList& result) override {
    inquiry = result.print();
    return {};
  }
  void advance(const std::string& how_far) override {
    heard.push_back(how_far);
    cancel = ends_statement;
  }

  std::vector<std::string> heard;
  std::string inquiry;
  bool ends_statement = false;
  std::atomic<bool> cancel = false;
};

class CheckProgressTest : public testing::Test {
 protected:
  CheckProgressTest() : session_(folder_.path()) {
    EXPECT_TRUE(session_.session().open_file(folder_.path() / "parts.db").ok());
    // With the objects themselves there are 201 values to look at.
    EXPECT_EQ(session_.run("let Parts = intstream(1, 198) transformstream consume"), "");
    EXPECT_EQ(session_.run("let a = 1"), "");
    EXPECT_EQ(session_.run("let b = 1"), "");
  }
  Status check() {
    algebra3d::Diagnostics diagnostics;
    Context context{diagnostics, &listener_.cancel, {}};
    return session_.session().execute("check database", {}, listener_, context);
  }

  TestFolder folder_;
  TestSession session_;
  Listener listener_;
};

TEST_F(CheckProgressTest, a_check_says_how_far_it_is) {
  EXPECT_TRUE(check().ok());
  // The first of 201, then every 64th, then every object.
  EXPECT_EQ(listener_.heard, (std::vector<std::string>{"0 % (Parts)", "31 % (Parts)", "63 % (Parts)", "95 % (Parts)",
                                                       "99 % (a)", "100 % (b)"}));
  EXPECT_EQ(listener_.inquiry, "(inquiry (findings ()))");
}

TEST_F(CheckProgressTest, a_check_ends_when_it_is_asked_to_and_the_session_goes_on) {
  listener_.ends_statement = true;
  const Status status = check();
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().code, ErrorCode::interrupted);
  EXPECT_EQ(listener_.heard.size(), 1U);
  EXPECT_EQ(session_.run("query Parts count"), "198");
}

}  // namespace
}  // namespace queries
