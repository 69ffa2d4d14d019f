#pragma once
/// Contracts of the C++ headers as docstrings.

#include <string>
#include <string_view>

namespace bindings {

/// The contract of a class or function of libmc, from its header. Throws std::logic_error for a name without one.
std::string contract(std::string_view name);

} // namespace bindings
