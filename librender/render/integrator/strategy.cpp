#include <render/integrator/strategy.h>

#include <mc/core/text.h>

#include <algorithm>

namespace render {

const Strategy& strategy_from(std::string_view word) {
  std::array<std::string_view, strategies.size()> names;
  std::transform(strategies.begin(), strategies.end(), names.begin(), [](const Strategy& s) { return s.name; });
  return strategies[mc::index_of("strategy", word, names)];
}

} // namespace render
