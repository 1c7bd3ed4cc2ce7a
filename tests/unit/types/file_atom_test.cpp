#include "algebra3d/values/types/file_atom.h"
#include "algebra3d/values/types/bytes.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "algebra3d/values/types/scalars.h"

namespace algebra3d {
namespace {

TEST(base64, is_that_of_rfc_4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xFB\xEF\xFF"), "++//");
}

class FileAtom : public testing::Test {
 protected:
  FileAtom() {
    std::string name = testing::TempDir() + "file-atom-XXXXXX";
    folder_ = mkdtemp(name.data());
    context_.folder = folder_;
  }
  ~FileAtom() override { std::filesystem::remove_all(folder_); }

  std::string content(const std::string& path) {
    const auto value = value_from_nested(TypeOf<Text>::type(), file_atom(path), context_);
    return value ? value->get<Text>().content
                 : fmt::format("{}: {}", describe(value.error().code).name, value.error().text());
  }

  std::filesystem::path folder_;
  Diagnostics diagnostics_;
  Context context_{diagnostics_, nullptr, {}};
};

TEST_F(FileAtom, becomes_the_content_of_the_file) {
  std::ofstream(folder_ / "a b.txt") << "foobar";
  EXPECT_EQ(content("a b.txt"), "Zm9vYmFy");
  EXPECT_EQ(content((folder_ / "a b.txt").string()), "Zm9vYmFy");
  std::ofstream(folder_ / "empty").flush();
  EXPECT_EQ(content("empty"), "");
}

TEST_F(FileAtom, becomes_bytes) {
  std::ofstream(folder_ / "a", std::ios::binary) << std::string("\0\xff", 2);
  const auto value = value_from_nested(TypeOf<Bytes>::type(), file_atom("a"), context_);
  ASSERT_TRUE(value.ok());
  EXPECT_EQ(value->to_nested().print(), "'00ff'");
  EXPECT_FALSE(value_from_nested(TypeOf<Bytes>::type(), file_atom("b"), context_).ok());
}

TEST_F(FileAtom, of_what_is_no_file_is_an_error) {
  EXPECT_EQ(content("missing"), "file_missing: file atom 'missing': there is no such file");
  EXPECT_EQ(content("."), "file_missing: file atom '.': expected a file, found something else");
  EXPECT_EQ(content("/dev/zero"), "file_missing: file atom '/dev/zero': expected a file, found something else");
  EXPECT_EQ(content(""), "file_missing: file atom '': expected a file, found something else");
}

TEST_F(FileAtom, of_a_file_beyond_the_limit_is_an_error) {
  std::ofstream(folder_ / "large").flush();
  std::filesystem::resize_file(folder_ / "large", kMaxFileAtomBytes + 1);
  EXPECT_EQ(content("large"),
            "limit_exceeded: file atom 'large': the file has 67108865 bytes, at most 67108864 are read");
}

}  // namespace
}  // namespace algebra3d
