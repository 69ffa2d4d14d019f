#include <mc/check/subject/any_distribution.h>
#include <mc/check/subject/quantization.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace mc {

using Kind = Subject::Draw::Kind;

AnyDistribution::Uniforms random_uniforms(const AnyDistribution& s, Pcg& random) {
  AnyDistribution::Uniforms u{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.uniforms); ++i) {
    u[i] = s.is_float ? static_cast<double>(random.uniform<float>()) : random.uniform<double>();
    if (s.open_interval && u[i] == 0) u[i] = s.epsilon() / 2;
  }
  return u;
}

namespace {

Kind kind_of(const AnyDistribution& s, const std::optional<AnyDistribution::Sample>& drawn) {
  if (!drawn) return Kind::failed;
  const auto is_finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(drawn->x.begin(), drawn->x.end(), is_finite)) return Kind::not_finite;
  if (drawn->atom >= 0) return Kind::atom;
  return s.domain.contains && s.domain.contains(drawn->x) ? Kind::point : Kind::outside;
}

} // namespace

double resolution(const AnyDomain& domain, double epsilon, const Subject::Coordinates& v, std::size_t axis) {
  const PointArray x = domain.from_unit(v).x;
  double worst = epsilon * v[axis];
  for (std::size_t i = 0; i < static_cast<std::size_t>(domain.point_size); ++i) {
    PointArray y = x;
    y[i] *= 1 + epsilon;
    worst = std::max(worst, std::abs(domain.to_unit(y)[axis] - v[axis]));
  }
  return worst;
}

ChartSample to_chart(const AnyDistribution& s, const std::optional<AnyDistribution::Sample>& drawn) {
  ChartSample p;
  Subject::Draw& d = p.draw;
  d.kind = kind_of(s, drawn);
  if (d.kind == Kind::atom) {
    d.atom = drawn->atom;
    const auto i = static_cast<std::size_t>(d.atom);
    const double listed = i < s.atoms.size() ? s.atoms[i] : 0.0;
    p.pdf = std::isnan(drawn->pdf) ? listed : drawn->pdf;
  } else if (d.kind == Kind::point) {
    d.v = s.domain.to_unit(drawn->x);
    p.pdf = std::isnan(drawn->pdf) ? s.pdf(drawn->x) : drawn->pdf;
    d.density = p.pdf * s.domain.jacobian(d.v);
  } else return p;
  d.weight = drawn->weight;
  d.pdf_positive = p.pdf > 0 && std::isfinite(p.pdf);
  return p;
}

std::string format_u(const AnyDistribution& s, const AnyDistribution::Uniforms& u) {
  return format_numbers({u.data(), static_cast<std::size_t>(s.uniforms)}, s.digits());
}

std::string format_x(const AnyDistribution& s, const PointArray& x) {
  return format_numbers({x.data(), static_cast<std::size_t>(s.domain.point_size)}, s.digits());
}

namespace {

// Returns radii and angles at chart coordinates v, "r = 0.3, phi = 20 deg"; empty for a domain without them.
std::string describe_angles(const std::vector<Axis>& axes, const Subject::Coordinates& v) {
  std::string text;
  for (std::size_t d = 0; d < std::min<std::size_t>(axes.size(), v.size()); ++d) {
    const Axis& axis = axes[d];
    if (axis.unit().empty() && axis.scale != Axis::Scale::radius && axis.scale != Axis::Scale::ball_radius) continue;
    text += fmt::format("{}{} {:.4g}{}{}", text.empty() ? "" : ", ", axis.name, axis.value(v[d]),
                        axis.unit().empty() ? "" : " ", axis.unit());
  }
  return text;
}

} // namespace

std::string describe_x(const AnyDistribution& s, const PointArray& x) {
  const std::string angles = s.domain.to_unit ? describe_angles(s.domain.axes, s.domain.to_unit(x)) : "";
  return format_x(s, x) + (angles.empty() ? "" : " [" + angles + "]");
}

