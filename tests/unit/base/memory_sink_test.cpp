// MemorySink: the bytes come out as they went in, in pieces of one size.
#include "base/memory_sink.h"

#include <atomic>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

#include "base/memory_limit.h"

namespace algebra3d {
namespace {

std::string joined(const std::vector<std::string>& pieces) {
  return std::accumulate(pieces.begin(), pieces.end(), std::string());
}

TEST(MemorySink, KeepsWhatItIsGiven) {
  EXPECT_TRUE(MemorySink().take().empty());
  MemorySink sink;
  std::string expected;
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{100}, MemorySink::kPieceBytes - 101,
                                 std::size_t{1}, 3 * MemorySink::kPieceBytes + 7}) {
    const std::string bytes(size, static_cast<char>('a' + expected.size() % 26));
    expected += bytes;
    ASSERT_TRUE(sink.append(bytes));
  }
  const std::vector<std::string> pieces = std::move(sink).take();
  EXPECT_EQ(joined(pieces), expected);
  ASSERT_EQ(pieces.size(), 5U);
  for (std::size_t i = 0; i + 1 < pieces.size(); ++i) EXPECT_EQ(pieces[i].size(), MemorySink::kPieceBytes);
}

TEST(MemorySink, HearsAnInterruptBeforeEachPiece) {
  std::atomic<bool> cancel = false;
  MemorySink sink(Monitor{&cancel});
  ASSERT_TRUE(sink.append("a"));
  cancel = true;
  EXPECT_TRUE(sink.append(std::string(MemorySink::kPieceBytes - 1, 'b')));
  EXPECT_EQ(sink.append("c").error().code, ErrorCode::interrupted);
}

TEST(MemorySink, StaysWithinTheLimitOfMemory) {
  MemoryUser user(2 * MemorySink::kPieceBytes);
  const MemoryUserScope scope(&user);
  user.add(MemorySink::kPieceBytes + 1);
  MemorySink sink;
  const Status status = sink.append("a");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::limit_exceeded);
}

}  // namespace
}  // namespace algebra3d
