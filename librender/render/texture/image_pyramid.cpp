#include <render/texture/image_pyramid.h>

namespace render {

namespace {

/// One axis of a smaller image: the texels that one of its texels covers, and the shares of these. Where n is odd, a
/// texel covers two texels and a part of a third.
struct Cover {
  int first = 0;
  std::vector<Float> shares;

  Cover(int i, int n, int smaller) {
    const double scale = double(n) / smaller, lo = i * scale, hi = lo + scale;
    first = static_cast<int>(lo);
    for (int k = first; k < n && k < hi; ++k)
      shares.push_back(Float((std::min(hi, k + 1.0) - std::max(lo, double(k))) / scale));
  }
};

std::vector<Cover> covers(int n, int smaller) {
  std::vector<Cover> all;
  all.reserve(static_cast<std::size_t>(smaller));
  for (int i = 0; i < smaller; ++i) all.emplace_back(i, n, smaller);
  return all;
}

Texels halved(const Texels& image) {
  const int width = std::max(image.width / 2, 1), height = std::max(image.height / 2, 1);
  const std::vector<Cover> columns = covers(image.width, width), rows = covers(image.height, height);
  std::vector<Spectrum> values;
  values.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (const Cover& row : rows)
    for (const Cover& column : columns) {
      Spectrum sum = Spectrum::Zero();
      for (std::size_t j = 0; j < row.shares.size(); ++j)
        for (std::size_t i = 0; i < column.shares.size(); ++i)
          sum += row.shares[j] * column.shares[i] *
                 image.at(column.first + static_cast<int>(i), row.first + static_cast<int>(j));
      values.push_back(sum);
    }
  return {width, height, std::move(values)};
}

} // namespace

ImagePyramid::ImagePyramid(std::shared_ptr<const Texels> finest) {
  levels_.push_back(std::move(finest));
  while (levels_.back()->width > 1 || levels_.back()->height > 1)
    levels_.push_back(std::make_shared<const Texels>(halved(*levels_.back())));
}

} // namespace render
