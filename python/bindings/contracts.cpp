#include "contracts.h"

#include <stdexcept>

namespace bindings {

namespace {
struct Contract {
  std::string_view name, text;
};
#include "python_contracts.h" // written by docstrings.py
} // namespace

std::string contract(std::string_view name) {
  for (const Contract& c : contracts)
    if (c.name == name) return std::string(c.text);
  throw std::logic_error("no contract of " + std::string(name));
}

} // namespace bindings
