#include <mc/check/subject/oracle.h>

#include <mc/core/erf.h>
#include <mc/core/error.h>

#include <mpfr.h>

#include <array>
#include <cmath>
#include <ostream>
#include <string>

namespace mc {

using numeric_limits = std::numeric_limits<Oracle>;
constexpr int digits = numeric_limits::digits;

/// MPFR's representation of an Oracle, for the duration of one call.
class OracleView {
 public:
  OracleView() : OracleView(Oracle()) {}
  explicit OracleView(const Oracle& x) : significand_(x.significand_) {
    static_assert(sizeof(significand_) * 8 >= static_cast<std::size_t>(digits));
    mpfr_custom_init_set(number_, x.kind_, static_cast<mpfr_exp_t>(x.exponent_), digits, significand_.data());
  }
  OracleView(const OracleView&) = delete;
  OracleView& operator=(const OracleView&) = delete;

  mpfr_ptr get() { return number_; }
  Oracle value() const {
    Oracle x;
    x.significand_ = significand_;
    x.kind_ = mpfr_custom_get_kind(number_);
    x.exponent_ = mpfr_custom_get_exp(number_);
    return x;
  }
  static int kind(const Oracle& x) { return x.kind_; }
  static Oracle negated(Oracle x) {
    x.kind_ = -x.kind_;
    return x;
  }

 private:
  std::array<std::uint64_t, 3> significand_;
  mpfr_t number_;
};

namespace {

// MPFR caches pi and log 2 for each thread; this frees the cache when the thread ends.
struct Constants {
  ~Constants() { mpfr_free_cache2(MPFR_FREE_LOCAL_CACHE); }
  void keep() {}
};
thread_local Constants constants;

// Returns the rounded result of a function of MPFR.
template <class F, class... X> Oracle call(F f, const X&... x) {
  constants.keep();
  OracleView result;
  f(result.get(), x..., MPFR_RNDN);
  return result.value();
}
Oracle apply(int (*f)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t), const Oracle& x) { return call(f, OracleView(x).get()); }
Oracle apply(int (*f)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t), const Oracle& x, const Oracle& y) {
  return call(f, OracleView(x).get(), OracleView(y).get());
}

// Returns a root near x > 0 by Newton's method: iterates to half of the digits, then once more. step(x) is f / f'.
template <class Step> Oracle newton_root(Oracle x, Step&& step) {
  const Oracle settled = ldexp(Oracle(1), -digits / 2 - 8);
  for (Oracle change = x; abs(change) > abs(x) * settled;) x -= change = step(x);
  return x;
}

// Returns the format in which the stream writes a double.
const char* mpfr_format(const std::ostream& out) {
  const auto style = out.flags() & std::ios_base::floatfield;
  if (style == std::ios_base::scientific) return "%.*Re";
  return style == std::ios_base::fixed ? "%.*Rf" : "%.*Rg";
}

} // namespace

Oracle::Oracle(const char* decimal) {
  OracleView view;
  require(mpfr_set_str(view.get(), decimal, 10, MPFR_RNDN) == 0, "Oracle: \"{}\" is no number", decimal);
  *this = view.value();
}
Oracle Oracle::from(double x) { return call(mpfr_set_d, x); }
Oracle Oracle::from_signed(long long i) { return call(mpfr_set_si_2exp, i, 0); }
Oracle Oracle::from_unsigned(unsigned long long i) { return call(mpfr_set_ui_2exp, i, 0); }

Oracle::operator double() const { return mpfr_get_d(OracleView(*this).get(), MPFR_RNDN); }
Oracle::operator float() const { return mpfr_get_flt(OracleView(*this).get(), MPFR_RNDN); }
long long Oracle::truncated() const { return mpfr_get_si(OracleView(*this).get(), MPFR_RNDZ); }

Oracle Oracle::operator-() const { return OracleView::negated(*this); }
Oracle operator+(const Oracle& a, const Oracle& b) { return apply(mpfr_add, a, b); }
Oracle operator-(const Oracle& a, const Oracle& b) { return apply(mpfr_sub, a, b); }
Oracle operator*(const Oracle& a, const Oracle& b) { return apply(mpfr_mul, a, b); }
Oracle operator/(const Oracle& a, const Oracle& b) { return apply(mpfr_div, a, b); }

bool operator==(const Oracle& a, const Oracle& b) {
  return mpfr_equal_p(OracleView(a).get(), OracleView(b).get()) != 0;
}
std::partial_ordering operator<=>(const Oracle& a, const Oracle& b) {
  if (isnan(a) || isnan(b)) return std::partial_ordering::unordered;
  const int order = (mpfr_cmp)(OracleView(a).get(), OracleView(b).get());
  return order <=> 0;
}

std::ostream& operator<<(std::ostream& out, const Oracle& x) {
  const char* format = mpfr_format(out);
  const int precision = static_cast<int>(out.precision());
  OracleView view(x);
  std::string text(static_cast<std::size_t>(mpfr_snprintf(nullptr, 0, format, precision, view.get())), ' ');
  mpfr_snprintf(text.data(), text.size() + 1, format, precision, view.get());
  return out << text;
}

