#pragma once
/// Pictures that go on where others stopped.

#include <render/film/image.h>

namespace render {

/// A picture of `a` and `b`, independent ones of the same scene, that count by their samples per pixel:
/// m = w m_a + (1 - w) m_b with w = n_a / (n_a + n_b), of variance w^2 v_a + (1 - w)^2 v_b where both know theirs. The
/// noise area is the larger one. The rest is that of b.
///   throws : Error unless both are of one size and the samples are > 0
Image accumulate(const Image& a, double a_samples, const Image& b, double b_samples);

} // namespace render
