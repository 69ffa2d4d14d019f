#pragma once
/// Options of expressions that several subcommands share.

#include <integrands/expression_integral.h>
#include <options/subcommand.h>

namespace carlo {

/// The option --domain.
Option domain_option(ExpressionContext& context);

/// Options for regions, parameters and named parts of expressions.
OptionGroup expression_group(ExpressionContext& context);

} // namespace carlo
