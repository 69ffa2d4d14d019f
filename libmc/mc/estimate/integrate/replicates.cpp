#include <mc/estimate/integrate/corrections/pooled_variance.h>
#include <mc/estimate/integrate/replicates.h>

#include <algorithm>
#include <limits>

namespace mc::detail {

void Replicates::absorb(std::vector<Sums>&& more, std::size_t first) {
  sampled_.resize(run_->evaluator.outputs);
  infinite_.resize(run_->evaluator.outputs);
  sums_.resize(std::max(sums_.size(), first + more.size()));
  for (std::size_t r = 0; r < more.size(); ++r) {
    for (std::size_t k = 0; k < sampled_.size(); ++k) sampled_[k].merge(more[r].sampled[k]);
    for (std::size_t k = 0; k < more[r].infinite.size(); ++k) infinite_[k] += more[r].infinite[k].count;
    Sums only_moments{std::move(more[r].outputs), std::vector<SampledValues>(sampled_.size()), more[r].jacobians};
    sums_[first + r].merge(std::move(only_moments));
  }
}

const Means& Replicates::extend(std::uint64_t length, bool record) {
  if (!record) record_ = {};
  absorb(run_->evaluator.evaluate(run_->sobol_sets(stream_, round_, 0, count_), length_, length - length_, proposal_,
                                  {.record = record ? &record_ : nullptr}, sampled_),
         0);
  length_ = length;
  measure();
  return means_;
}

const Means& Replicates::add(std::uint32_t more) {
  record_ = {};
  absorb(run_->evaluator.evaluate(run_->sobol_sets(stream_, round_, count_, count_ + more), 0, length_, proposal_, {},
                                  sampled_),
         count_);
  count_ += more;
  for (SpreadHistory& h : histories_) { // the present length is measured again
    h.points.pop_back();
    h.spreads.pop_back();
    h.shapes.pop_back();
    for (std::vector<double>& c : h.contributions) c.pop_back();
  }
  measure();
  return means_;
}

void Replicates::keep_first(std::uint32_t count) {
  count_ = count;
  sums_.resize(count);
}

std::vector<std::vector<double>> Replicates::replicate_means() const {
  std::vector<std::vector<double>> means(run_->evaluator.outputs);
  for (std::size_t k = 0; k < means.size(); ++k)
    for (const Sums& s : sums_) means[k].push_back(s.mean(k));
  return means;
}

void Replicates::measure() {
  histories_.resize(run_->evaluator.outputs);
  means_.clear();
  const std::vector<std::vector<double>> values = replicate_means();
  for (std::size_t k = 0; k < values.size(); ++k) {
    means_.push_back(mean_of_replicates(values[k], static_cast<double>(length_), sampled_[k], run_->evaluator.dim,
                                        histories_[k], run_->tuning));
    if (infinite_[k] > 0 && means_.back().bar != ErrorBar::not_integrable)
      means_.back().bar = ErrorBar::infinite_variance;
  }
}

double Replicates::rate() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < run_->primary(); ++k)
    least = std::min(
        least, convergence_rate(histories_[k].points, histories_[k].spreads, run_->tuning).value_or(unknown_rate));
  return least;
}

Outcome Replicates::outcome(Method method) const {
  return {.means = means_,
          .method = method,
          .correlations = correlations(replicate_means()),
          .infinite = infinite_,
          .density = proposal_.density};
}

} // namespace mc::detail