namespace {

// Returns ", of length 1 + 1e-9" for a point that should be a direction, because its digits do not show the length.
std::string describe_length(const AnyDistribution& s, const PointArray& x) {
  if (s.domain.point_size != 3 || s.domain.dim != 2) return {};
  const auto off = [](const PointArray& y) { return std::hypot(y[0], y[1], y[2]) - 1; };
  for (const AnyDomain::Coordinates& v : {AnyDomain::Coordinates{0.3, 0.4, 0}, AnyDomain::Coordinates{0.7, 0.2, 0}})
    if (!(std::abs(off(s.domain.from_unit(v).x)) < 1e-6)) return {};
  if (!(std::abs(off(x)) > 4 * s.epsilon())) return {};
  return fmt::format(", of length 1 {} {:.2g}", off(x) < 0 ? '-' : '+', std::abs(off(x)));
}

// Returns "x = (0, 1), pdf = 2, eval = 3", or describes the outcome or the fault of the sample.
std::string describe_drawn(const AnyDistribution& s, const AnyDistribution::Sample& drawn) {
  const ChartSample p = to_chart(s, drawn);
  std::string text;
  if (p.draw.kind == Kind::atom)
    return fmt::format("outcome {}, {} = {:.9g}", drawn.atom, s.domain.dim > 0 ? "probability" : "pmf", p.pdf);
  text = "x = " + (p.draw.kind == Kind::point ? describe_x(s, drawn.x) : format_x(s, drawn.x));
  if (p.draw.kind == Kind::outside) text += describe_length(s, drawn.x) + describe_float_rounding(s, drawn.x);
  if (p.draw.kind != Kind::point) return text;
  text += fmt::format(", pdf = {:.9g}", p.pdf);
  if (s.eval) text += fmt::format(", eval = {:.9g}", s.eval(drawn.x));
  return text;
}

// Returns "weight is 0.6, should be 0.5", and the likely reason after "; ".
std::string describe_stated(const AnyDistribution::Sample& drawn) {
  const AnyDistribution::Stated& s = drawn.stated;
  if (std::isnan(s.expected)) return fmt::format("weight is {:.9g} f / pdf, should be f / pdf", drawn.weight);
  return fmt::format("{} is {:.9g}, should be {:.9g}{}{}", s.name, s.value, s.expected, *s.hint ? "; " : "", s.hint);
}

// Returns "u = (0.25, 0.5)", the random numbers that a draw used; empty if it used none or too many.
std::string format_taken(const AnyDistribution& s, Pcg before, const Pcg& after) {
  constexpr int most = 64;
  int words = 0;
  for (Pcg probe = before; words < most && !(probe == after); ++words) probe.next32();
  if (words == 0 || words == most) return {};
  const bool wide = !s.is_float && words % 2 == 0;
  std::vector<double> u(static_cast<std::size_t>(wide ? words / 2 : words));
  for (double& x : u) x = wide ? before.uniform<double>() : static_cast<double>(before.uniform<float>());
  return "u = " + format_numbers(u, wide ? 17 : std::numeric_limits<float>::max_digits10) + ", ";
}

// Returns the random numbers of draw `index` of the stream `seed`.
AnyDistribution::Uniforms uniforms_of_draw(const AnyDistribution& s, std::uint64_t seed, std::uint64_t index) {
  Pcg random(seed);
  random.advance(index * static_cast<std::uint64_t>(s.uniforms) * (s.is_float ? 1 : 2));
  return random_uniforms(s, random);
}

// Draw `index` of the stream `seed` of a distribution without u, and the random numbers that it used.
struct StreamDraw {
  std::optional<AnyDistribution::Sample> drawn;
  std::string taken;
};
StreamDraw draw_of_stream(const AnyDistribution& s, std::uint64_t seed, std::uint64_t index) {
  Pcg random(seed), before = random;
  StreamDraw result;
  for (std::uint64_t i = 0; i <= index; ++i) {
    before = random;
    result.drawn = s.sample_stream(random);
  }
  result.taken = format_taken(s, before, random);
  return result;
}

std::string describe_draw(const AnyDistribution& s, std::uint64_t seed, std::uint64_t index) {
  std::string text;
  if (s.sample) {
    text = describe_sample(s, uniforms_of_draw(s, seed, index));
  } else {
    const StreamDraw again = draw_of_stream(s, seed, index);
    text = again.taken + (again.drawn ? describe_drawn(s, *again.drawn) : "sample fails");
  }
  return fmt::format("{}, draw {} of Pcg({})", text, index, seed);
}

std::string describe_weight(const AnyDistribution& s, std::uint64_t seed, std::uint64_t index) {
  const auto drawn = s.sample ? s.sample(uniforms_of_draw(s, seed, index)) : draw_of_stream(s, seed, index).drawn;
  return drawn ? describe_stated(*drawn) : "sample fails";
}

// Returns the state of a function made by set_shared; null for any other function.
template <class Signature> const void* held_by(const std::function<Signature>& function) {
  const auto* call = function.template target<detail::SharedCall<Signature>>();
  return call ? call->held.get() : nullptr;
}

bool draws_as_it_samples(const AnyDistribution& s) {
  const void* held = held_by(s.draw_many);
  return held && held == held_by(s.sample) && held == held_by(s.pdf);
}

// Passes n random u of the stream `seed` to `take`, in batches small enough for the cache. Distributions with
// sample_many receive all u in one batch.
template <class Take> void in_batches(const AnyDistribution& s, std::uint64_t seed, std::size_t n, const Take& take) {
  Pcg random(seed);
  std::vector<AnyDistribution::Uniforms> u(s.sample_many ? n : std::min<std::size_t>(n, 256));
  for (std::size_t left = n; left > 0; left -= u.size()) {
    u.resize(std::min(left, u.size()));
    for (AnyDistribution::Uniforms& one : u) one = random_uniforms(s, random);
    take(u);
  }
}

// Passes the sample of each u to `take`.
template <class Take>
void sample_each(const AnyDistribution& s, const std::vector<AnyDistribution::Uniforms>& u, const Take& take) {
  if (s.sample_many)
    for (const auto& drawn : s.sample_many(u)) take(drawn);
  else
    for (const AnyDistribution::Uniforms& one : u) take(s.sample(one));
}

void append_chart_samples(const AnyDistribution& s, const std::vector<AnyDistribution::Uniforms>& u,
                          std::vector<Subject::Draw>& out) {
  sample_each(s, u, [&](const auto& drawn) { out.push_back(to_chart(s, drawn).draw); });
}

void append_draws(const AnyDistribution& s, std::uint64_t seed, std::size_t n, std::vector<Subject::Draw>& out) {
  if (s.sample_stream_many) {
    for (const auto& drawn : s.sample_stream_many(seed, n)) out.push_back(to_chart(s, drawn).draw);
    return;
  }
  if (!s.sample) {
    Pcg random(seed);
    for (std::size_t i = 0; i < n; ++i) out.push_back(to_chart(s, s.sample_stream(random)).draw);
    return;
  }
  const bool placed = draws_as_it_samples(s) && !s.sample_many;
  in_batches(s, seed, n, [&](const std::vector<AnyDistribution::Uniforms>& u) {
    if (placed) {
      out.resize(out.size() + u.size());
      s.draw_many(u, std::span(out).last(u.size()));
    } else {
      append_chart_samples(s, u, out);
    }
  });
}

std::vector<Subject::Coordinates> inverted_draws(const AnyDistribution& s, std::uint64_t seed, std::size_t n) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Subject::Coordinates> inverted;
  inverted.reserve(n);
  const auto add = [&](const std::optional<AnyDistribution::Uniforms>& u) {
    inverted.push_back(u ? *u : Subject::Coordinates{nan, nan, nan, nan, nan, nan});
  };
  std::vector<PointArray> points;
  in_batches(s, seed, n, [&](const std::vector<AnyDistribution::Uniforms>& u) {
    points.clear();
    sample_each(s, u, [&](const std::optional<AnyDistribution::Sample>& drawn) {
      if (kind_of(s, drawn) == Kind::point) points.push_back(drawn->x);
    });
    if (s.invert_many)
      for (const auto& one : s.invert_many(points)) add(one);
    else
      for (const PointArray& x : points) add(s.invert(x));
  });
  return inverted;
}

} // namespace

