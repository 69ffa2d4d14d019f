#pragma once
/// Integrands by what the user types.

#include <integrands/unit_cube_integral.h>

namespace carlo {

/// Those with a name: of the books, Genz's, and those of the rates.
std::vector<const UnitCubeIntegral*> named_integrands();

/// The one of that name, or, with bounds "x=0:1,y=-1:2" or where the text is no name, an expression.
///   throws : Error naming the nearest for an unknown name, and for an expression or bounds that mean nothing
UnitCubeIntegral find_integrand(const std::string& text, const std::string& bounds);

} // namespace carlo
