#include <render/integrator/path.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <array>

namespace render {

namespace {
constexpr std::array<std::string_view, 6> names = {"bsdf", "hemisphere", "light", "mixture", "nee", "mis"};
}

Strategy strategy_from(std::string_view word) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == word) return static_cast<Strategy>(i);
  throw mc::Error(fmt::format("unknown strategy '{}'{}; use one of {}", word, mc::did_you_mean(word, names),
                              fmt::join(names, ", ")));
}

std::string_view name(Strategy strategy) { return names[static_cast<std::size_t>(strategy)]; }

} // namespace render
