#include <mc/check/subject/oracle.h>

#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/next.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <ostream>

namespace mc {

namespace mp = boost::multiprecision;
using Number = mp::number<mp::cpp_bin_float<50>, mp::et_off>;
using Backend = Number::backend_type;
static_assert(Backend::bit_count == std::numeric_limits<Oracle>::digits);
static_assert(std::numeric_limits<Number>::min_exponent == std::numeric_limits<Oracle>::min_exponent);
static_assert(std::numeric_limits<Number>::max_exponent == std::numeric_limits<Oracle>::max_exponent);

/// Number and Oracle of the same value.
struct OracleNumber {
  static Number unpack(const Oracle& x) {
    static_assert(Oracle::zero_exponent == Backend::exponent_zero);
    Number n;
    auto& bits = n.backend().bits();
    bits.resize(3, 3);
    std::copy(x.mantissa_.begin(), x.mantissa_.end(), bits.limbs());
    bits.normalize();
    n.backend().exponent() = x.exponent_;
    n.backend().sign() = x.negative_;
    return n;
  }
  static Oracle pack(const Number& n) {
    const auto& bits = n.backend().bits();
    static_assert(sizeof(*bits.limbs()) == sizeof(std::uint64_t));
    Oracle x;
    std::copy_n(bits.limbs(), bits.size(), x.mantissa_.begin());
    x.exponent_ = n.backend().exponent();
    x.negative_ = n.backend().sign();
    return x;
  }
};

namespace {

Number unpack(const Oracle& x) { return OracleNumber::unpack(x); }
Oracle pack(const Number& n) { return OracleNumber::pack(n); }

} // namespace

Oracle::Oracle(const char* decimal) : Oracle(pack(Number(decimal))) {}
Oracle Oracle::from(double x) { return pack(Number(x)); }
Oracle Oracle::from_signed(long long i) { return pack(Number(i)); }
Oracle Oracle::from_unsigned(unsigned long long i) { return pack(Number(i)); }

Oracle::operator double() const { return static_cast<double>(unpack(*this)); }
Oracle::operator float() const { return static_cast<float>(unpack(*this)); }
long long Oracle::truncated() const { return static_cast<long long>(unpack(*this)); }

Oracle Oracle::operator-() const { return pack(-unpack(*this)); }
Oracle operator+(const Oracle& a, const Oracle& b) { return pack(unpack(a) + unpack(b)); }
Oracle operator-(const Oracle& a, const Oracle& b) { return pack(unpack(a) - unpack(b)); }
Oracle operator*(const Oracle& a, const Oracle& b) { return pack(unpack(a) * unpack(b)); }
Oracle operator/(const Oracle& a, const Oracle& b) { return pack(unpack(a) / unpack(b)); }

bool operator==(const Oracle& a, const Oracle& b) { return unpack(a) == unpack(b); }
std::partial_ordering operator<=>(const Oracle& a, const Oracle& b) {
  const Number m = unpack(a), n = unpack(b);
  if (m < n) return std::partial_ordering::less;
  if (m > n) return std::partial_ordering::greater;
  return m == n ? std::partial_ordering::equivalent : std::partial_ordering::unordered;
}

std::ostream& operator<<(std::ostream& out, const Oracle& x) { return out << unpack(x); }

Oracle abs(const Oracle& x) { return pack(abs(unpack(x))); }
Oracle acos(const Oracle& x) { return pack(acos(unpack(x))); }
Oracle asin(const Oracle& x) { return pack(asin(unpack(x))); }
Oracle atan(const Oracle& x) { return pack(atan(unpack(x))); }
Oracle atan2(const Oracle& y, const Oracle& x) { return pack(atan2(unpack(y), unpack(x))); }
Oracle cbrt(const Oracle& x) { return pack(cbrt(unpack(x))); }
Oracle ceil(const Oracle& x) { return pack(ceil(unpack(x))); }
Oracle copysign(const Oracle& x, const Oracle& sign) { return signbit(x) == signbit(sign) ? x : -x; }
Oracle cos(const Oracle& x) { return pack(cos(unpack(x))); }
Oracle cosh(const Oracle& x) { return pack(cosh(unpack(x))); }
Oracle erf(const Oracle& x) { return pack(boost::math::erf(unpack(x))); }
Oracle erfc(const Oracle& x) { return pack(boost::math::erfc(unpack(x))); }
Oracle erfc_inv(const Oracle& x) { return pack(boost::math::erfc_inv(unpack(x))); }
Oracle exp(const Oracle& x) { return pack(exp(unpack(x))); }
Oracle expm1(const Oracle& x) { return pack(expm1(unpack(x))); }
Oracle floor(const Oracle& x) { return pack(floor(unpack(x))); }
Oracle fma(const Oracle& a, const Oracle& b, const Oracle& c) { return pack(fma(unpack(a), unpack(b), unpack(c))); }
Oracle fmod(const Oracle& x, const Oracle& y) { return pack(fmod(unpack(x), unpack(y))); }
Oracle frexp(const Oracle& x, int* exponent) { return pack(frexp(unpack(x), exponent)); }
Oracle hypot(const Oracle& x, const Oracle& y) { return pack(hypot(unpack(x), unpack(y))); }
Oracle ldexp(const Oracle& x, int power) { return pack(ldexp(unpack(x), power)); }
Oracle log(const Oracle& x) { return pack(log(unpack(x))); }
Oracle log1p(const Oracle& x) { return pack(log1p(unpack(x))); }
Oracle nextafter(const Oracle& x, const Oracle& towards) {
  return pack(boost::math::nextafter(unpack(x), unpack(towards)));
}
Oracle pow(const Oracle& x, const Oracle& y) { return pack(pow(unpack(x), unpack(y))); }
Oracle sin(const Oracle& x) { return pack(sin(unpack(x))); }
Oracle sinh(const Oracle& x) { return pack(sinh(unpack(x))); }
Oracle sqrt(const Oracle& x) { return pack(sqrt(unpack(x))); }
Oracle tan(const Oracle& x) { return pack(tan(unpack(x))); }
Oracle tanh(const Oracle& x) { return pack(tanh(unpack(x))); }
bool isfinite(const Oracle& x) { return isfinite(unpack(x)); }
bool isinf(const Oracle& x) { return isinf(unpack(x)); }
bool isnan(const Oracle& x) { return isnan(unpack(x)); }
bool signbit(const Oracle& x) { return signbit(unpack(x)); }

} // namespace mc

using Limits = std::numeric_limits<mc::Number>;
mc::Oracle std::numeric_limits<mc::Oracle>::min() { return mc::pack((Limits::min)()); }
mc::Oracle std::numeric_limits<mc::Oracle>::max() { return mc::pack((Limits::max)()); }
mc::Oracle std::numeric_limits<mc::Oracle>::lowest() { return mc::pack(Limits::lowest()); }
mc::Oracle std::numeric_limits<mc::Oracle>::epsilon() {
  static const mc::Oracle eps = mc::pack(Limits::epsilon());
  return eps;
}
mc::Oracle std::numeric_limits<mc::Oracle>::infinity() { return mc::pack(Limits::infinity()); }
mc::Oracle std::numeric_limits<mc::Oracle>::quiet_NaN() { return mc::pack(Limits::quiet_NaN()); }
