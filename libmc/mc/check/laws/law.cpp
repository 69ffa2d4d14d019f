#include <mc/check/laws/law.h>

namespace mc {

AnyDistribution::Uniforms rounded_uniforms(const AnyDistribution& s, Pcg& random) {
  AnyDistribution::Uniforms u{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.uniforms); ++i) {
    const double wide = random.uniform<double>();
    u[i] = s.is_float ? std::min(static_cast<double>(static_cast<float>(wide)), s.max_u()) : wide;
    if (s.open_interval && u[i] == 0) u[i] = s.epsilon() / 2;
  }
  return u;
}

OracleDistribution::Point oracle_uniforms(const AnyDistribution& s, Pcg& random) {
  OracleDistribution::Point u;
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.uniforms); ++i) u[i] = random.uniform<double>();
  return u;
}

} // namespace mc
