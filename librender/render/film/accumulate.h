#pragma once
/// Averages of independent renders of a scene.

#include <render/film/image.h>

namespace render {

/// Average of two independent images of the same scene, weighted by their samples per pixel.
///   mean     : w m_a + (1 - w) m_b with w = n_a / (n_a + n_b).
///   variance : w^2 v_a + (1 - w)^2 v_b if both images carry a variance; else none.
///   noise area : the larger of the two.
///   layers, metadata : copied from b.
///   throws   : Error unless both images have the same size and both sample counts are > 0.
Image accumulate(const Image& a, double a_samples, const Image& b, double b_samples);

} // namespace render
