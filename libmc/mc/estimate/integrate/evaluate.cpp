#include <mc/core/error.h>
#include <mc/core/sum.h>
#include <mc/estimate/integrate/evaluate.h>
#include <mc/run/job.h>
#include <mc/stats/scale.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

namespace mc::detail {

namespace {
// Points of a chunk, whose sums are merged in order. Their number depends on the evaluation alone, so that sums do not
// depend on the number of threads. Large evaluations have larger chunks, so that the number of sums is bounded.
constexpr std::uint64_t least_chunk = 4096, most_chunks = 1 << 16;
constexpr std::uint64_t most_unit = 1 << 18;    // points of a unit of several chunks
constexpr std::uint64_t block = 256;            // points whose sums are added at once
constexpr std::uint64_t least_shared = 1 << 16; // calls from which an executor computes; fewer are not worth messages
constexpr double thread_start = 5e-4;           // seconds of work above which other threads pay off
constexpr double most_infinite = 1e-3;          // largest volume of infinite values; a larger one is no singularity
constexpr double few_infinite = 8;              // points always allowed to be infinite

// Points of a call with their weights: an average of (f * factor - c * shift + c) * jacobian.
struct WeightedPoints {
  std::vector<double> raw, points, factors, shifts, jacobians, scratch;

  WeightedPoints(const PointSet& set, std::size_t n, std::size_t d, const Proposal& proposal)
      : points(n * d), factors(n, 1.0), scratch(d) {
    if (proposal.density) {
      raw.resize(n * (d + 1));
      shifts.resize(n);
    }
    if (is_warped(set)) jacobians.resize(n);
  }

  void draw(const PointSet& set, std::uint64_t first, std::size_t n, std::size_t d, const Proposal& proposal) {
    const std::span<double> all(points.data(), n * d);
    const std::span<double> of_map(jacobians.data(), std::min(n, jacobians.size()));
    if (!proposal.density) {
      fill_points(set, first, static_cast<int>(d), all, of_map);
      return;
    }
    fill_points(set, first, static_cast<int>(d + 1), {raw.data(), n * (d + 1)}, of_map);
    for (std::size_t i = 0; i < n; ++i) {
      const double selector = raw[i * (d + 1)];
      const std::span<double> x = all.subspan(i * d, d);
      std::copy_n(raw.begin() + static_cast<std::ptrdiff_t>(i * (d + 1) + 1), d, x.begin());
      weigh(i, x, selector < Proposal::uniform_share, *proposal.density);
    }
  }

  void weigh(std::size_t i, std::span<double> x, bool uniform, const AdaptedDensity& p) {
    // 1 / p is finite for mapped points; p may be 0 or infinite at uniform ones.
    const double inverse = uniform ? 1 / p.density(x, scratch) : p.map(x);
    constexpr double share = Proposal::uniform_share;
    if (std::isinf(inverse)) {
      factors[i] = 1 / share;
      shifts[i] = 0;
    } else {
      shifts[i] = 1 / (share * inverse + (1 - share)); // p / q
      factors[i] = inverse * shifts[i];                // 1 / q
    }
  }
};
} // namespace

void Integrand::operator()(std::span<const double> points, std::size_t d, std::span<double> values) const {
  if (batch) return batch->f(points, values);
  const std::size_t n = points.size() / d, outputs = values.size() / n;
  if (one)
    for (std::size_t i = 0; i < n; ++i) values[i] = (*one)(points.subspan(i * d, d));
  else
    for (std::size_t i = 0; i < n; ++i) (*several)(points.subspan(i * d, d), values.subspan(i * outputs, outputs));
}

Sums Evaluator::evaluate_chunk(const PointSet& set, Chunk range, const Proposal& proposal, Keep keep,
                               const std::vector<SampledValues>& empty) const {
  const auto d = static_cast<std::size_t>(dim);
  Sums sums{std::vector<ScaledMoments>(outputs), empty};
  const std::uint64_t call = std::clamp((integrand.max_points() + block - 1) / block * block, block, least_chunk);
  const auto most = static_cast<std::size_t>(std::min(call, range.last - range.first));
  WeightedPoints drawn(set, most, d, proposal);
  std::vector<double> values(outputs * most), columns(block);
  for (std::uint64_t first = range.first; first < range.last; first += call) {
    const auto n = static_cast<std::size_t>(std::min(call, range.last - first));
    drawn.draw(set, first, n, d, proposal);
    const std::span<const double> points(drawn.points.data(), n * d), factors(drawn.factors.data(), n);
    const std::span<double> all(values.data(), n * outputs);
    integrand(points, d, all);
    sums.zero_infinite_values(all, factors, first);
    if (const std::uint64_t done = first - range.first; keep.record && done < range.recorded) {
      const auto m = static_cast<std::size_t>(std::min<std::uint64_t>(n, range.recorded - done));
      const auto at = static_cast<std::ptrdiff_t>(range.place + done);
      std::copy_n(points.begin(), m * d, keep.record->points.begin() + at * dim);
      for (std::size_t i = 0; i < m; ++i) {
        const auto to = (at + static_cast<std::ptrdiff_t>(i)) * static_cast<std::ptrdiff_t>(primary());
        std::copy_n(&all[i * outputs], primary(), keep.record->values.begin() + to);
      }
      std::copy_n(factors.begin(), m, keep.record->weights.begin() + at);
    }
    for (std::size_t begin = 0; begin < n; begin += block) {
      const std::size_t size = std::min<std::size_t>(block, n - begin);
      const std::span<double> column(columns.data(), size);
      if (!drawn.jacobians.empty()) {
        // In the order of Moments: a constant integrand then has a constant mean.
        sums.jacobians += interleaved_sum(size, [&](std::size_t i) { return drawn.jacobians[begin + i]; });
      }
      for (std::size_t k = 0; k < outputs; ++k) {
        for (std::size_t i = 0; i < size; ++i) column[i] = all[(begin + i) * outputs + k];
        if (proposal.density) {
          sums.sampled[k].add_weighted(column, factors.subspan(begin, size));
          for (std::size_t i = 0; i < size; ++i) column[i] *= factors[begin + i];
        } else sums.sampled[k].averaged.add(column);
        if (proposal.density && !proposal.control_coefficients.empty()) {
          const double c = proposal.control_coefficients[k];
          for (std::size_t i = 0; i < size; ++i) column[i] += c * (1 - drawn.shifts[begin + i]);
        }
        if (!drawn.jacobians.empty())
          for (std::size_t i = 0; i < size; ++i) column[i] *= drawn.jacobians[begin + i];
        const double largest = largest_size(column);
        if (keep.batches) sums.add_to_batches(k, column, first + begin, largest);
        sums.outputs[k].add(column, first + begin, largest);
      }
    }
  }
  return sums;
}

/// An evaluation as a Job of one stage. A unit is some chunks of one set, whose sums are merged one by one, so that the
/// number of chunks of a unit has no effect on the bits.
class Evaluator::EvaluateJob {
 public:
  struct Result {
    std::vector<Sums> chunks;
    Record record; ///< The recorded points of the unit.
    template <class Archive> void archive(Archive& a) { a(chunks, record.points, record.values, record.weights); }
  };

