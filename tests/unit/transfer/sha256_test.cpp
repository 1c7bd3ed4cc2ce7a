#include "queries/transfer/detail/sha256.h"

#include <string>

#include <gtest/gtest.h>

#include "algebra3d/values/types/bytes.h"
#include "queries/transfer/detail/row_digest.h"

namespace queries {
namespace {

std::string hash_of(const std::string& bytes) {
  const Sha256 hash = sha256(bytes);
  return algebra3d::hex_digits(std::string(hash.begin(), hash.end()));
}

// Values: FIPS 180-4, its examples, and sha256sum.
TEST(sha256, known_hashes) {
  EXPECT_EQ(hash_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hash_of(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(sha256, lengths_around_a_block) {
  EXPECT_EQ(hash_of(std::string(55, 'x')), "d5e285683cd4efc02d021a5c62014694958901005d6f71e89e0989fac77e4072");
  EXPECT_EQ(hash_of(std::string(56, 'x')), "04c26261370ee7541549d16dee320c723e3fd14671e66a099afe0a377c16888e");
  EXPECT_EQ(hash_of(std::string(63, 'x')), "75220b47218278e656f2013bb8f0c455a25eaf01e86c64924e9d48d89776d6f2");
  EXPECT_EQ(hash_of(std::string(64, 'x')), "7ce100971f64e7001e8fe5a51973ecdfe1ced42befe7ee8d5fd6219506b5393c");
}

TEST(row_digest, does_not_depend_on_the_order_of_rows) {
  const RowDigest a = row_digest(std::vector<Sha256>{sha256("a"), sha256("b")});
  const RowDigest b = row_digest(std::vector<Sha256>{sha256("b"), sha256("a")});
  EXPECT_NE(a, b);  // but on that of values
  EXPECT_EQ(a + b, b + a);
  EXPECT_EQ((a + b) - b, a);
  EXPECT_NE(row_digest(std::vector<Sha256>{Sha256{}}), row_digest(std::vector<Sha256>{sha256("")}));
}

TEST(row_digest, sums_of_any_length_are_read) {
  EXPECT_EQ(row_digest_of_texts("3", "-1"), (RowDigest{3, 0xffffffffffffffffU}));
  EXPECT_EQ(row_digest_of_texts("0", "18446744073709551617"), (RowDigest{0, 1}));
  EXPECT_EQ(row_digest_of_texts("1", "-36893488147419103233"), (RowDigest{1, 0xffffffffffffffffU}));
}

}  // namespace
}  // namespace queries
