#include "queries/server/detail/request_guard.h"

#include <gtest/gtest.h>

namespace queries {
namespace {

HttpRequest with_headers(std::multimap<std::string, std::string> headers) {
  HttpRequest request;
  request.headers = std::move(headers);
  return request;
}

int status_with(const RequestGuard& guard, std::multimap<std::string, std::string> headers) {
  const auto refusal = guard.refuse(with_headers(std::move(headers)), true);
  return refusal ? refusal->status : 200;
}

std::vector<SiteName> names_of(const std::vector<std::string>& texts) {
  std::vector<SiteName> names;
  for (const std::string& text : texts) names.push_back(*site_name(text));
  return names;
}

TEST(RequestGuard, KnowsItsOwnNamesOnly) {
  const RequestGuard guard(site_names("127.0.0.1", 8737, names_of({"db.example", "https://proxy.example:443"})), "");
  for (const char* host : {"127.0.0.1:8737", "localhost:8737", "LocalHost:8737", "[::1]:8737", "db.example",
                           "db.example:1234", "proxy.example:443"})
    EXPECT_EQ(status_with(guard, {{"host", host}}), 200) << host;
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:80", "evil.example:8737", "localhost.evil.example:8737",
                           "proxy.example", "proxy.example:80", "db.example.evil"})
    EXPECT_EQ(status_with(guard, {{"host", host}}), 403) << host;
  EXPECT_EQ(status_with(guard, {}), 403);
  EXPECT_EQ(status_with(guard, {{"host", "localhost:8737"}, {"host", "localhost:8737"}}), 403);
}

TEST(RequestGuard, RefusesPagesOfOtherServers) {
  const RequestGuard guard(site_names("127.0.0.1", 8737, {}), "");
  const std::string host = "localhost:8737";
  EXPECT_EQ(status_with(guard, {{"host", host}, {"origin", "http://localhost:8737"}}), 200);
  for (const char* origin : {"null", "", "http://evil.example", "http://localhost:8738", "http://localhost",
                             "http://127.0.0.1:8737", "localhost:8737", "https://localhost:8737",
                             "http:/localhost:8737", "http://localhost:8737/", "http://localhost:8737 "})
    EXPECT_EQ(status_with(guard, {{"host", host}, {"origin", origin}}), 403) << origin;
}

TEST(RequestGuard, TheSchemeOfAProxyCounts) {
  const RequestGuard guard(
      site_names("127.0.0.1", 8737, names_of({"HTTPS://Db.example", "both.example", "https://both.example", "x:1"})),
      "");
  const auto with = [&](const std::string& host, const std::string& origin) {
    return status_with(guard, {{"host", host}, {"origin", origin}});
  };
  EXPECT_EQ(with("db.example", "https://db.example"), 200);
  EXPECT_EQ(with("db.example", "http://db.example"), 403);
  EXPECT_EQ(with("db.example:8443", "https://db.example:8443"), 200);
  EXPECT_EQ(with("db.example:8443", "https://db.example"), 403);
  EXPECT_EQ(with("both.example", "http://both.example"), 200);
  EXPECT_EQ(with("both.example", "https://both.example"), 200);
  EXPECT_EQ(with("x:1", "http://x:1"), 200);
  EXPECT_EQ(with("x:1", "https://x:1"), 403);
  for (const char* wrong : {"", "https://", "ftp://a", "://a", "https://a/", "a/b", "a b", "user@a", "https:/a", "a,b"})
    EXPECT_FALSE(site_name(wrong)) << wrong;
}

TEST(RequestGuard, WantsTheToken) {
  const RequestGuard guard(site_names("0.0.0.0", 80, names_of({"db.example"})), "0123456789abcdef");
  const auto with = [&](const char* authorization) {
    return status_with(guard, {{"host", "db.example"}, {"authorization", authorization}});
  };
  EXPECT_EQ(with("Bearer 0123456789abcdef"), 200);
  EXPECT_EQ(with("bearer 0123456789abcdef"), 200);
  for (const char* wrong : {"", "Bearer", "Bearer ", "Bearer 0123456789abcdeF", "Bearer 0123456789abcdef0",
                            "Bearer 0123456789abcde", "Basic 0123456789abcdef", "0123456789abcdef"})
    EXPECT_EQ(with(wrong), 401) << wrong;
  EXPECT_EQ(status_with(guard, {{"host", "db.example"}}), 401);
  EXPECT_FALSE(guard.refuse(with_headers({{"host", "db.example"}}), false));
}

TEST(RequestGuard, LoopbackAddresses) {
  for (const char* address : {"localhost", "127.0.0.1", "127.8.9.10", "::1"})
    EXPECT_TRUE(is_loopback(address)) << address;
  for (const char* address : {"0.0.0.0", "::", "128.0.0.1", "10.0.0.1", "localhost.evil.example", "", "::2"})
    EXPECT_FALSE(is_loopback(address)) << address;
}

}  // namespace
}  // namespace queries