  EvaluateJob(const Evaluator& evaluator, const std::vector<PointSet>& sets, std::uint64_t first, std::uint64_t count,
              const Proposal& proposal, Keep keep, const std::vector<SampledValues>& before)
      : evaluator_(evaluator), sets_(sets), first_(first), count_(count), proposal_(proposal), keep_(keep),
        empty_(evaluator.outputs), recorded_(keep.record ? std::min(count, keep.most_recorded / sets.size()) : 0),
        results_(sets.size()) {
    for (std::size_t k = 0; k < before.size(); ++k) empty_[k] = before[k].for_more_values();
    const auto chunks = [&] { return (count + chunk_ - 1) / chunk_ * sets.size(); };
    while (chunks() > most_chunks) chunk_ *= 2;
    points_ =
        chunk_ * std::clamp<std::uint64_t>(chunks() / most_units, 1, std::max<std::uint64_t>(most_unit / chunk_, 1));
    units_ = (count + points_ - 1) / points_;
    if (!keep.record) return;
    keep.record->points.resize(sets.size() * recorded_ * dim());
    keep.record->values.resize(sets.size() * recorded_ * evaluator.primary());
    keep.record->weights.resize(sets.size() * recorded_);
  }

  std::size_t next_stage() { return std::exchange(has_begun_, true) ? 0 : units(); }
  std::size_t units() const { return static_cast<std::size_t>(units_ * sets_.size()); }
  // Keeps a result for the thread that will compute it.
  void keep_first(Result result) { first_result_ = std::move(result); }

  std::optional<Result> compute(std::size_t unit) const {
    if (unit == 0 && first_result_) return std::exchange(first_result_, std::nullopt);
    const std::uint64_t begin = begin_of(unit), end = std::min(begin + points_, count_);
    Result result;
    const std::size_t recorded = recorded_of(unit);
    result.record.points.resize(recorded * dim());
    result.record.values.resize(recorded * evaluator_.primary());
    result.record.weights.resize(recorded);
    const Keep keep{keep_.batches, recorded > 0 ? &result.record : nullptr};
    for (std::uint64_t done = begin; done < end; done += chunk_) {
      if (evaluator_.options.cancel && evaluator_.options.cancel->load()) return {};
      const Chunk range{first_ + done, first_ + std::min(done + chunk_, end), recorded_ - std::min(recorded_, done),
                        done - begin};
      result.chunks.push_back(evaluator_.evaluate_chunk(sets_[unit / units_], range, proposal_, keep, empty_));
    }
    return result;
  }
  void absorb(std::size_t unit, Result result) {
    for (Sums& sums : result.chunks) results_[unit / units_].merge(std::move(sums));
    if (recorded_of(unit) == 0) return;
    const auto at = static_cast<std::ptrdiff_t>(unit / units_ * recorded_ + begin_of(unit));
    const auto width = static_cast<std::ptrdiff_t>(dim()), kept = static_cast<std::ptrdiff_t>(evaluator_.primary());
    std::ranges::copy(result.record.points, keep_.record->points.begin() + at * width);
    std::ranges::copy(result.record.values, keep_.record->values.begin() + at * kept);
    std::ranges::copy(result.record.weights, keep_.record->weights.begin() + at);
  }
  template <class Archive> void archive(Archive& a) {
    a(has_begun_, results_);
    if (keep_.record) a(keep_.record->points, keep_.record->values, keep_.record->weights);
  }
  template <class Archive> void archive_stage(Archive&) {}

