#include <render/integrator/strategy.h>

#include <mc/core/text.h>

#include <algorithm>

namespace render {

std::array<std::string_view, strategies.size()> strategy_names() {
  std::array<std::string_view, strategies.size()> names;
  std::transform(strategies.begin(), strategies.end(), names.begin(), [](const Strategy& s) { return s.name; });
  return names;
}

const Strategy& strategy_from(std::string_view word) {
  const std::string_view name = word == "bidirectional" ? "mis+lt" : word;
  return strategies[mc::index_of("strategy", name, strategy_names())];
}

} // namespace render
