#pragma once
/// Integrands from the command line.

#include <integrands/unit_cube_integral.h>

#include <string_view>

namespace carlo {

/// About 60 bytes of a text around a position in it, for messages.
std::string abbreviate(std::string_view text, std::size_t at = 0);

/// Accepts a variable name: a letter or _, then letters, digits and _, and not a word that expressions reserve.
///   throws : mc::Error "'3x' is no name of a variable: ...".
void require_variable_name(std::string_view name);

/// An expression as a function of the variables' values, in order. It can be called from several threads at once. It
/// supports the functions and operators of muParser, the constants _pi and _e, "a and b", "a or b", not(a),
/// if(condition, yes, no) and floor(a); assignments are errors.
///   throws : mc::Error for an expression that does not parse, with the position and, if possible, the correct form.
std::function<double(std::span<const double>)> parse_function(const std::string& expression,
                                                              const std::vector<std::string>& variables);

/// The integral of an expression such as "exp(-x*x)*cos(y)" over the box "x=0:1,y=-1:2", as an integral over the unit
/// cube. Bounds may be infinite. See parse_function and map_to_bounds.
///   truth  : NaN, since it is unknown.
///   throws : mc::Error for an expression that does not parse, with the position; for a variable without bounds or with
///            two; for bounds that are not numbers with lo < hi.
UnitCubeIntegral parse_expression(const std::string& expression, const std::string& box);

} // namespace carlo
