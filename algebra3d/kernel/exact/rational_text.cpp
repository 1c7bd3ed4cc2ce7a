#include <algorithm>
#include <atomic>
#include <charconv>
#include <string>

#include "algebra3d/kernel/exact/detail/rational_big.h"
#include "algebra3d/kernel/exact/rational.h"
#include "algebra3d/kernel/exact/rational_text.h"
#include "base/interruption_scope.h"

namespace algebra3d {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Takes the digits at the front off `text`.
std::string_view take_digits(std::string_view& text) {
  const auto count = static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin());
  const std::string_view digits = text.substr(0, count);
  text.remove_prefix(count);
  return digits;
}

bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

void set_digits(mpz_ptr number, const std::string& digits) {
  mpz_set_str(number, digits.c_str(), 10);
}

/// Takes `e`, a sign and digits off `text`: the exponent, 0 if there is no `e`; nothing if malformed or too large.
std::optional<int> take_exponent(std::string_view& text) {
  if (!take(text, 'e') && !take(text, 'E')) return 0;
  const bool negative = take(text, '-');
  if (!negative) take(text, '+');
  const std::string_view digits = take_digits(text);
  int exponent = 0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  if (code != std::errc() || exponent > Rational::kMaxExponent) return std::nullopt;
  return negative ? -exponent : exponent;
}

/// digits * 10^exponent into `big`, in lowest terms.
void set_decimal(mpq_ptr value, const std::string& digits, long exponent) {
  set_digits(mpq_numref(value), digits);
  mpz_ptr power = mpq_denref(value);
  mpz_ui_pow_ui(power, 10, static_cast<unsigned long>(exponent < 0 ? -exponent : exponent));
  if (exponent >= 0) {
    mpz_mul(mpq_numref(value), mpq_numref(value), power);
    mpz_set_ui(power, 1);
  }
  mpq_canonicalize(value);
}

/// The part of a number after its sign.
bool set_unsigned(mpq_ptr value, std::string_view text) {
  const std::string whole(take_digits(text));
  if (!whole.empty() && take(text, '/')) {
    const std::string divisor(take_digits(text));
    if (!text.empty() || divisor.find_first_not_of('0') == std::string::npos) return false;
    set_digits(mpq_numref(value), whole);
    set_digits(mpq_denref(value), divisor);
    mpq_canonicalize(value);
    return true;
  }
  const std::string fraction(take(text, '.') ? take_digits(text) : std::string_view());
  if (whole.empty() && fraction.empty()) return false;
  const std::optional<int> exponent = take_exponent(text);
  if (!exponent || !text.empty()) return false;
  set_decimal(value, whole + fraction, *exponent - static_cast<long>(fraction.size()));
  return true;
}

std::atomic<std::size_t> max_digits = kMaxNumberDigits;

}  // namespace

std::size_t max_digits_read() {
  return max_digits.load(std::memory_order_relaxed);
}

void set_max_digits_read(std::size_t digits) {
  max_digits = std::min(digits, kMaxNumberDigits);
}

std::size_t digit_count(std::string_view text) {
  if (text.ends_with("/1")) text.remove_suffix(2);
  if (text.starts_with('-')) text.remove_prefix(1);
  return text.size() - (text.find('/') != std::string_view::npos ? 1 : 0);
}

std::optional<Rational> Rational::parse(std::string_view text) {
  poll_interruption();
  const bool negative = take(text, '-');
  RationalAccess::Owner big = RationalAccess::make();
  if (!set_unsigned(big->value, text)) return std::nullopt;
  if (negative) mpq_neg(big->value, big->value);
  return RationalAccess::take(std::move(big));
}

std::string Rational::text() const {
  poll_interruption();
  if (big_ == nullptr) {
    std::string result = std::to_string(numerator_);
    if (denominator_ != 1) result += '/' + std::to_string(denominator_);
    return result;
  }
  // Room for both terms, the sign, the stroke and the final zero, as GMP asks for.
  std::string result(mpz_sizeinbase(mpq_numref(big_->value), 10) + mpz_sizeinbase(mpq_denref(big_->value), 10) + 3,
                     '\0');
  mpq_get_str(result.data(), 10, big_->value);
  result.resize(result.find('\0'));
  return result;
}

}  // namespace algebra3d