  std::vector<Sums> take_results() { return std::move(results_); }

 private:
  static constexpr std::uint64_t most_units = 1024; // of evaluations whose units are small

  std::size_t dim() const { return static_cast<std::size_t>(evaluator_.dim); }
  std::uint64_t begin_of(std::size_t unit) const { return unit % units_ * points_; }
  std::size_t recorded_of(std::size_t unit) const {
    const std::uint64_t begin = begin_of(unit);
    return static_cast<std::size_t>(std::min(points_, recorded_ - std::min(recorded_, begin)));
  }

  const Evaluator& evaluator_;
  const std::vector<PointSet>& sets_;
  std::uint64_t first_, count_;
  const Proposal& proposal_;
  Keep keep_;
  std::vector<SampledValues> empty_;
  std::uint64_t recorded_;               ///< Points of each set.
  std::uint64_t chunk_ = least_chunk;    ///< Points of a chunk.
  std::uint64_t points_ = 0, units_ = 0; ///< Points of a unit, units of a set.
  bool has_begun_ = false;
  mutable std::optional<Result> first_result_;
  std::vector<Sums> results_;
};

std::vector<Sums> Evaluator::evaluate(const std::vector<PointSet>& sets, std::uint64_t first, std::uint64_t count,
                                      const Proposal& proposal, Keep keep, const std::vector<SampledValues>& before) {
  EvaluateJob job(*this, sets, first, count, proposal, keep, before);
  RunOptions run{options.threads, options.cancel, nullptr, {}, "evaluations"};
  if (options.executor && count * sets.size() >= least_shared) run.executor = options.executor;
  else {
    // Other threads start only if they pay off, judged by the time of the first unit.
    const auto begin = std::chrono::steady_clock::now();
    if (std::optional<EvaluateJob::Result> result = job.compute(0)) job.keep_first(std::move(*result));
    const std::chrono::duration<double> once = std::chrono::steady_clock::now() - begin;
    if (once.count() * static_cast<double>(job.units() - 1) <= thread_start) run.threads = 1;
  }
  if (run.executor || run.threads != 1) {
    if (!run_job(job, run)) throw Cancelled{};
  } else {
    for (std::size_t unit = 0, units = job.next_stage(); unit < units; ++unit) {
      std::optional<EvaluateJob::Result> result = job.compute(unit);
      if (!result) throw Cancelled{};
      job.absorb(unit, std::move(*result));
    }
  }
  std::vector<Sums> results = job.take_results();
  calls += count * sets.size();
  // A few points do not determine the volume that they represent.
  const double most = few_infinite + most_infinite * static_cast<double>(count * sets.size());
  for (std::size_t k = 0; k < outputs; ++k) {
    double volume = 0;
    for (std::size_t r = 0; r < sets.size(); ++r) {
      const Moments& m = results[r].outputs[k].moments();
      if (m.non_finite_count() > 0)
        throw_not_finite(m.non_finite_count(), count, m.first_non_finite(), sets[r], proposal);
      if (results[r].infinite.empty()) continue;
      const InfiniteValues& infinite = results[r].infinite[k];
      volume += infinite.volume;
      if (volume > most) throw_not_finite(infinite.count, count, *results[r].first_infinite, sets[r], proposal);
    }
  }
  return results;
}

void Evaluator::throw_not_finite(std::uint64_t bad, std::uint64_t count, std::uint64_t index, const PointSet& set,
                                 const Proposal& proposal) const {
  WeightedPoints drawn(set, 1, static_cast<std::size_t>(dim), proposal);
  drawn.draw(set, index, 1, static_cast<std::size_t>(dim), proposal);
  std::vector<double> u(drawn.points.begin(), drawn.points.begin() + dim);
  std::string point;
  for (const double x : u) point += fmt::format("{}{:.17g}", point.empty() ? "" : ", ", x);
  throw NotFinite(bad, count, std::move(u), fmt::format("u = ({})", point));
}

} // namespace mc::detail
