#pragma once
/// The reference of the scene format, generated from the tables of the reader.

#include <string>

namespace render::mitsuba {

/// All plugins with their parameters, types, units and defaults, as Markdown.
std::string reference();

} // namespace render::mitsuba
