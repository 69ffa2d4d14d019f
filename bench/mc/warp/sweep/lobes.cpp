// Lobes about an axis.
#include "sweep.h"

#include <mc/warp/henyey_greenstein.h>
#include <mc/warp/von_mises_fisher.h>

namespace sweep {
namespace {

double d(const auto& x) { return static_cast<double>(x); }

template <class S> void add(std::vector<Row>& rows, const std::string& scalar, const Effort& effort) {
  rows.push_back(run(
      "HenyeyGreenstein " + scalar, effort,
      [](Draw& r, std::string& p) {
        if (r.often(0.3)) {
          const S g = S(r.sign() * (1 - r.log(static_cast<double>(std::numeric_limits<S>::epsilon()), 1)));
          p = fmt::format("g {}", g);
          return mc::HenyeyGreenstein<S>(g);
        }
        const S h = S(r.log(denormal<S>, 1));
        p = fmt::format("1 - |g| {}", h);
        return mc::HenyeyGreenstein<S>::from_one_minus_abs_g(h, r.often(0.5));
      },
      [](const auto& w) {
        const double h = d(w.one_minus_abs_g());
        return [=](auto, auto) { return Bounds{.invert = h >= 0.1 ? 16 : 16 / h}; };
      }));
  rows.push_back(run(
      "VonMisesFisher " + scalar, effort,
      [](Draw& r, std::string& p) {
        const S kappa = S(r.often(0.05) ? 0 : r.log(denormal<S>, largest<S>));
        p = fmt::format("kappa {}", kappa);
        return mc::VonMisesFisher<S>(kappa);
      },
      [](const auto& w) {
        return [kappa = d(w.kappa())](auto, auto x) { return Bounds{.pdf = 8 + 4 * kappa * d(mc::one_minus_z(x))}; };
      }));
}

} // namespace

std::vector<Row> lobes(const Effort& effort) {
  std::vector<Row> rows;
  add<float>(rows, "float", effort);
  add<double>(rows, "double", effort);
  return rows;
}

} // namespace sweep
