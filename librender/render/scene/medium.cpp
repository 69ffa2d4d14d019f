#include <render/scene/medium.h>

#include <mc/random/joined.h>
#include <mc/warp/hyperexponential.h>

namespace render {

HomogeneousMedium::Edge HomogeneousMedium::sample_edge(const Spectrum& beta, const Vec2& u, Float length) const {
  const auto channels = [](const Spectrum& s) { return std::array<double, 3>{s[0], s[1], s[2]}; };
  const mc::Hyperexponential<double, 3> collision(channels(beta), channels(sigma_t_));
  const double t = collision.sample(mc::joined(u));
  const double end = std::min(double(length), double(std::numeric_limits<Float>::max())); // avoids 0 times infinity
  const Eigen::Array3d transmittance = (-sigma_t_.cast<double>() * std::min(t, end)).exp();
  if (t < end) {
    const Eigen::Array3d weight = sigma_s_.cast<double>() * transmittance / collision.pdf(t);
    return {Float(t), weight.cast<Float>()};
  }
  return {{}, (transmittance / collision.tail(end)).cast<Float>()};
}

} // namespace render