Oracle abs(const Oracle& x) { return OracleView::kind(x) < 0 ? -x : x; }
Oracle acos(const Oracle& x) { return apply(mpfr_acos, x); }
Oracle asin(const Oracle& x) { return apply(mpfr_asin, x); }
Oracle atan(const Oracle& x) { return apply(mpfr_atan, x); }
Oracle atan2(const Oracle& y, const Oracle& x) { return apply(mpfr_atan2, y, x); }
Oracle cbrt(const Oracle& x) { return apply(mpfr_cbrt, x); }
Oracle ceil(const Oracle& x) { return apply(mpfr_rint_ceil, x); }
Oracle copysign(const Oracle& x, const Oracle& sign) { return signbit(x) == signbit(sign) ? x : -x; }
Oracle cos(const Oracle& x) { return apply(mpfr_cos, x); }
Oracle cosh(const Oracle& x) { return apply(mpfr_cosh, x); }
Oracle erf(const Oracle& x) { return apply(mpfr_erf, x); }
Oracle erfc(const Oracle& x) { return apply(mpfr_erfc, x); }
Oracle erfc_inv(const Oracle& p) {
  if (p > 1) return -erfc_inv(2 - p);
  if (p == 0) return numeric_limits::infinity();
  if (!(p > 0)) return numeric_limits::quiet_NaN();
  static const Oracle half_root_pi = sqrt(acos(Oracle(-1))) / 2;
  const auto least = std::numeric_limits<double>::min();
  const double near = p >= least ? erfc_inv(static_cast<double>(p)) : infinity<double>;
  // erf is concave above 0: Newton's method stays below the root when it starts there. The tangent at 0 gives such a
  // start.
  if (const Oracle z = 1 - p; z < 0.5)
    return newton_root(near > 1e-6 ? Oracle(near) : half_root_pi * z,
                       [&](const Oracle& x) { return half_root_pi * exp(x * x) * (erf(x) - z); });
  // log erfc(x) is concave: Newton's method stays above the root when it starts there. -x^2 gives such a start.
  return newton_root(std::isfinite(near) ? Oracle(near) : sqrt(-log(p)), [log_p = log(p)](const Oracle& x) {
    return half_root_pi * exp(x * x) * erfc(x) * (log_p - log(erfc(x)));
  });
}
Oracle exp(const Oracle& x) { return apply(mpfr_exp, x); }
Oracle expm1(const Oracle& x) { return apply(mpfr_expm1, x); }
Oracle floor(const Oracle& x) { return apply(mpfr_rint_floor, x); }
Oracle fma(const Oracle& a, const Oracle& b, const Oracle& c) {
  return call(mpfr_fma, OracleView(a).get(), OracleView(b).get(), OracleView(c).get());
}
Oracle fmod(const Oracle& x, const Oracle& y) { return apply(mpfr_fmod, x, y); }
Oracle frexp(const Oracle& x, int* exponent) {
  mpfr_exp_t e = 0;
  OracleView result;
  mpfr_frexp(&e, result.get(), OracleView(x).get(), MPFR_RNDN);
  *exponent = static_cast<int>(e);
  return result.value();
}
Oracle hypot(const Oracle& x, const Oracle& y) { return apply(mpfr_hypot, x, y); }
Oracle ldexp(const Oracle& x, int power) { return call(mpfr_mul_2si, OracleView(x).get(), power); }
Oracle log(const Oracle& x) { return apply(mpfr_log, x); }
Oracle log1p(const Oracle& x) { return apply(mpfr_log1p, x); }
Oracle nextafter(const Oracle& x, const Oracle& towards) {
  OracleView next(x);
  mpfr_nexttoward(next.get(), OracleView(towards).get());
  return next.value();
}
Oracle pow(const Oracle& x, const Oracle& y) { return apply(mpfr_pow, x, y); }
Oracle sin(const Oracle& x) { return apply(mpfr_sin, x); }
Oracle sinh(const Oracle& x) { return apply(mpfr_sinh, x); }
Oracle sqrt(const Oracle& x) { return apply(mpfr_sqrt, x); }
Oracle tan(const Oracle& x) { return apply(mpfr_tan, x); }
Oracle tanh(const Oracle& x) { return apply(mpfr_tanh, x); }
bool isfinite(const Oracle& x) { return std::abs(OracleView::kind(x)) > MPFR_INF_KIND; }
bool isinf(const Oracle& x) { return std::abs(OracleView::kind(x)) == MPFR_INF_KIND; }
bool isnan(const Oracle& x) { return OracleView::kind(x) == MPFR_NAN_KIND; }
bool signbit(const Oracle& x) { return OracleView::kind(x) < 0; }

} // namespace mc

mc::Oracle std::numeric_limits<mc::Oracle>::min() { return ldexp(mc::Oracle(1), min_exponent - 1); }
mc::Oracle std::numeric_limits<mc::Oracle>::max() { return nextafter(infinity(), 0); }
mc::Oracle std::numeric_limits<mc::Oracle>::lowest() { return -max(); }
mc::Oracle std::numeric_limits<mc::Oracle>::epsilon() {
  static const mc::Oracle eps = ldexp(mc::Oracle(1), 1 - digits);
  return eps;
}
mc::Oracle std::numeric_limits<mc::Oracle>::infinity() { return 1 / mc::Oracle(); }
mc::Oracle std::numeric_limits<mc::Oracle>::quiet_NaN() { return infinity() - infinity(); }
