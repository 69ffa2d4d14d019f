#include <render/integrator/strategy.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

namespace render {

const Strategy& strategy_from(std::string_view word) {
  std::array<std::string_view, strategies.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (strategies[i].name == word) return strategies[i];
    names[i] = strategies[i].name;
  }
  throw mc::Error(fmt::format("unknown strategy '{}'{}; use one of {}", word, mc::did_you_mean(word, names),
                              fmt::join(names, ", ")));
}

} // namespace render
