#include <render/film/confidence_interval.h>

#include <mc/core/error.h>
#include <mc/core/types.h>
#include <mc/stats/t_test.h>

#include <algorithm>

namespace render {

Image interval_half_widths(const Image& image, double confidence) {
  mc::require(!image.variance.empty(), "half_widths: the image carries no variance");
  mc::require(confidence > 0 && confidence < 1, "half_widths: confidence {} must lie in (0, 1)", confidence);
  const double q = mc::student_quantile(1 - confidence, 4 + 4 / image.noise_area);
  const double dof = std::max(1.0, double(image.estimates) - 1), q_alone = mc::student_quantile(1 - confidence, dof);
  const double noisier = dof < 2 ? 3 : 2, noisy = image.estimates < 2 ? mc::infinity<double> : noisier;
  Image widths(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      int n = 0;
      for (int j = std::max(y - 1, 0); j < std::min(y + 2, image.height); ++j)
        for (int i = std::max(x - 1, 0); i < std::min(x + 2, image.width); ++i) {
          sum += image.variance[image.index(i, j)].cast<double>();
          ++n;
        }
      const Eigen::Array3d mean = sum / n, alone = image.variance[image.index(x, y)].cast<double>();
      widths.at(x, y) = (alone > noisy * mean).select(q_alone * alone.sqrt(), q * mean.sqrt()).cast<Float>();
    }
  return widths;
}

} // namespace render
