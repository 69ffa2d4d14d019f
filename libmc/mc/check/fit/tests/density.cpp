#include <mc/check/fit/interior_density.h>
#include <mc/check/fit/tests/fit_test.h>
#include <mc/check/subject/point_array.h>

#include <fmt/format.h>

#include <cmath>

namespace mc {
namespace {

std::string describe_density(double density) {
  if (density < 0) return "negative";
  return std::isnan(density) ? "not a number" : "infinite";
}

std::string describe_place(const Subject& s, const Subject::Coordinates& v) {
  if (s.describe_point) return "x = " + s.describe_point(v);
  return "chart coordinates " + format_numbers({v.data(), static_cast<std::size_t>(s.dim)}, 17);
}

} // namespace

// Law: the claimed density is finite and not negative at the random points and at the nodes of the cubature.
FitTest density_law(const FitSetup&, double) {
  return {.judge = [](const FitCounts& counts) {
    const Subject& s = counts.setup.subject;
    if (!counts.invalid_point) return Findings{};
    const double density = interior_density(s, *counts.invalid_point);
    Check c{"pdf finite and >= 0", Verdict::fail, {}, 0, 1, 0, density < 0 ? Fault::negative : Fault::not_finite, {}};
    c.detail = fmt::format("pdf is {}, should be finite and >= 0, at {}", describe_density(density),
                           describe_place(s, *counts.invalid_point));
    return Findings{{std::move(c)}};
  }};
}

} // namespace mc
