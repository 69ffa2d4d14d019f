#pragma once
/// Images at decreasing sizes, to average over large footprints.

#include <render/texture/texels.h>

#include <memory>
#include <vector>

namespace render {

/// An image, and smaller ones of half the width and half the height each, down to one texel. A texel of a smaller image
/// is the mean over its area, so all images have the same mean.
///   Source : [Williams83].
class ImagePyramid {
 public:
  /// The pyramid of an image.
  explicit ImagePyramid(std::shared_ptr<const Texels> finest);

  /// Number of images.
  std::size_t size() const { return levels_.size(); }
  /// Image number i; 0 is the largest.
  const Texels& level(std::size_t i) const { return *levels_[i]; }

 private:
  std::vector<std::shared_ptr<const Texels>> levels_;
};

} // namespace render
