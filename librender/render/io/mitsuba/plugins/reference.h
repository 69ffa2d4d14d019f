#pragma once
/// The reference of the scene format, made of the tables that read it.

#include <string>

namespace render::mitsuba {

/// Every plugin with its parameters, their types, units and defaults, as Markdown.
std::string reference();

} // namespace render::mitsuba
