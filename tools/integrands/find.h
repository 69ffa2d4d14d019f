#pragma once
/// Finds integrands by name or by expression.

#include <integrands/unit_cube_integral.h>

namespace carlo {

/// All integrands with a name: textbook, Genz and rate integrals.
std::vector<const UnitCubeIntegral*> named_integrands();

/// The integrand with this name. With bounds "x=0:1,y=-1:2", or if the text is not a name, it is an expression.
///   throws : Error for an unknown name, with the nearest one, and for an invalid expression or invalid bounds.
UnitCubeIntegral find_integrand(const std::string& text, const std::string& bounds);

} // namespace carlo
