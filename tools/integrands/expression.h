#pragma once
/// Integrands from the command line.

#include <integrands/unit_cube_integral.h>

#include <string_view>

namespace carlo {

/// Some 60 bytes of a text around a place in it, for a message.
std::string abbreviate(std::string_view text, std::size_t at = 0);

/// What a variable may be called: a letter or _, then letters, digits and _, but no word of expressions.
///   throws : mc::Error "'3x' is no name of a variable: ..."
void require_variable_name(std::string_view name);

/// An expression as a function of the variables' values, in their order; may be called from several threads at once.
/// Knows the functions and operators of muParser, the constants _pi and _e, "a and b", "a or b", not(a),
/// if(condition, yes, no) and floor(a); no assignment.
///   throws : mc::Error for an expression that does not parse, with the position and what to write where that is known
std::function<double(std::span<const double>)> parse_function(const std::string& expression,
                                                              const std::vector<std::string>& variables);

/// The integral of an expression such as "exp(-x*x)*cos(y)" over the box "x=0:1,y=-1:2", whose sides may be
/// infinite, as one over the unit cube; see parse_function and map_to_bounds.
///   truth  : NaN, nothing is known of it
///   throws : mc::Error for an expression that does not parse, with the position; a variable without bounds or with
///            two; bounds that are not numbers with lo < hi
UnitCubeIntegral parse_expression(const std::string& expression, const std::string& box);

} // namespace carlo
