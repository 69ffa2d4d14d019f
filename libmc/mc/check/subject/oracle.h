#pragma once
/// The 50-digit scalar for which every warp serves as its own high-precision oracle.

#include <mc/core/types.h>

#include <array>
#include <compare>
#include <iosfwd>

namespace mc {

/// A number of 168 binary digits with the functions that warps call. MPFR does the arithmetic, correctly rounded to
/// nearest. Only oracle.cpp includes MPFR, so that templates compile as fast for Oracle as for double.
class Oracle {
 public:
  Oracle() = default; ///< 0
  /// Exact conversion from float and double.
  template <std::floating_point T> Oracle(T x) : Oracle(from(static_cast<double>(x))) {
    static_assert(sizeof(T) <= sizeof(double));
  }
  /// Conversion from integers.
  template <std::signed_integral T> Oracle(T i) : Oracle(from_signed(i)) {}
  /// Conversion from integers.
  template <std::unsigned_integral T> Oracle(T i) : Oracle(from_unsigned(i)) {}
  /// Parses a decimal number; throws Error for other text.
  explicit Oracle(const char* decimal);

  /// Rounds to the nearest double.
  explicit operator double() const;
  /// Rounds once, to the nearest float.
  explicit operator float() const;
  template <std::integral T> explicit operator T() const { return static_cast<T>(truncated()); } ///< rounds towards 0

  /// @cond
  // Arithmetic and comparisons, as for double.
  Oracle operator-() const;
  Oracle operator+() const { return *this; }
  Oracle& operator+=(const Oracle& b) { return *this = *this + b; }
  Oracle& operator-=(const Oracle& b) { return *this = *this - b; }
  Oracle& operator*=(const Oracle& b) { return *this = *this * b; }
  Oracle& operator/=(const Oracle& b) { return *this = *this / b; }
  friend Oracle operator+(const Oracle& a, const Oracle& b);
  friend Oracle operator-(const Oracle& a, const Oracle& b);
  friend Oracle operator*(const Oracle& a, const Oracle& b);
  friend Oracle operator/(const Oracle& a, const Oracle& b);
  friend bool operator==(const Oracle& a, const Oracle& b);
  friend std::partial_ordering operator<=>(const Oracle& a, const Oracle& b);
  /// @endcond
  /// Writes with the format and the precision of the stream.
  friend std::ostream& operator<<(std::ostream& out, const Oracle& x);

 private:
  friend class OracleView;
  long long truncated() const;
  static Oracle from(double x);
  static Oracle from_signed(long long i);
  static Oracle from_unsigned(unsigned long long i);

  // Representation of MPFR by kind: +-3 is the number significand * 2^exponent; +-2 is 0; +-1 is infinity; 0 is NaN.
  std::array<std::uint64_t, 3> significand_{};
  std::int64_t exponent_ = 0;
  int kind_ = 2;
};

/// @cond
// The functions of <cmath>, and erfc_inv, the inverse of erfc.
Oracle abs(const Oracle& x);
Oracle acos(const Oracle& x);
Oracle asin(const Oracle& x);
Oracle atan(const Oracle& x);
Oracle atan2(const Oracle& y, const Oracle& x);
Oracle cbrt(const Oracle& x);
Oracle ceil(const Oracle& x);
Oracle copysign(const Oracle& x, const Oracle& sign);
Oracle cos(const Oracle& x);
Oracle cosh(const Oracle& x);
Oracle erf(const Oracle& x);
Oracle erfc(const Oracle& x);
Oracle erfc_inv(const Oracle& x);
Oracle exp(const Oracle& x);
Oracle expm1(const Oracle& x);
Oracle floor(const Oracle& x);
Oracle fma(const Oracle& a, const Oracle& b, const Oracle& c);
Oracle fmod(const Oracle& x, const Oracle& y);
Oracle frexp(const Oracle& x, int* exponent);
Oracle hypot(const Oracle& x, const Oracle& y);
Oracle ldexp(const Oracle& x, int power);
Oracle log(const Oracle& x);
Oracle log1p(const Oracle& x);
Oracle nextafter(const Oracle& x, const Oracle& towards);
Oracle pow(const Oracle& x, const Oracle& y);
Oracle sin(const Oracle& x);
Oracle sinh(const Oracle& x);
Oracle sqrt(const Oracle& x);
Oracle tan(const Oracle& x);
Oracle tanh(const Oracle& x);
bool isfinite(const Oracle& x);
bool isinf(const Oracle& x);
bool isnan(const Oracle& x);
bool signbit(const Oracle& x);

} // namespace mc

template <> class std::numeric_limits<mc::Oracle> {
 public:
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false;
  static constexpr bool has_infinity = true, has_quiet_NaN = true, has_signaling_NaN = false;
  static constexpr bool is_iec559 = false, is_bounded = true, is_modulo = false;
  static constexpr int radix = 2, digits = 168, digits10 = 50, max_digits10 = 53;
  static constexpr int min_exponent = -1073741823, max_exponent = 1073741823;
  static mc::Oracle min();
  static mc::Oracle max();
  static mc::Oracle lowest();
  static mc::Oracle epsilon();
  static mc::Oracle round_error() { return mc::Oracle(0.5); }
  static mc::Oracle infinity();
  static mc::Oracle quiet_NaN();
};

template <> struct Eigen::NumTraits<mc::Oracle> : Eigen::GenericNumTraits<mc::Oracle> {
  static mc::Oracle dummy_precision() { return 1000 * std::numeric_limits<mc::Oracle>::epsilon(); }
};
/// @endcond
