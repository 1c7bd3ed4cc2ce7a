#include "base/polled_input.h"

#include <chrono>
#include <fstream>
#include <istream>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/temporary_folder.h"

namespace algebra3d {
namespace {

class PolledInputTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_->path() / name).string(); }

  Result<TemporaryFolder> folder_ = TemporaryFolder::make();
  std::atomic<bool> cancel_ = false;
};

TEST_F(PolledInputTest, a_file_is_read_to_its_end) {
  const std::string content(200'000, 'x');
  std::ofstream(path("file")) << content;
  const auto file = PolledInput::open(path("file"));
  ASSERT_TRUE(file.ok());
  PolledInput input(file->number(), &cancel_);
  EXPECT_EQ(input.read_all(1 << 20, "file").value(), content);
  EXPECT_FALSE(input.is_interrupted());
}

TEST_F(PolledInputTest, lines_are_read_from_a_stream_over_it) {
  std::ofstream(path("file")) << "one\ntwo\n";
  const auto file = PolledInput::open(path("file"));
  PolledInput input(file->number(), nullptr);
  std::istream stream(&input);
  std::string first, second, third;
  EXPECT_TRUE(std::getline(stream, first) && std::getline(stream, second));
  EXPECT_EQ(first + second, "onetwo");
  EXPECT_FALSE(std::getline(stream, third));
}

TEST_F(PolledInputTest, more_than_the_limit_is_an_error) {
  const auto file = PolledInput::open("/dev/zero");
  PolledInput input(file->number(), nullptr);
  const auto content = input.read_all(1'000'000, "/dev/zero");
  ASSERT_FALSE(content.ok());
  EXPECT_EQ(content.error().text(), "/dev/zero: more than 1000000 bytes");
}

// Neither opening nor reading waits without hearing the flag; nobody ever writes.
TEST_F(PolledInputTest, waiting_for_a_writer_can_be_ended) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  const auto file = PolledInput::open(path("pipe"));
  ASSERT_TRUE(file.ok());
  PolledInput input(file->number(), &cancel_);
  std::thread later([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    cancel_ = true;
  });
  const auto content = input.read_all(1000, "pipe");
  later.join();
  ASSERT_FALSE(content.ok());
  EXPECT_EQ(content.error().code, ErrorCode::interrupted);
  EXPECT_TRUE(input.is_interrupted());
}

TEST_F(PolledInputTest, a_pipe_is_read_when_its_writer_comes_later) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  const auto file = PolledInput::open(path("pipe"));
  PolledInput input(file->number(), &cancel_);
  std::thread writer([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    std::ofstream(path("pipe")) << "late";
  });
  EXPECT_EQ(input.read_all(1000, "pipe").value(), "late");
  writer.join();
}

TEST_F(PolledInputTest, what_cannot_be_read_is_told) {
  const auto missing = PolledInput::open(path("nothing"));
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().text(), "No such file or directory");
  const auto folder = PolledInput::open(folder_->path());
  ASSERT_TRUE(folder.ok());
  PolledInput input(folder->number(), nullptr);
  std::istream stream(&input);
  EXPECT_EQ(stream.get(), std::istream::traits_type::eof());
  EXPECT_TRUE(stream.bad());
  EXPECT_EQ(PolledInput(folder->number(), nullptr).read_all(10, "it").error().text(),
            "it: cannot be read to its end: Is a directory");
}

}  // namespace
}  // namespace algebra3d
