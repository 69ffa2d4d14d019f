#include <mc/core/error.h>
#include <mc/estimate/control_variate.h>

#include <Eigen/QR>

#include <cmath>

namespace mc {

ControlVariates::ControlVariates(std::span<const double> means)
    : means_(Eigen::Map<const Eigen::VectorXd>(means.data(), static_cast<Eigen::Index>(means.size()))),
      mean_(Eigen::VectorXd::Zero(means_.size() + 1)),
      scatter_(Eigen::MatrixXd::Zero(means_.size() + 1, means_.size() + 1)) {
  require(!means.empty(), "ControlVariates: no controls; at least one is needed");
  for (std::size_t j = 0; j < means.size(); ++j)
    require(std::isfinite(means[j]), "ControlVariates: means[{}] = {} is not finite", j, means[j]);
}

void ControlVariates::add(double f, std::span<const double> g, std::uint64_t index) {
  MC_ASSERT(static_cast<Eigen::Index>(g.size()) == means_.size());
  Eigen::VectorXd x(mean_.size());
  x[0] = f;
  x.tail(means_.size()) = Eigen::Map<const Eigen::VectorXd>(g.data(), means_.size()) - means_;
  if (!x.allFinite()) [[unlikely]] {
    if (non_finite_++ == 0) witness_ = index;
    return;
  }
  ++count_;
  const Eigen::VectorXd delta = x - mean_;
  mean_ += delta / static_cast<double>(count_);
  scatter_ += delta * (x - mean_).transpose();
}

void ControlVariates::merge(const ControlVariates& other) {
  require(means_.size() == other.means_.size() && means_ == other.means_,
          "ControlVariates: merge of {} and {} controls of different means; they must be the same", means_.size(),
          other.means_.size());
  if (other.non_finite_ > 0 && non_finite_ == 0) witness_ = other.witness_;
  non_finite_ += other.non_finite_;
  if (other.count_ == 0) return;
  const double a = static_cast<double>(count_), b = static_cast<double>(other.count_), n = a + b;
  const Eigen::VectorXd delta = other.mean_ - mean_;
  mean_ += delta * (b / n);
  scatter_ += other.scatter_ + delta * delta.transpose() * (a * b / n);
  count_ += other.count_;
}

void ControlVariates::require_enough() const {
  require(non_finite_ == 0, "ControlVariates: {} of {} values are not finite, the first at index {}", non_finite_,
          non_finite_ + count_, witness_);
  require(count_ >= 2, "ControlVariates: {} values; at least 2 are needed", count_);
}

Eigen::VectorXd ControlVariates::coefficients() const {
  require_enough();
  // In units of the standard deviations, so that the rank does not depend on how the controls are scaled.
  const Eigen::Index k = means_.size();
  const Eigen::VectorXd deviations = scatter_.diagonal().tail(k).cwiseSqrt();
  const Eigen::VectorXd units = (deviations.array() > 0).select(deviations, 1.0).matrix();
  const Eigen::MatrixXd correlations =
      (units.cwiseInverse().asDiagonal() * scatter_.bottomRightCorner(k, k) * units.cwiseInverse().asDiagonal()).eval();
  const Eigen::VectorXd with_f = scatter_.col(0).tail(k).cwiseQuotient(units);
  return correlations.completeOrthogonalDecomposition().solve(with_f).cwiseQuotient(units);
}

Estimate ControlVariates::estimate(const Eigen::VectorXd& beta) const {
  require_enough();
  require(beta.size() == means_.size() && beta.allFinite(),
          "ControlVariates: {} coefficients for {} controls; as many finite ones are needed", beta.size(),
          means_.size());
  Eigen::VectorXd c(mean_.size());
  c << 1, -beta;
  const double n = static_cast<double>(count_);
  const double variance = std::max(0.0, c.dot(scatter_ * c)) / (n - 1);
  return Estimate::student(c.dot(mean_), std::sqrt(variance / n), n - 1, count_);
}

Estimate cross_estimate(const ControlVariates& a, const ControlVariates& b) {
  const Estimate first = a.estimate(b.coefficients()), second = b.estimate(a.coefficients());
  const double n = static_cast<double>(first.count + second.count), share = static_cast<double>(first.count) / n;
  return Estimate::student(share * first.value + (1 - share) * second.value,
                           std::hypot(share * first.error(), (1 - share) * second.error()), first.dof + second.dof,
                           first.count + second.count);
}

} // namespace mc
