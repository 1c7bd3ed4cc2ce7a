#pragma once

#include <gmp.h>

namespace algebra3d::detail {

/// A GMP integer with an owner.
class BigInteger {
 public:
  BigInteger() { mpz_init(value_); }
  ~BigInteger() { mpz_clear(value_); }
  BigInteger(const BigInteger&) = delete;
  BigInteger(BigInteger&& other) noexcept : BigInteger() { mpz_swap(value_, other.value_); }
  BigInteger& operator=(const BigInteger&) = delete;
  BigInteger& operator=(BigInteger&& other) noexcept {
    mpz_swap(value_, other.value_);
    return *this;
  }

  int sign() const { return mpz_sgn(value_); }

  operator mpz_ptr() { return value_; }           // NOLINT(google-explicit-constructor)
  operator mpz_srcptr() const { return value_; }  // NOLINT(google-explicit-constructor)

 private:
  mpz_t value_;
};

}  // namespace algebra3d::detail
