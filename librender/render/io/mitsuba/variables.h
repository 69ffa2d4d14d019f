#pragma once
/// <default name="spp" value="16"/> and $spp.

#include <render/io/xml.h>

namespace render::mitsuba {

/// Puts the values of the defaults into every attribute below `root` that names them, as a whole or in part; the
/// longest name that fits is taken. A default counts from where it stands on; of two with one name the first counts.
///   throws : Error with file and line for $ with a name that no default above has
void substitute_variables(XmlElement& root);

} // namespace render::mitsuba
