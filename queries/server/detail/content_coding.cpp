#include "queries/server/detail/content_coding.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <limits>
#include <new>

#include "queries/server/detail/lower_case.h"
#include "queries/server/detail/refusal.h"

namespace queries {
namespace {

// Below this size the headers outweigh what is saved.
constexpr std::size_t kLeastCompressed = 1024;
// Windows of 32 kB, with the header and the check sum of gzip.
constexpr int kGzipWindow = 15 + 16;
constexpr int kMemoryLevel = 8;

// A weight (RFC 9110, section 12.4.2) in thousandths: `0.5` is 500. 0 for a text that is not one.
int weight_of(std::string_view text) {
  constexpr std::size_t kLongest = 5;  // 0.123
  const bool has_form = !text.empty() && text.size() <= kLongest && (text[0] == '0' || text[0] == '1') &&
                        (text.size() == 1 || text[1] == '.');
  if (!has_form) return 0;
  int thousandths = (text[0] - '0') * 1000;
  int unit = 100;
  for (const char c : text.substr(std::min<std::size_t>(2, text.size()))) {
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) return 0;
    thousandths += (c - '0') * unit;
    unit /= 10;
  }
  return thousandths <= 1000 ? thousandths : 0;
}

/// One of the codings of the header, such as `gzip;q=0.5`.
struct Coding {
  std::string_view name;
  int weight;
};

Coding coding_of(std::string_view text) {
  const std::size_t end = text.find(';');
  if (end == std::string_view::npos) return {text, 1000};
  const std::string_view weight = text.substr(end + 1);
  return {text.substr(0, end), weight.starts_with("q=") ? weight_of(weight.substr(2)) : 0};
}

/// A stream of zlib, ended by the function that belongs to it.
class ZlibStream {
 public:
  using End = int (*)(z_streamp);
  /// `begun`: what the function that begins the stream has returned.
  template <typename Begin>
  ZlibStream(Begin begin, End end) : end_(end) {
    if (begin(&stream_) != Z_OK) throw std::bad_alloc();
  }
  ~ZlibStream() { end_(&stream_); }
  ZlibStream(const ZlibStream&) = delete;
  ZlibStream& operator=(const ZlibStream&) = delete;

  /// Passes the bytes through `step`, which is deflate or inflate, to the end of the stream. Nothing if they are
  /// damaged, or end early.
  template <typename Step>
  std::optional<std::string> pass(std::string_view bytes, Step step) {
    // zlib counts in 32 bits, and reads only from what it may write to.
    constexpr std::size_t kMostAtOnce = std::numeric_limits<std::uint32_t>::max() / 2;
    std::string result;
    std::array<char, std::size_t{64} << 10U> piece;  // NOLINT(*-member-init): written by zlib
    int outcome = Z_OK;
    while (outcome == Z_OK) {
      if (stream_.avail_in == 0) {
        const std::string_view next = bytes.substr(0, kMostAtOnce);
        bytes.remove_prefix(next.size());
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast, cppcoreguidelines-pro-type-const-cast)
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(next.data()));
        stream_.avail_in = static_cast<uInt>(next.size());
      }
      // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
      stream_.next_out = reinterpret_cast<Bytef*>(piece.data());
      stream_.avail_out = static_cast<uInt>(piece.size());
      outcome = step(&stream_, bytes.empty() ? Z_FINISH : Z_NO_FLUSH);
      result.append(piece.data(), piece.size() - stream_.avail_out);
      // More room or more bytes are needed; the loop goes on.
      if (outcome == Z_BUF_ERROR && (stream_.avail_out == 0 || (stream_.avail_in == 0 && !bytes.empty())))
        outcome = Z_OK;
    }
    if (outcome == Z_MEM_ERROR) throw std::bad_alloc();
    return outcome == Z_STREAM_END ? std::optional(std::move(result)) : std::nullopt;
  }

 private:
  z_stream stream_ = {};
  End end_;
};

bool has_header(const HttpAnswer& answer, std::string_view name) {
  return std::ranges::any_of(answer.headers, [&](const auto& header) { return header.first == name; });
}

// Pages lie in the program as they are sent to browsers.
void unpack(HttpAnswer& answer) {
  std::optional<std::string> content = gunzip(answer.body);
  if (!content) {
    answer = Refusal{500, "internal", "a page of the program cannot be unpacked"}.answer();
    return;
  }
  std::erase_if(answer.headers, [](const auto& header) { return header.first == "Content-Encoding"; });
  answer.body = *std::move(content);
}

}  // namespace

bool takes_gzip(std::string_view accept_encoding) {
  std::string text = in_lower_case(accept_encoding);
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t'; });
  std::optional<int> gzip_weight, identity_weight, other_weight;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto [name, weight] = coding_of(std::string_view(text).substr(begin, end - begin));
    if (name == "gzip" || name == "x-gzip") gzip_weight = weight;
    if (name == "identity") identity_weight = weight;
    if (name == "*") other_weight = weight;
    begin = end + 1;
  }
  const int weight = gzip_weight.value_or(other_weight.value_or(0));
  return weight > 0 && weight >= identity_weight.value_or(0);
}

std::string gzip(std::string_view bytes) {
  const auto begin = [](z_streamp stream) {
    return deflateInit2(stream, Z_BEST_SPEED, Z_DEFLATED, kGzipWindow, kMemoryLevel, Z_DEFAULT_STRATEGY);
  };
  return ZlibStream(begin, deflateEnd).pass(bytes, deflate).value();
}

std::optional<std::string> gunzip(std::string_view bytes) {
  const auto begin = [](z_streamp stream) { return inflateInit2(stream, kGzipWindow); };
  return ZlibStream(begin, inflateEnd).pass(bytes, inflate);
}

void encode(HttpAnswer& answer, std::string_view accept_encoding) {
  if (has_header(answer, "Content-Encoding")) {
    if (!takes_gzip(accept_encoding)) unpack(answer);
    return;
  }
  const bool is_json = answer.type == "application/json" && answer.body.size() > kLeastCompressed;
  if (answer.stream || !answer.pieces.empty() || !(is_json || answer.is_compressible)) return;
  answer.headers.emplace_back("Vary", "Accept-Encoding");
  if (answer.body.empty() || !takes_gzip(accept_encoding)) return;
  answer.body = gzip(answer.body);
  answer.headers.emplace_back("Content-Encoding", "gzip");
}

}  // namespace queries
