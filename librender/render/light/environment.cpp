#include <render/light/environment.h>

#include <cmath>

namespace render {

namespace {

// Mean luminance over each texel of the bilinear image. Along both axes it weighs the texel by 6/8 and its neighbours
// by 1/8. So every texel with a direction that is not black has a positive probability.
std::vector<double> texel_means(const Texels& t) {
  const auto w = static_cast<std::size_t>(t.width), h = static_cast<std::size_t>(t.height);
  std::vector<double> rows(w * h), means(w * h);
  const auto y_of = [&](std::size_t x, std::size_t y) { return double(luminance(t.values[y * w + x])); };
  for (std::size_t y = 0; y < h; ++y)
    for (std::size_t x = 0; x < w; ++x)
      rows[y * w + x] = (y_of((x + w - 1) % w, y) + 6 * y_of(x, y) + y_of((x + 1) % w, y)) / 8;
  for (std::size_t y = 0; y < h; ++y)
    for (std::size_t x = 0; x < w; ++x)
      means[y * w + x] =
          (rows[(y > 0 ? y - 1 : y) * w + x] + 6 * rows[y * w + x] + rows[(y + 1 < h ? y + 1 : y) * w + x]) / 8;
  return means;
}

} // namespace

Environment::Environment(std::shared_ptr<const Texels> texels, const Transform& to_world, double scale)
    : texels_(std::move(texels)), to_local_(to_world.linear.transpose().cast<Float>()), scale_(Float(scale)) {
  const Texels& t = *texels_;
  mc::require(scale > 0 && std::isfinite(scale), "environment: scale {} must be finite and > 0", scale);
  mc::require((to_world.linear.transpose() * to_world.linear - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <=
                  1e-3,
              "environment: toWorld must be a rotation");
  t.require_all("environment", "must be finite and >= 0",
                [](const Spectrum& s) { return (s >= 0).all() && s.isFinite().all(); });
  const std::vector<double> means = texel_means(t);
  const auto w = static_cast<std::size_t>(t.width), h = static_cast<std::size_t>(t.height);
  for (std::size_t i = 0; i < means.size(); ++i) {
    const std::size_t row = i / w;
    const double band = mc::pi<double> / double(h), above = std::cos(double(row) * band),
                 below = std::cos(double(row + 1) * band);
    flux_ += scale * means[i] * (above - below) * 2 * mc::pi<double> / double(w);
  }
  mc::require(flux_ > 0, "environment: every texel{} is black; leave the emitter out", t.origin);
  table_ = std::make_shared<const mc::TableDist2D<Float>>(mc::TableDist2D<Float>::from_lat_long(means, w, h));
}

Vec2 Environment::place(const Vec3& wi) const {
  const Vec3 d = to_local_ * wi;
  const Float turn = std::atan2(d.x(), -d.z()) / (2 * mc::pi<Float>);
  // The polar angle by atan2: acos would lose half the digits near the pole.
  const Float v = std::atan2(std::hypot(d.x(), d.z()), d.y()) / mc::pi<Float>;
  return {std::min(turn - std::floor(turn), mc::one_minus_epsilon<Float>),
          std::clamp(v, Float(0), mc::one_minus_epsilon<Float>)};
}

Spectrum Environment::radiance(const Vec2& uv) const {
  const int w = texels_->width, h = texels_->height;
  const Float x = uv[0] * Float(w) - Float(0.5), y = std::clamp(uv[1] * Float(h) - Float(0.5), Float(0), Float(h - 1));
  const Float x0 = std::floor(x), y0 = std::floor(y), fx = x - x0, fy = y - y0;
  const int left = static_cast<int>(x0) < 0 ? w - 1 : static_cast<int>(x0), right = left + 1 == w ? 0 : left + 1;
  const int upper = static_cast<int>(y0), lower = std::min(upper + 1, h - 1);
  const auto texel = [&](int i, int j) -> const Spectrum& {
    return texels_->values[static_cast<std::size_t>(j) * static_cast<std::size_t>(w) + static_cast<std::size_t>(i)];
  };
  return scale_ * ((1 - fy) * ((1 - fx) * texel(left, upper) + fx * texel(right, upper)) +
                   fy * ((1 - fx) * texel(left, lower) + fx * texel(right, lower)));
}

Float Environment::density(const Vec2& uv) const {
  const Float sin_theta = std::sin(mc::pi<Float> * uv[1]);
  return sin_theta > 0 ? table_->pdf(uv) / (2 * mc::sqr(mc::pi<Float>) * sin_theta) : Float(0);
}

std::optional<LightSample> Environment::sample(const Vec3&, const Vec2& u) const {
  const Vec2 uv = table_->sample(u);
  const Float theta = mc::pi<Float> * uv[1], phi = 2 * mc::pi<Float> * uv[0], s = std::sin(theta);
  const Vec3 d(s * std::sin(phi), std::cos(theta), -s * std::cos(phi));
  const Float density_here = density(uv);
  if (!(density_here > 0)) return {};
  return LightSample{(to_local_.transpose() * d).normalized(), radiance(uv), density_here, {}};
}

} // namespace render
