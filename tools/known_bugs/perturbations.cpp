// C1 ... and V1 ...: small perturbations of a cosine lobe and of visible GGX normals, which measure a checker's power.
#include <known_bugs/test_cases.h>

#include <mc/warp/hemisphere.h>
#include <mc/warp/trowbridge_reitz.h>

namespace carlo {
namespace {

using V = Direction;
using mc::Fault, mc::Pcg;

V uniform_direction(Pcg& r) { return mc::UniformHemisphere<double>{}.sample(r.point<double, 2>()); }
V rotated(const V& w, double degrees) {
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  return {c * w.x() - s * w.y(), s * w.x() + c * w.y(), w.z()};
}

// A sampler in which a share of the samples comes from another sampler.
SampleDirection replaced(const SampleDirection& sample, double share, const SampleDirection& other) {
  return [=](Pcg& r) { return uniform(r) < share ? other(r) : sample(r); };
}
SampleDirection below(const SampleDirection& sample) {
  return [=](Pcg& r) {
    V w = *sample(r);
    w.z() = -w.z();
    return w;
  };
}
// cos = u^(exponent / 2).
SampleDirection powered(double exponent) {
  return [=](Pcg& r) {
    const double c = std::pow(1 - uniform(r), 0.5 * exponent);
    return direction(c, 2 * pi * uniform(r));
  };
}

mc::TrowbridgeReitzVisibleNormals<double> visible(double ax, double ay, double theta) {
  return {incident(theta), ax, ay};
}
SampleDirection of(const mc::TrowbridgeReitzVisibleNormals<double>& warp) {
  return [warp](Pcg& r) { return warp.sample(r.point<double, 2>()); };
}

// A rotated cosine lobe is still a cosine lobe, so only the inverse reveals the rotation.
TestCase turned_cosine(double degrees) {
  return test_case(InvertibleWarp{
      [degrees](const mc::Vec2<double>& u) { return rotated(mc::CosineHemisphere<double>{}.sample(u), degrees); },
      cosine_pdf, [](const V& w) { return mc::CosineHemisphere<double>{}.invert(w); }});
}

} // namespace

KnownBugs perturbations() {
  KnownBugs s;
  const TestCase right = test_case(on_hemisphere(cosine, cosine_pdf));
  const auto add = [&](const char* id, const char* name, Fault fault, std::uint64_t samples, SampleDirection sample,
                       Density pdf = cosine_pdf) {
    s.push_back({id, name, "cosine hemisphere", name, fault, samples,
                 test_case(on_hemisphere(std::move(sample), std::move(pdf))), right});
  };
  add("C1", "pdf x 1.01", Fault::mass, 1000, cosine, [](const V& w) { return 1.01 * cosine_pdf(w); });
  add("C2", "pdf x 1.003", Fault::mass, 1000, cosine, [](const V& w) { return 1.003 * cosine_pdf(w); });
  add("C3", "1e-3 uniform", Fault::shape, 16'000'000, replaced(cosine, 1e-3, uniform_direction));
  add("C4", "1e-2 uniform", Fault::shape, 1'000'000, replaced(cosine, 1e-2, uniform_direction));
  add("C5", "1e-4 NaN", Fault::not_finite, 100'000, replaced(cosine, 1e-4, [](Pcg&) { return V(std::nan(""), 0, 1); }));
  add("C6", "5e-6 below the horizon", Fault::outside, 2'000'000, replaced(cosine, 5e-6, below(cosine)));
  add("C7", "1e-3 below the horizon", Fault::outside, 20'000, replaced(cosine, 1e-3, below(cosine)));
  add("C8", "1e-2 below the horizon", Fault::outside, 2000, replaced(cosine, 1e-2, below(cosine)));
  add("C9", "direction not unit, x and y x 1.1", Fault::outside, 1000, [](Pcg& r) {
    const V w = cosine(r);
    return V(1.1 * w.x(), 1.1 * w.y(), w.z());
  });
  add("C10", "1e-2 of x < 0 mirrored", Fault::shape, 1'000'000, [](Pcg& r) {
    V w = cosine(r);
    if (w.x() < 0 && uniform(r) < 1e-2) w.x() = -w.x();
    return w;
  });
  s.push_back({"C11", "phi rotated by 0.5 degree", "cosine hemisphere",
               "the same distribution, another map: only the inverse tells", Fault::inverse, 1000, turned_cosine(0.5),
               turned_cosine(0)});
  add("C12", "1e-3 spike at the pole", Fault::local, 60'000, replaced(cosine, 1e-3, [](Pcg&) { return V(0, 0, 1); }));
  add("C13", "exponent 1.005", Fault::shape, 2'000'000, powered(1.005));
  add("C14", "exponent 1.02", Fault::shape, 250'000, powered(1.02));
  add("C15", "u clamped to [1e-3, 1 - 1e-3]", Fault::local, 60'000, [](Pcg& r) {
    const double u = std::clamp(uniform(r), 1e-3, 1 - 1e-3), v = std::clamp(uniform(r), 1e-3, 1 - 1e-3);
    return direction(std::sqrt(1 - u), 2 * pi * v);
  });
  add("C16", "phi = 2 * 3.14 v", Fault::local, 400'000,
      [](Pcg& r) { return direction(std::sqrt(1 - uniform(r)), 6.28 * uniform(r)); });

  const auto lobe = visible(0.3, 0.3, 60);
  const Density pdf = [lobe](const V& m) { return lobe.pdf(m); };
  const TestCase lobe_right = test_case(on_hemisphere(of(lobe), pdf));
  const auto add_visible = [&](const char* id, const char* name, Fault fault, std::uint64_t samples,
                               SampleDirection sample, Density claimed) {
    s.push_back({id, name, "visible GGX normals, alpha 0.3, 60 degrees", name, fault, samples,
                 test_case(on_hemisphere(std::move(sample), std::move(claimed))), lobe_right});
  };
  add_visible("V1", "pdf x 1.01", Fault::mass, 1000, of(lobe), [lobe](const V& m) { return 1.01 * lobe.pdf(m); });
  add_visible("V2", "1e-3 uniform", Fault::zero_pdf, 100'000, replaced(of(lobe), 1e-3, uniform_direction), pdf);
  add_visible("V3", "1e-2 uniform", Fault::zero_pdf, 10'000, replaced(of(lobe), 1e-2, uniform_direction), pdf);
  add_visible("V4", "1e-3 below the horizon", Fault::outside, 20'000, replaced(of(lobe), 1e-3, below(of(lobe))), pdf);
  add_visible(
      "V5", "phi rotated by 0.5 degree", Fault::zero_pdf, 1'000'000,
      [lobe](Pcg& r) { return rotated(lobe.sample(r.point<double, 2>()), 0.5); }, pdf);
  add_visible("V6", "alpha x 1.003", Fault::shape, 4'000'000, of(visible(0.3009, 0.3009, 60)), pdf);
  add_visible("V7", "alpha x 1.01", Fault::shape, 500'000, of(visible(0.303, 0.303, 60)), pdf);
  add_visible("V8", "alpha x 1.03", Fault::shape, 60'000, of(visible(0.309, 0.309, 60)), pdf);
  add_visible("V9", "60.5 instead of 60 degrees", Fault::shape, 1'000'000, of(visible(0.3, 0.3, 60.5)), pdf);
  add_visible("V10", "alpha_y x 1.01", Fault::shape, 1'000'000, of(visible(0.3, 0.303, 60)), pdf);
  return s;
}

KnownBugs book_bugs() {
  KnownBugs s;
  add_shirley(s);
  add_courses(s);
  return s;
}

KnownBugs all_known_bugs() {
  KnownBugs all = book_bugs();
  for (auto family : {renderer_bugs, perturbations}) {
    KnownBugs more = family();
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
  return all;
}

} // namespace carlo