std::string describe_sample(const AnyDistribution& s, const AnyDistribution::Uniforms& u) {
  if (s.describe) return "u = " + format_u(s, u) + ", " + s.describe(u);
  const auto drawn = s.sample(u);
  return "u = " + format_u(s, u) + ", " + (drawn ? describe_drawn(s, *drawn) : "sample fails");
}

Subject make_subject(const AnyDistribution& distribution) {
  const auto shared = std::make_shared<const AnyDistribution>(distribution);
  const AnyDistribution& s = *shared;
  Subject subject;
  subject.name = s.name;
  subject.dim = s.domain.dim;
  subject.axes = s.domain.axes;
  subject.atoms = s.atoms;
  subject.breaks = s.breaks;
  subject.may_fail = s.may_fail;
  subject.epsilon = s.epsilon();
  subject.mass_tolerance = s.mass_tolerance > 0 ? s.mass_tolerance : 64 * s.epsilon();
  subject.weight_tolerance = s.weight_tolerance;
  subject.draw = [shared](std::uint64_t seed, std::size_t n, std::vector<Subject::Draw>& out) {
    append_draws(*shared, seed, n, out);
  };
  subject.describe_draw = [shared](std::uint64_t seed, std::uint64_t index) {
    return describe_draw(*shared, seed, index);
  };
  subject.describe_weight = [shared](std::uint64_t seed, std::uint64_t index) {
    return describe_weight(*shared, seed, index);
  };
  if (s.domain.dim == 0) return subject;
  subject.density = [shared](const Subject::Coordinates& v) {
    const AnyDomain::DomainPoint at = shared->domain.from_unit(v);
    return shared->pdf(at.x) * at.jacobian;
  };
  if (s.pdf_many)
    subject.densities = [shared](std::span<const Subject::Coordinates> v, std::span<double> densities) {
      std::vector<PointArray> x;
      std::vector<double> jacobians;
      for (const Subject::Coordinates& one : v) {
        const AnyDomain::DomainPoint at = shared->domain.from_unit(one);
        x.push_back(at.x);
        jacobians.push_back(at.jacobian);
      }
      const std::vector<double> pdf = shared->pdf_many(x);
      for (std::size_t i = 0; i < v.size(); ++i) densities[i] = pdf[i] * jacobians[i];
    };
  subject.resolution = [shared](const Subject::Coordinates& v, int axis) {
    return resolution(shared->domain, shared->epsilon(), v, static_cast<std::size_t>(axis));
  };
  subject.describe_point = [shared](const Subject::Coordinates& v) {
    const PointArray x = shared->domain.from_unit(v).x;
    return format_numbers({x.data(), static_cast<std::size_t>(shared->domain.point_size)},
                          std::numeric_limits<float>::max_digits10);
  };
  if (s.sample && s.invert && s.invert_tolerance > 0) {
    subject.invert_error = s.invert_tolerance;
    subject.inverted = [shared](std::uint64_t seed, std::size_t n) { return inverted_draws(*shared, seed, n); };
  }
  return subject;
}

} // namespace mc
