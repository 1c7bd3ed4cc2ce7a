#include "queries/server/detail/request_head.h"

#include <gtest/gtest.h>

namespace queries {
namespace {

using State = RequestHead::State;

// The status of the refusal of a head; 200 if it is complete, 100 if more must come.
int status_of_head(std::string_view bytes, const HeadLimits& limits = {}) {
  RequestHead head(limits);
  switch (head.add(bytes)) {
    case State::refused:
      return head.refusal().status;
    case State::complete:
      return 200;
    default:
      return 100;
  }
}

constexpr std::string_view kHead = "GET /a HTTP/1.1\r\nHost: b\r\nX: c\r\n\r\n";

TEST(RequestHead, PiecesMakeTheSameHead) {
  const std::string text = std::string(kHead) + "body";
  for (std::size_t first = 0; first <= text.size(); ++first) {
    RequestHead head;
    const State after_first = head.add(std::string_view(text).substr(0, first));
    ASSERT_NE(after_first, State::refused) << first;
    EXPECT_EQ(after_first == State::complete, first >= kHead.size()) << first;
    if (after_first == State::incomplete) {
      ASSERT_EQ(head.add(std::string_view(text).substr(first)), State::complete);
    }
    EXPECT_EQ(head.request().path, "/a") << first;
    EXPECT_EQ(head.request().header("x"), "c") << first;
    EXPECT_EQ(head.take_rest(),
              after_first == State::complete ? text.substr(kHead.size(), first - kHead.size()) : "body")
        << first;
  }
}

TEST(RequestHead, BytesOneByOne) {
  RequestHead head;
  for (std::size_t i = 0; i + 1 < kHead.size(); ++i) ASSERT_EQ(head.add(kHead.substr(i, 1)), State::incomplete) << i;
  EXPECT_EQ(head.add("\n"), State::complete);
  EXPECT_EQ(head.request().headers, (std::multimap<std::string, std::string>{{"host", "b"}, {"x", "c"}}));
  EXPECT_EQ(head.take_rest(), "");
}

TEST(RequestHead, RangesAreLeftOut) {
  RequestHead head;
  ASSERT_EQ(head.add("GET /a HTTP/1.1\r\nRange: bytes=0-\r\nHost: b\r\nrANGE: x\r\nRanges: y\r\n\r\nRange: z\r\n"),
            State::complete);
  EXPECT_EQ(head.request().headers, (std::multimap<std::string, std::string>{{"host", "b"}, {"ranges", "y"}}));
  EXPECT_EQ(head.take_rest(), "Range: z\r\n");
}

TEST(RequestHead, EmptyLinesBeforeARequest) {
  RequestHead head;
  for (const char* piece : {"\r", "\n\r\n", "\r"}) {
    ASSERT_EQ(head.add(piece), State::incomplete);
    EXPECT_EQ(head.is_empty(), piece[1] != '\0') << piece;
  }
  ASSERT_EQ(head.add("\n" + std::string(kHead)), State::complete);
  EXPECT_EQ(head.request().method, "GET");
}

// A complete head of this line and these headers.
RequestHead head_of(std::string_view line, std::string_view headers = "") {
  RequestHead head;
  EXPECT_EQ(head.add(std::string(line) + "\r\n" + std::string(headers) + "\r\n"), State::complete) << line << headers;
  return head;
}

TEST(RequestHead, Addresses) {
  using Query = std::multimap<std::string, std::string>;
  const auto query_of = [](const std::string& text) {
    const HttpRequest request = head_of("GET /a%20b" + text + " HTTP/1.1").request();
    EXPECT_EQ(request.path, "/a%20b");
    return request.query;
  };
  EXPECT_EQ(query_of(""), Query());
  EXPECT_EQ(query_of("?"), Query());
  EXPECT_EQ(query_of("?&&#x=1"), Query());
  EXPECT_EQ(query_of("?x=1&y=a+b%2B%26&z"), (Query{{"x", "1"}, {"y", "a b+&"}, {"z", ""}}));
  EXPECT_EQ(query_of("?x=1&x=1&=2&y==?/#z"), (Query{{"x", "1"}, {"x", "1"}, {"", "2"}, {"y", "=?/"}}));
}

TEST(RequestHead, ConnectionsThatStayOpen) {
  EXPECT_TRUE(head_of("GET / HTTP/1.1").keeps_connection());
  EXPECT_TRUE(head_of("GET / HTTP/1.1", "Connection: keep-alive\r\n").keeps_connection());
  EXPECT_FALSE(head_of("GET / HTTP/1.1", "Connection: keep-alive\r\nconnection: a, Close\r\n").keeps_connection());
  EXPECT_FALSE(head_of("GET / HTTP/1.0", "Connection: keep-alive\r\n").keeps_connection());
  EXPECT_TRUE(head_of("GET / HTTP/1.1", "Expect: 100-Continue\r\n").expects_continue());
  EXPECT_FALSE(head_of("GET / HTTP/1.0", "Expect: 100-continue\r\n").expects_continue());
}

TEST(RequestHead, FormsOfBodies) {
  const auto status = [](const std::string& header) {
    return status_of_head("POST / HTTP/1.1\r\n" + header + "\r\n\r\n");
  };
  EXPECT_EQ(head_of("POST / HTTP/1.1").body_bytes(), 0U);
  EXPECT_EQ(head_of("POST / HTTP/1.1", "Content-Length: 123456789012345678\r\n").body_bytes(), 123456789012345678U);
  for (const char* length : {"", "x", "-1", "+1", "1 1", "1,1", "0x1", "1234567890123456789"})
    EXPECT_EQ(status(std::string("Content-Length: ") + length), 400) << length;
  EXPECT_EQ(status("Content-Length: 1\r\ncontent-length: 1"), 400);
  EXPECT_EQ(status("Transfer-Encoding: identity"), 411);
  EXPECT_EQ(status("Content-Type: Multipart/Form-Data; boundary=x"), 415);
  EXPECT_EQ(status("Content-Encoding: gzip"), 415);
  EXPECT_EQ(status("Content-Encoding: identity"), 200);
  EXPECT_EQ(status_of_head("GET a HTTP/1.1\r\n\r\n"), 400);
  EXPECT_EQ(status_of_head("GET /%0a HTTP/1.1\r\n\r\n"), 400);
}

TEST(RequestHead, RequestLines) {
  for (const char* line : {"GET / HTTP/1.1", "HEAD / HTTP/1.0", "OPTIONS * HTTP/1.1", "PATCH /\xc3\xa4?x=y&z HTTP/1.1"})
    EXPECT_EQ(status_of_head(std::string(line) + "\r\n"), 100) << line;
  for (const char* line : {"GET", "GET /", "GET  / HTTP/1.1", "GET / HTTP/1.1 ", "GET /  HTTP/1.1", "GET / / HTTP/1.1",
                           "GET\t/ HTTP/1.1", "GET / HTTP/", "GET / HTTPS/1.1", "GET / http/1.1", "(GET / HTTP/1.1",
                           "GET /\x01 HTTP/1.1", "GET /\r HTTP/1.1"})
    EXPECT_EQ(status_of_head(std::string(line) + "\r\n"), 400) << line;
  for (const char* line : {"GET / HTTP/1.2", "GET / HTTP/0.9", "GET / HTTP/2", "GET / HTTP/1", "FOO / HTTP/3.0"})
    EXPECT_EQ(status_of_head(std::string(line) + "\r\n"), 505) << line;
  for (const char* line : {"TRACE / HTTP/1.1", "CONNECT a:1 HTTP/1.1", "get / HTTP/1.1", "G'ET / HTTP/1.0"})
    EXPECT_EQ(status_of_head(std::string(line) + "\r\n"), 501) << line;
}

TEST(RequestHead, Limits) {
  const HeadLimits limits{.line_bytes = 20, .bytes = 50};
  EXPECT_EQ(status_of_head("GET /aaa HTTP/1.1\r", limits), 100);
  EXPECT_EQ(status_of_head("GET /aaaa HTTP/1.1\r\n", limits), 100);
  EXPECT_EQ(status_of_head("GET /aaaaa HTTP/1.1\r\n", limits), 414);
  EXPECT_EQ(status_of_head("GET /aaaaaaaaaaaaaaaa", limits), 414);  // before its end has come
  const std::string first = "GET / HTTP/1.1\r\n";                   // 16 bytes
  EXPECT_EQ(status_of_head(first + "X: aaaaaaaaaaaaaaa\r\n", limits), 100);
  EXPECT_EQ(status_of_head(first + "X: aaaaaaaaaaaaaaaa\r\n", limits), 431);
  EXPECT_EQ(status_of_head(first + "X: aaaaaaaaaaaaaaaaaa", limits), 431);
  EXPECT_EQ(status_of_head(first + "X: aaaaaaaaaaa\r\nY: bbbbbbbbbbb\r\n\r\n", limits), 200);
  EXPECT_EQ(status_of_head(first + "X: aaaaaaaaaaaa\r\nY: bbbbbbbbbbb\r\n\r\n", limits), 431);
  // Lines that are left out count, and what comes after the head does not.
  EXPECT_EQ(status_of_head(first + "Range: aaaaaaa\r\nRange: bbbbbbb\r\n\r\n", limits), 200);
  EXPECT_EQ(status_of_head(first + "Range: aaaaaaaa\r\nRange: bbbbbbb\r\n\r\n", limits), 431);
  EXPECT_EQ(status_of_head(first + "\r\n" + std::string(1000, 'x'), limits), 200);
}

}  // namespace
}  // namespace queries
