#pragma once
// Options for runs of integrate() that use up their calls.

#include <mc/estimate/integrate.h>

namespace support {

inline mc::IntegrateOptions with(mc::Method method, std::uint64_t calls, std::uint64_t seed = 1) {
  mc::IntegrateOptions o;
  o.method = method;
  o.max_calls = calls;
  o.rel_error = 0;
  o.seed = seed;
  return o;
}

inline constexpr mc::Method all_methods[] = {mc::Method::plain, mc::Method::stratified, mc::Method::rqmc,
                                             mc::Method::vegas, mc::Method::tree,       mc::Method::automatic};

} // namespace support
