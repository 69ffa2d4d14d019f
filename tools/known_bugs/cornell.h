#pragma once
/// The Cornell box of the books, rendered with the samplers that their chapters print and with correct ones.

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace carlo {

/// The mean radiance of the picture, over all pixels and channels, for one way of sampling directions at a wall.
struct CornellBox {
  std::string name, source, description;
  bool claimed_right = false;
  double mean = 0, std_error = 0;
  double off = 0, off_error = 0; ///< mean / reference - 1 and its standard error
  double p = 1;                  ///< two-sided p-value of equality with the reference
};

/// Renders all boxes. The first is the reference: cosine and light directions in a correct mixture. The reference and
/// the last box, the wrong one that differs least from it, get four times as many paths.
///   scene  : 555 units wide, two white boxes, a ceiling light of radiance 15, camera and colours of the books; 50
///            bounces.
///   result : bitwise equal for any number of threads. Empty where `cancel` became true before the end.
///   Source : [Shirley16].
std::vector<CornellBox> cornell_boxes(std::uint64_t paths, std::uint64_t seed, int threads,
                                      const std::atomic<bool>* cancel = nullptr);

} // namespace carlo
