#include "queries/transfer/detail/sha256.h"

#include <bit>
#include <cstddef>
#include <cstring>

#include "base/interruption_scope.h"

namespace queries {
namespace {

constexpr std::size_t kBlock = 64;
constexpr std::size_t kRounds = 64;

constexpr std::array<std::uint64_t, kRounds> first_primes() {
  std::array<std::uint64_t, kRounds> primes{};
  std::size_t count = 0;
  for (std::uint64_t candidate = 2; count < kRounds; ++candidate) {
    bool is_prime = true;
    for (std::size_t i = 0; i < count && is_prime; ++i) is_prime = candidate % primes[i] != 0;
    if (is_prime) primes[count++] = candidate;
  }
  return primes;
}
constexpr std::array<std::uint64_t, kRounds> kPrimes = first_primes();

/// The first 32 bits of the fraction of the root of `prime`: of degree 2 or 3, by halving.
constexpr std::uint32_t root_bits(std::uint64_t prime, int degree) {
  __extension__ using Wide = unsigned __int128;
  // The greatest r with r^degree <= prime * 2^(32 degree); r has at most 37 bits.
  std::uint64_t root = 0;
  for (int bit = 36; bit >= 0; --bit) {
    const std::uint64_t next = root | (std::uint64_t{1} << static_cast<unsigned>(bit));
    const Wide square = static_cast<Wide>(next) * next;
    const Wide power = degree == 2 ? square : square * next;
    if (power <= static_cast<Wide>(prime) << static_cast<unsigned>(32 * degree)) root = next;
  }
  return static_cast<std::uint32_t>(root);
}

constexpr std::array<std::uint32_t, kRounds> round_constants() {
  std::array<std::uint32_t, kRounds> constants{};
  for (std::size_t i = 0; i < kRounds; ++i) constants[i] = root_bits(kPrimes[i], 3);
  return constants;
}

constexpr std::array<std::uint32_t, 8> start_values() {
  std::array<std::uint32_t, 8> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = root_bits(kPrimes[i], 2);
  return values;
}

constexpr std::array<std::uint32_t, kRounds> kConstants = round_constants();
static_assert(kConstants[0] == 0x428a2f98 && kConstants[63] == 0xc67178f2 && start_values()[0] == 0x6a09e667);

std::uint32_t word_at(const std::uint8_t* bytes) {
  return std::uint32_t{bytes[0]} << 24U | std::uint32_t{bytes[1]} << 16U | std::uint32_t{bytes[2]} << 8U | bytes[3];
}

// Section 6.2.2.
void add_block(std::array<std::uint32_t, 8>& hash, const std::uint8_t* block) {
  std::array<std::uint32_t, kRounds> w;
  for (std::size_t t = 0; t < 16; ++t) w[t] = word_at(block + 4 * t);
  for (std::size_t t = 16; t < kRounds; ++t) {
    const std::uint32_t s0 = std::rotr(w[t - 15], 7) ^ std::rotr(w[t - 15], 18) ^ (w[t - 15] >> 3U);
    const std::uint32_t s1 = std::rotr(w[t - 2], 17) ^ std::rotr(w[t - 2], 19) ^ (w[t - 2] >> 10U);
    w[t] = s1 + w[t - 7] + s0 + w[t - 16];
  }
  auto [a, b, c, d, e, f, g, h] = hash;
  for (std::size_t t = 0; t < kRounds; ++t) {
    const std::uint32_t sum1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
    const std::uint32_t t1 = h + sum1 + ((e & f) ^ (~e & g)) + kConstants[t] + w[t];
    const std::uint32_t sum0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
    const std::uint32_t t2 = sum0 + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const std::array<std::uint32_t, 8> added{a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < hash.size(); ++i) hash[i] += added[i];
}

}  // namespace

Sha256 sha256(std::string_view bytes) {
  std::array<std::uint32_t, 8> hash = start_values();
  const auto* next = reinterpret_cast<const std::uint8_t*>(bytes.data());  // NOLINT(*-reinterpret-cast)
  std::size_t left = bytes.size();
  for (std::size_t block = 0; left >= kBlock; ++block, next += kBlock, left -= kBlock) {
    algebra3d::poll_interruption_at(block);
    add_block(hash, next);
  }
  // The rest, a bit 1, zeros, and the number of bits.
  std::array<std::uint8_t, 2 * kBlock> end{};
  if (left > 0) std::memcpy(end.data(), next, left);
  end[left] = 0x80;
  const std::size_t size = left + 9 <= kBlock ? kBlock : 2 * kBlock;
  const std::uint64_t bit_count = std::uint64_t{bytes.size()} * 8;
  for (std::size_t i = 0; i < 8; ++i) end[size - 1 - i] = static_cast<std::uint8_t>(bit_count >> (8 * i));
  for (std::size_t at = 0; at < size; at += kBlock) add_block(hash, end.data() + at);
  Sha256 result;
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = static_cast<std::uint8_t>(hash[i / 4] >> (24 - 8 * (i % 4)));
  return result;
}

}  // namespace queries
