#include <plugin/domain.h>
#include <plugin/plugin.h>

#include <mc/check/check_subject.h>
#include <mc/check/laws/law_ledger.h>
#include <mc/check/subject/chart_axes.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <variant>

namespace carlo {

namespace {

using mc::Subject;

// weight pdf / f, 1 where they agree.
template <class D> double weight_ratio(const Plugged<D>& p, const Uniforms& u) {
  const auto x = p.sample(u);
  const double f = p.eval(*x), stated = p.weight(u, *x);
  return f == 0 && stated == 0 ? 1.0 : stated * p.pdf(*x) / f;
}

template <class D> Subject subject_of(const Plugged<D>& p, const std::string& title) {
  Subject s = mc::make_subject(
      title, p.domain, [p](mc::Pcg& random) { return p.sample(p.uniforms(random)); },
      [p](const typename D::Point& x) { return p.pdf(x); });
  s.axes = std::visit([](const auto& d) { return mc::chart_axes(d); }, p.domain.which);
  s.may_fail = p.plugin->may_fail != 0;
  if (p.plugin->pdf_tolerance > 0) s.mass_tolerance = p.plugin->pdf_tolerance;
  if (p.plugin->weight_tolerance > 0) s.weight_tolerance = p.plugin->weight_tolerance;
  s.describe_draw = [p](std::uint64_t seed, std::uint64_t index) { return p.describe(p.uniforms_at(seed, index)); };
  if (!p.plugin->weight) return s;
  s.draw = [p, draw = s.draw](std::uint64_t seed, std::size_t n, std::vector<Subject::Draw>& out) {
    const std::size_t first = out.size();
    draw(seed, n, out);
    mc::Pcg random(seed);
    for (std::size_t i = first; i < out.size(); ++i) {
      const Uniforms u = p.uniforms(random);
      if (out[i].kind == Subject::Draw::Kind::point) out[i].weight = weight_ratio(p, u);
    }
  };
  return s;
}

// fine(u) at u in {0, 2^-24, 1/2, 1 - 2^-24, 1 - ulp}^n.
template <class D, class Describe, class Fine> mc::Check edge_law(const Plugged<D>& p, Describe describe, Fine fine) {
  const double last = static_cast<double>(mc::one_minus_epsilon<typename D::Scalar>);
  const std::array<double, 5> places{0, 0x1p-24, 0.5, 1 - 0x1p-24, last};
  int total = 1;
  for (int i = 0; i < p.plugin.uniforms(); ++i) total *= static_cast<int>(places.size());
  mc::LawLedger ledger("edges of the unit cube", 0, mc::Fault::edge);
  for (int k = 0; k < total; ++k) {
    Uniforms u{};
    for (int i = 0, rest = k; i < p.plugin.uniforms(); ++i, rest /= 5)
      u[static_cast<std::size_t>(i)] = places[static_cast<std::size_t>(rest % 5)];
    ledger.note(fine(u) ? 0 : 1,
                [&] { return "not a point of the domain with a positive, finite pdf: " + describe(u); });
  }
  return ledger.check();
}

template <class D> mc::Check edge_law(const Plugged<D>& p) {
  return edge_law(
      p, [&](const Uniforms& u) { return p.describe(u); },
      [&](const Uniforms& u) {
        const auto x = p.sample(u);
        if (!x) return p.plugin->may_fail != 0;
        if (!mc::detail::all_finite(*x) || !p.domain.contains(*x)) return false;
        const double density = p.pdf(*x);
        return density > 0 && std::isfinite(density);
      });
}

// eval >= 0 and finite, and positive only where pdf is, at uniform points of the chart.
template <class D> void eval_laws(const Plugged<D>& p, std::uint64_t seed, std::vector<mc::Check>& laws) {
  mc::LawLedger sign("eval finite and >= 0", 0, mc::Fault::physics),
      support("pdf > 0 where eval > 0", 0, mc::Fault::support);
  mc::Pcg random(seed, 31);
  for (int k = 0; k < 20000; ++k) {
    const auto x = p.domain.from_unit(random.point<typename D::Scalar, D::dim>());
    if (!mc::detail::all_finite(x)) continue;
    const double f = p.eval(x), density = p.pdf(x);
    const auto where = [&] {
      return fmt::format("x = {}, eval = {:.9g}, pdf = {:.9g}", mc::detail::format_point(x), f, density);
    };
    sign.note(f >= 0 && std::isfinite(f) ? 0 : 1, where);
    support.note(f > 0 && !(density > 0) ? 1 : 0, where);
  }
  laws.push_back(sign.check());
  laws.push_back(support.check());
}

template <class D> mc::Check inverse_law(const Plugged<D>& p, std::uint64_t seed) {
  const double eps = static_cast<double>(std::numeric_limits<typename D::Scalar>::epsilon());
  mc::LawLedger ledger("invert(sample(u)) = u",
                       p.plugin->invert_tolerance > 0 ? p.plugin->invert_tolerance : std::sqrt(eps),
                       mc::Fault::inverse);
  mc::Pcg random(seed, 32);
  for (int k = 0; k < 20000; ++k) {
    const Uniforms u = p.uniforms(random);
    const auto x = p.sample(u);
    if (!x) continue;
    const auto back = p.invert(*x);
    double worst = back ? 0 : HUGE_VAL;
    for (int i = 0; back && i < p.plugin.uniforms(); ++i) {
      double off = std::abs((*back)[static_cast<std::size_t>(i)] - u[static_cast<std::size_t>(i)]);
      // The two sides of an azimuth's seam are one point.
      if (off > 0.5 && off <= 1)
        if (const auto again = p.sample(*back); again && p.same(*again, *x)) off = 1 - off;
      worst = off <= worst ? worst : off;
    }
    ledger.note(worst, [&] {
      return back ? fmt::format("u = {}, invert(sample(u)) = {}", p.format(u), p.format(*back))
                  : fmt::format("u = {}: invert fails", p.format(u));
    });
  }
  return ledger.check();
}

// |det d sample / d u| pdf = 1 by central differences in double. Three steps bound the error of their own result, which
// is taken off; rounding of an ill-conditioned sampler may still slip through at single points, so the upper quartile
// is judged.
template <class D> mc::Check jacobian_law(const Plugged<D>& p, std::uint64_t seed) {
  constexpr int dim = D::dim;
  constexpr double limit = 1e-6, first_step = 0x1p-12;
  struct Point {
    double off;
    Uniforms u;
  };
  std::vector<Point> points;
  mc::Pcg random(seed, 33);
  const auto determinant = [&](const Uniforms& u, double h) {
    std::array<mc::Vec3<double>, 3> columns = {mc::Vec3<double>::UnitX(), mc::Vec3<double>::UnitY(),
                                               mc::Vec3<double>::UnitZ()};
    for (int axis = 0; axis < dim; ++axis) {
      Uniforms ahead = u, behind = u;
      ahead[static_cast<std::size_t>(axis)] += h, behind[static_cast<std::size_t>(axis)] -= h;
      const auto a = p.sample(ahead), b = p.sample(behind);
      if (!a || !b) return std::numeric_limits<double>::quiet_NaN();
      const auto va = p.domain.to_unit(*a), vb = p.domain.to_unit(*b);
      for (int i = 0; i < dim; ++i)
        columns[static_cast<std::size_t>(axis)][i] =
            (mc::detail::component(va, i) - mc::detail::component(vb, i)) / (2 * h);
    }
    return std::abs(columns[0].dot(mc::cross(columns[1], columns[2])));
  };
  for (int k = 0; k < 1000; ++k) {
    Uniforms u = p.uniforms(random);
    for (int i = 0; i < dim; ++i)
      u[static_cast<std::size_t>(i)] = first_step + (1 - 2 * first_step - 0x1p-40) * u[static_cast<std::size_t>(i)];
    const auto x = p.sample(u);
    if (!x) continue;
    const double claim = p.pdf(*x) * p.domain.jacobian(p.domain.to_unit(*x));
    const double a = claim * determinant(u, first_step), b = claim * determinant(u, first_step / 2),
                 c = claim * determinant(u, first_step / 4);
    const double spread = std::max({a, b, c}) - std::min({a, b, c}), off = std::abs(c - 1) - 16 * spread;
    points.push_back({off > 0 ? off : 0.0, u});
  }
  mc::Check check{"|det| pdf = 1, upper quartile", mc::Verdict::pass, {}, 0, 0, limit, mc::Fault::jacobian, {}};
  if (points.size() < 100) return check;
  const auto quartile = points.begin() + static_cast<std::ptrdiff_t>(points.size() * 3 / 4);
  std::nth_element(points.begin(), quartile, points.end(),
                   [](const Point& a, const Point& b) { return a.off < b.off; });
  check.statistic = quartile->off;
  if (!(check.statistic <= limit)) check.verdict = mc::Verdict::fail, check.detail = p.describe(quartile->u);
  return check;
}

template <class D> double ns_per_sample(const Plugged<D>& p) {
  constexpr int n = 1 << 11;
  mc::Pcg random(3);
  std::vector<Uniforms> u;
  for (int i = 0; i < n; ++i) u.push_back(p.uniforms(random));
  double best = HUGE_VAL;
  Coordinates x{};
  for (int round = 0; round < 4; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (const Uniforms& one : u) p.plugin.sample(one.data(), x.data());
    best =
        std::min(best, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / n);
  }
  return best;
}

template <mc::Domain D>
mc::Report check_on(const PluginSampler& plugin, const D& domain, const std::string& title,
                    const CaseOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const Plugged<D> p{plugin, domain};
  std::vector<mc::Check> laws{edge_law(p)};
  if (plugin->eval) eval_laws(p, options.seed, laws);
  if (plugin->invert) {
    laws.push_back(inverse_law(p, options.seed));
    if constexpr (std::same_as<typename D::Scalar, double>) laws.push_back(jacobian_law(p, options.seed));
  }
  mc::SubjectOptions o;
  o.samples = options.samples, o.seed = options.seed, o.alpha = options.alpha, o.evidence = options.evidence;
  mc::Report report = check_subject(subject_of(p, title), o);
  report.checks.insert(report.checks.end(), laws.begin(), laws.end());
  report.ns_per_sample = ns_per_sample(p);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

// The quartiles of the samples on a line: charts of infinite intervals are centred on them.
std::array<double, 3> quartiles(const PluginSampler& plugin, std::uint64_t seed) {
  mc::Pcg random(seed, 34);
  std::vector<double> drawn;
  for (int i = 0; i < 1000; ++i) {
    Uniforms u{};
    for (int k = 0; k < plugin.uniforms(); ++k) u[static_cast<std::size_t>(k)] = random.uniform<double>();
    double x = std::numeric_limits<double>::quiet_NaN();
    if (plugin.sample(u.data(), &x) && std::isfinite(x)) drawn.push_back(x);
  }
  if (drawn.empty()) return {-1, 0, 1};
  std::sort(drawn.begin(), drawn.end());
  return {drawn[drawn.size() / 4], drawn[drawn.size() / 2], drawn[drawn.size() * 3 / 4]};
}

template <mc::Real S>
mc::Report check_infinite(const PluginSampler& plugin, const std::string& title, const CaseOptions& options) {
  const auto [low, middle, high] = quartiles(plugin, options.seed);
  const double lo = plugin->lo[0], hi = plugin->hi[0];
  const auto scale = [](double size) { return static_cast<S>(size > 0 ? size : 1.0); };
  if (std::isinf(lo) && std::isinf(hi))
    return check_on(plugin, Line<S>{mc::RealLine<S>(static_cast<S>(middle), scale(high - low))}, title, options);
  if (std::isinf(hi))
    return check_on(plugin, Line<S>{mc::HalfLine<S>(static_cast<S>(lo), scale(middle - lo))}, title, options);
  return check_on(plugin, Line<S>{mc::HalfLine<S>(static_cast<S>(hi), -scale(hi - middle))}, title, options);
}

// Outcomes 0 to n - 1 as atoms; an x that is none of them is outside.
template <mc::Real S>
mc::Report check_discrete(const PluginSampler& plugin, const std::string& title, const CaseOptions& options) {
  using Kind = Subject::Draw::Kind;
  const auto start = std::chrono::steady_clock::now();
  const Plugged<Line<S>> p{plugin, {}}; // for its uniforms
  Subject s;
  s.name = title;
  s.may_fail = plugin->may_fail != 0;
  s.mass_tolerance =
      plugin->pdf_tolerance > 0 ? plugin->pdf_tolerance : 64 * static_cast<double>(std::numeric_limits<S>::epsilon());
  for (double i = 0; i < plugin->hi[0]; ++i) s.atoms.push_back(plugin.pdf(&i));
  const auto one = [p, n = plugin->hi[0]](const Uniforms& u) {
    Subject::Draw d;
    double x = std::numeric_limits<double>::quiet_NaN();
    if (!p.plugin.sample(u.data(), &x)) d.kind = Kind::failed;
    else if (!std::isfinite(x)) d.kind = Kind::not_finite;
    else if (!(x >= 0 && x < n && x == std::floor(x))) d.kind = Kind::outside;
    else d.kind = Kind::atom, d.atom = static_cast<int>(x), d.pdf_positive = p.plugin.pdf(&x) > 0;
    return d;
  };
  const auto describe = [p](const Uniforms& u) {
    double x = std::numeric_limits<double>::quiet_NaN();
    if (!p.plugin.sample(u.data(), &x)) return fmt::format("u = {}: it fails", p.format(u));
    return fmt::format("u = {}, x = {:.17g}, pdf = {:.9g}", p.format(u), x, p.plugin.pdf(&x));
  };
  s.draw = [p, one](std::uint64_t seed, std::size_t n, std::vector<Subject::Draw>& out) {
    mc::Pcg random(seed);
    for (std::size_t i = 0; i < n; ++i) out.push_back(one(p.uniforms(random)));
  };
  s.describe_draw = [p, describe](std::uint64_t seed, std::uint64_t index) {
    return describe(p.uniforms_at(seed, index));
  };
  mc::SubjectOptions o;
  o.samples = options.samples, o.seed = options.seed, o.alpha = options.alpha, o.evidence = options.evidence;
  mc::Report report = check_subject(s, o);
  report.checks.push_back(edge_law(p, describe, [&](const Uniforms& u) {
    const Subject::Draw d = one(u);
    return d.kind == Kind::failed ? plugin->may_fail != 0 : d.kind == Kind::atom && d.pdf_positive;
  }));
  report.ns_per_sample = ns_per_sample(p);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

template <mc::Real S>
mc::Report check_over(const PluginSampler& plugin, const std::string& title, const CaseOptions& options) {
  const auto check = [&](const auto& domain) { return check_on(plugin, domain, title, options); };
  std::array<S, 3> lo, hi;
  const bool unit = std::all_of(plugin->lo, plugin->lo + 3, [](double x) { return x == 0; }) &&
                    std::all_of(plugin->hi, plugin->hi + 3, [](double x) { return x == 0; });
  for (std::size_t i = 0; i < 3; ++i)
    lo[i] = static_cast<S>(plugin->lo[i]), hi[i] = unit ? S(1) : static_cast<S>(plugin->hi[i]);
  switch (plugin->domain) {
  case MC_INTERVAL:
    if (std::isinf(lo[0]) || std::isinf(hi[0])) return check_infinite<S>(plugin, title, options);
    return check(Line<S>{mc::Interval<S>(lo[0], hi[0])});
  case MC_BOX:
    if (plugin->dim == 1) return check(Line<S>{mc::Interval<S>(lo[0], hi[0])});
    if (plugin->dim == 2) return check(Plane<S>{mc::Box<S, 2>({lo[0], lo[1]}, {hi[0], hi[1]})});
    return check(Space<S>{mc::Box<S, 3>({lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]})});
  case MC_DISK: return check(Plane<S>{mc::Disk<S>()});
  case MC_DISCRETE: return check_discrete<S>(plugin, title, options);
  case MC_TRIANGLE: return check(Plane<S>{mc::Triangle<S>()});
  case MC_SPHERE: return check(Directions<S>{mc::Sphere<S>()});
  default: return check(Directions<S>{mc::Hemisphere<S>()});
  }
}

} // namespace

mc::Report check_plugin(const PluginSampler& sampler, const std::string& title, const CaseOptions& options) {
  return sampler->scalar == MC_FLOAT ? check_over<float>(sampler, title, options)
                                     : check_over<double>(sampler, title, options);
}

} // namespace carlo
