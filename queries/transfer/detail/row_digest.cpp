#include "queries/transfer/detail/row_digest.h"

#include <fmt/format.h>

#include "algebra3d/values/types/bytes.h"
#include "base/text.h"

namespace queries {
namespace {

std::uint64_t wrapped_number(std::string_view digits) {
  const bool is_negative = digits.starts_with('-');
  std::uint64_t number = 0;
  for (const char digit : digits.substr(is_negative ? 1 : 0))
    number = number * 10 + static_cast<std::uint64_t>(digit - '0');
  return is_negative ? 0 - number : number;
}

}  // namespace

std::string RowDigest::text() const {
  return fmt::format("{} (checksum {:016x})", algebra3d::counted(count, "row"), checksum);
}

RowDigest row_digest(std::span<const Sha256> values) {
  const std::string_view bytes(reinterpret_cast<const char*>(values.data()),  // NOLINT(*-reinterpret-cast)
                               values.size() * sizeof(Sha256));
  const Sha256 hash = sha256(bytes);
  RowDigest digest{1, 0};
  for (std::size_t i = 0; i < sizeof digest.checksum; ++i) digest.checksum = digest.checksum << 8U | hash[i];
  return digest;
}

std::string row_digest_sql(std::span<const std::string> hashed) {
  const std::string nothing = "'\\x" + algebra3d::hex_digits(std::string(sizeof(Sha256), '\0')) + "'::bytea";
  std::string values;
  for (const std::string& each : hashed)
    values += fmt::format("{}coalesce(sha256({}), {})", values.empty() ? "" : " || ", each, nothing);
  return fmt::format("count(*), coalesce(sum(('x' || encode(substr(sha256({}), 1, 8), 'hex'))::bit(64)::bigint), 0)",
                     values);
}

RowDigest row_digest_of_texts(const std::string& count, const std::string& sum) {
  return {wrapped_number(count), wrapped_number(sum)};
}

}  // namespace queries
