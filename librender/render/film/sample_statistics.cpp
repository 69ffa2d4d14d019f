#include <render/film/sample_statistics.h>

#include <cmath>

namespace render {

namespace {

// Squared deviations below this share of the squares count as rounding errors of equal samples.
constexpr double rounding = 1e-12;

// Luminance and channels.
Eigen::Array4d with_luminance(double y, const Eigen::Array3d& channels) {
  return {y, channels[0], channels[1], channels[2]};
}

} // namespace

void SampleStatistics::add(const SampleSums& samples) {
  if (samples.count == 0) return;
  const auto n = double(count), more = double(samples.count), share = more / (n + more);
  const Eigen::Array3d means = channel_means.cast<double>();
  const Eigen::Array4d mean = with_luminance(luminance(means), means),
                       mean_of_more = with_luminance(samples.sum, samples.channel_sums) / more,
                       squares_of_more = with_luminance(samples.squares, samples.channel_squares) / more,
                       variance = with_luminance(deviation, channel_deviations.cast<double>()).square(),
                       deviations_of_more = squares_of_more - mean_of_more.square(),
                       variance_of_more =
                           (deviations_of_more > rounding * squares_of_more).select(deviations_of_more, 0),
                       step = n > 0 ? (mean_of_more - mean).eval() : Eigen::Array4d::Zero();
  const Eigen::Array4f all =
      ((1 - share) * (variance + share * step.square()) + share * variance_of_more).sqrt().cast<float>();
  count += static_cast<std::uint32_t>(samples.count);
  deviation = all[0];
  channel_deviations = all.tail<3>();
  channel_means = (means + share * (mean_of_more.tail<3>() - means)).cast<float>();
  largest = std::max(largest, static_cast<float>(samples.largest));
  channel_largest = channel_largest.max(samples.channel_largest.cast<float>());
  channel_smallest = channel_smallest.min(samples.channel_smallest.cast<float>());
}

Eigen::Array3d SampleStatistics::variance_of_mean() const {
  if (count < 2) return Eigen::Array3d::Constant(mc::infinity<double>);
  return channel_deviations.cast<double>().square() / (double(count) - 1);
}

double SampleStatistics::effective_sample_count(const LightSums& light, double weight) const {
  if (count < 2) return mc::infinity<double>;
  const double mean = luminance(channel_means.cast<double>().eval()), n = double(count), w2 = mc::sqr(weight);
  const double deviations = n * mc::sqr(double(deviation)) + w2 * light.squares;
  const double most = std::max(mc::sqr(double(largest) - mean), w2 * mc::sqr(double(light.largest)));
  return deviations > rounding * (deviations + n * mc::sqr(mean)) ? deviations / most : mc::infinity<double>;
}

Eigen::Array3d SampleStatistics::jump() const {
  if (count < 2) return Eigen::Array3d::Zero();
  const Eigen::Array3d mean = channel_means.cast<double>(), s2 = channel_deviations.cast<double>().square(),
                       up = (channel_largest.cast<double>() - mean).max(0),
                       down = (mean - channel_smallest.cast<double>()).max(0);
  // Infinite where the mean rounds to the largest or smallest sample.
  const Eigen::Array3d two = (1.5 * s2 / (up * down) - 0.5).max(0).min(1);
  const Eigen::Array3d share = (up.max(down).square() > 9 * s2).select(1, two.sqrt());
  return (s2 > rounding * (s2 + mean.square())).select((up + down) * share, 0);
}

} // namespace render
