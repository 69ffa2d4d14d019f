#include <integrands/expression.h>
#include <integrands/peaks.h>

#include <mc/core/error.h>
#include <mc/core/text.h>
#include <mc/core/types.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carlo {

namespace {

constexpr double uniform_share = 0.5;

double constant(std::string_view text) {
  const std::string word(mc::trimmed(text));
  const double value = parse_number(word);
  mc::require(std::isfinite(value), "'{}' is {}; a finite number is needed", word, value);
  return value;
}

// The coordinate of x, inside of the cube.
double inner_coordinate(const VariableBounds& bounds, double x) {
  return std::clamp(unmap_from_bounds(bounds, x), 0x1p-60, 1 - 0x1p-53);
}

} // namespace

double PeakMixture::Axis::sample(double u) const { return centre + width * std::tan(lo + (hi - lo) * u); }

double PeakMixture::Axis::pdf(double x) const { return 1 / ((hi - lo) * width * (1 + mc::sqr((x - centre) / width))); }

PeakMixture::Axis PeakMixture::axis(const std::string& name, double centre, double width) const {
  const auto found =
      std::find_if(bounds_.begin(), bounds_.end(), [&](const VariableBounds& s) { return s.name == name; });
  mc::require(found != bounds_.end(), "there is no variable '{}'; the variables are {}", name,
              first_variables(bounds_.size(), [&](std::size_t i) { return bounds_[i].name; }));
  mc::require(found->lo < found->hi, "{} is not between constant bounds; name variables that are, as in x=0:1", name);
  mc::require(centre >= found->lo && centre <= found->hi, "{} = {:g} lies outside of its bounds {:g} and {:g}", name,
              centre, found->lo, found->hi);
  mc::require(width > 0, "the width {:g} of {} must be above 0", width, name);
  // The spacing of doubles limits x itself, and the coordinate of the unit cube that x is computed from.
  const double u = inner_coordinate(*found, centre);
  const double least = 0x1p-48 * std::max(std::abs(centre), u * map_to_bounds(*found, u).slope);
  mc::require(width >= least, "the width {:g} of {} is below {:.2g}, which doubles resolve at {:g}{}", width, name,
              least, centre, centre == 0 ? "" : fmt::format("; shift {} to 0 there", name));
  return {static_cast<std::size_t>(found - bounds_.begin()), centre, width, std::atan((found->lo - centre) / width),
          std::atan((found->hi - centre) / width)};
}

PeakMixture::Peak PeakMixture::parse(const std::string& text) const {
  constexpr std::string_view separator = " width ";
  const std::size_t at = text.find(separator);
  mc::require(at != text.npos, "it is not of the form \"x=0.3,y=0.6 width 0.01\"");
  std::vector<double> widths;
  for (const std::string_view word : mc::split(std::string_view(text).substr(at + separator.size()), ','))
    widths.push_back(constant(word));
  const auto places = mc::split(std::string_view(text).substr(0, at), ',');
  mc::require(widths.size() == 1 || widths.size() == places.size(), "{} widths of {} variables; give one, or one each",
              widths.size(), places.size());
  Peak peak;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::size_t equals = places[i].find('=');
    mc::require(equals != std::string_view::npos, "'{}' is not of the form x=0.3", places[i]);
    const std::string name(mc::trimmed(places[i].substr(0, equals)));
    peak.push_back(axis(name, constant(places[i].substr(equals + 1)), widths[widths.size() == 1 ? 0 : i]));
    for (std::size_t k = 0; k < i; ++k) mc::require(peak[k].variable != peak[i].variable, "it names '{}' twice", name);
  }
  double log_density = 0;
  for (const Axis& a : peak) {
    const VariableBounds& s = bounds_[a.variable];
    log_density += std::log(a.pdf(a.centre)) + std::log(map_to_bounds(s, inner_coordinate(s, a.centre)).slope);
  }
  mc::require(log_density < 600, "its density overflows: it is too narrow in too many variables");
  return peak;
}

PeakMixture::PeakMixture(const std::vector<std::string>& peaks, std::vector<VariableBounds> bounds)
    : bounds_(std::move(bounds)) {
  for (const std::string& text : peaks)
    peaks_.push_back(mc::with_context(fmt::format("--peak '{}'", text), [&] { return parse(text); }));
}

void PeakMixture::draw(std::span<const double> u, std::span<double> v, double& density) const {
  const double choice = u.back();
  std::copy(u.begin(), u.end() - 1, v.begin());
  const double count = static_cast<double>(peaks_.size());
  if (choice >= uniform_share) {
    const double part = (choice - uniform_share) / (1 - uniform_share) * count;
    for (const Axis& a : peaks_[std::min(static_cast<std::size_t>(part), peaks_.size() - 1)])
      v[a.variable] =
          std::clamp(unmap_from_bounds(bounds_[a.variable], a.sample(u[a.variable])), 0x1p-1000, 1 - 0x1p-53);
  }
  density = uniform_share;
  for (const Peak& peak : peaks_) {
    double product = (1 - uniform_share) / count;
    for (const Axis& a : peak) {
      const MappedPoint at = map_to_bounds(bounds_[a.variable], v[a.variable]);
      product *= a.pdf(at.x) * at.slope;
    }
    density += product;
  }
}

ImportanceDensity PeakMixture::density() const {
  const int uniforms = static_cast<int>(bounds_.size()) + 1;
  return {uniforms, [mixture = *this](std::span<const double> u, std::span<double> v, std::span<double> densities) {
            const std::size_t dim = mixture.bounds_.size();
            for (std::size_t i = 0; i < densities.size(); ++i)
              mixture.draw(u.subspan(i * (dim + 1), dim + 1), v.subspan(i * dim, dim), densities[i]);
          }};
}

} // namespace carlo
