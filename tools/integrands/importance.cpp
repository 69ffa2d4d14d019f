#include <integrands/importance.h>

#include <algorithm>

namespace carlo {

JointIntegrand importance_sampled(JointIntegrand f, const ImportanceDensity& density) {
  const std::size_t dim = static_cast<std::size_t>(f.dim()), outputs = f.outputs.size();
  JointIntegrand all{f.outputs, {}};
  for (UnitCubeIntegral& e : all.outputs) {
    e.dim = density.uniforms;
    e.smoothness = {};
    e.bounds = {}; // u is no point of them
    e.underflows_at = {};
    if (e.describe_point)
      e.describe_point = [describe = e.describe_point, density, dim](UnitCubeIntegral::UnitPoint u) {
        std::vector<double> v(dim);
        double one = 0;
        density.draw(u, v, std::span(&one, 1));
        return describe(v);
      };
  }
  all.f = [f = std::move(f.f), density, dim, outputs](UnitCubeIntegral::UnitPoint points, std::span<double> values) {
    const std::size_t count = values.size() / outputs;
    std::vector<double> v(count * dim), densities(count);
    density.draw(points, v, densities);
    // Only samples with a density are evaluated: others need not be points of the domain.
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i)
      if (densities[i] > 0) {
        const auto from = v.begin() + static_cast<std::ptrdiff_t>(i * dim);
        std::copy(from, from + static_cast<std::ptrdiff_t>(dim), v.begin() + static_cast<std::ptrdiff_t>(kept++ * dim));
      }
    std::vector<double> some(kept * outputs);
    if (kept > 0) f(std::span(v).first(kept * dim), some);
    for (std::size_t i = 0, at = 0; i < count; ++i)
      for (std::size_t k = 0; k < outputs; ++k)
        values[i * outputs + k] = densities[i] > 0 ? some[at++] / densities[i] : 0;
  };
  bind_outputs(all);
  return all;
}

} // namespace carlo
