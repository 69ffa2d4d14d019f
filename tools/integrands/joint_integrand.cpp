#include <integrands/joint_integrand.h>

#include <mc/core/error.h>

namespace carlo {

namespace {

void require_same_dimension(const UnitCubeIntegral& a, const UnitCubeIntegral& b) {
  mc::require(a.dim == b.dim, "'{}' has {} dimensions, '{}' {}; they must be the same", a.name, a.dim, b.name, b.dim);
}

} // namespace

JointIntegrand joined(std::vector<JointIntegrand> parts) {
  if (parts.size() == 1) return std::move(parts.front());
  JointIntegrand all;
  for (const JointIntegrand& part : parts)
    for (const UnitCubeIntegral& one : part.outputs) {
      require_same_dimension(one, parts.front().outputs.front());
      all.outputs.push_back(one);
    }
  all.f = [parts = std::move(parts), outputs = all.outputs.size()](UnitCubeIntegral::UnitPoint points,
                                                                   std::span<double> values) {
    const std::size_t count = values.size() / outputs;
    std::vector<double> some;
    std::size_t first = 0;
    for (const JointIntegrand& part : parts) {
      const std::size_t own = part.outputs.size();
      some.resize(count * own);
      part.f(points, some);
      for (std::size_t i = 0; i < some.size(); ++i) values[i / own * outputs + first + i % own] = some[i];
      first += own;
    }
  };
  return all;
}

JointIntegrand joined(std::vector<UnitCubeIntegral> integrals) {
  for (const UnitCubeIntegral& one : integrals) require_same_dimension(one, integrals.front());
  JointIntegrand all{integrals, {}};
  all.f = [integrals = std::move(integrals)](UnitCubeIntegral::UnitPoint points, std::span<double> values) {
    const std::size_t outputs = integrals.size(), dim = static_cast<std::size_t>(integrals.front().dim);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = integrals[i % outputs].f(points.subspan(i / outputs * dim, dim));
  };
  return all;
}

void bind_outputs(JointIntegrand& integrand) {
  const std::size_t outputs = integrand.outputs.size();
  for (std::size_t k = 0; k < outputs; ++k) {
    UnitCubeIntegral& one = integrand.outputs[k];
    one.f_batch = [f = integrand.f, outputs, k](UnitCubeIntegral::UnitPoint points, std::span<double> values) {
      if (outputs == 1) return f(points, values);
      std::vector<double> all(values.size() * outputs);
      f(points, all);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = all[i * outputs + k];
    };
    one.f = [f = one.f_batch](UnitCubeIntegral::UnitPoint u) {
      double value = 0;
      f(u, std::span(&value, 1));
      return value;
    };
  }
}

} // namespace carlo
