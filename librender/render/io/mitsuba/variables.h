#pragma once
/// <default name="spp" value="16"/> and $spp.

#include <render/io/mitsuba/mitsuba.h>
#include <render/io/xml.h>

namespace render::mitsuba {

/// Puts the values of the defaults into every attribute below `root` that names them, as a whole or in part; the
/// longest name that fits is taken. A default counts from where it stands on; of two with one name the first counts,
/// and before all of them what is `given`.
///   throws : Error with file and line for $ with a name that no default above has; Error for a given name that the
///            scene does not use
void substitute_variables(XmlElement& root, const Variables& given = {});

} // namespace render::mitsuba
