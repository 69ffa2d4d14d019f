#pragma once
/// Substitution of variables: <default name="spp" value="16"/> and $spp.

#include <render/io/mitsuba/mitsuba.h>
#include <render/io/xml.h>

namespace render::mitsuba {

/// Replaces $names in all attributes below `root` by their values. If several names match, the longest is used. A
/// default is valid from its place on. The first default of a name takes precedence over later ones, and `given` over
/// all of them.
///   throws : Error with file and line for an undefined $name; Error for a given name that the scene does not use.
void substitute_variables(XmlElement& root, const Variables& given = {});

} // namespace render::mitsuba
