#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "queries/transfer/detail/sha256.h"

namespace queries {

/// Count and checksum of rows, whatever their order: the checksum of a row is the first 8 bytes of the SHA-256 over the
/// SHA-256 of each of its values (32 zero bytes for NULL), that of several rows the sum modulo 2^64. What is hashed of
/// a value says ColumnType.
struct RowDigest {
  std::uint64_t count = 0;
  std::uint64_t checksum = 0;

  RowDigest operator+(const RowDigest& other) const { return {count + other.count, checksum + other.checksum}; }
  RowDigest operator-(const RowDigest& other) const { return {count - other.count, checksum - other.checksum}; }
  friend bool operator==(const RowDigest&, const RowDigest&) = default;
  /// "12 rows (checksum 0123456789abcdef)".
  std::string text() const;
};

/// Of a row, by the SHA-256 of its values.
RowDigest row_digest(std::span<const Sha256> values);

/// The columns `count` and `sum` of a query that computes the same on the server; `hashed` are the expressions of bytea
/// that are hashed of each value.
std::string row_digest_sql(std::span<const std::string> hashed);
/// The digest from these two columns as texts. The sum may have any number of digits.
RowDigest row_digest_of_texts(const std::string& count, const std::string& sum);

}  // namespace queries
