#pragma once
/// A sentence about each distribution of the catalogue, and the text of `carlo validate --list`.

#include <catalogue/catalogue.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace carlo {

/// One sentence without a full stop; empty for a name that is not in the catalogue.
std::string_view description_of(std::string_view name);

/// A row for each distribution: its name, its description and the number of its cases.
std::string distributions_text(const std::vector<const Case*>& cases, std::size_t columns);

/// For each distribution its name and description, then a row for each case: the name that selects it, and its scalars.
std::string cases_text(const std::vector<const Case*>& cases, std::size_t columns);

} // namespace carlo
