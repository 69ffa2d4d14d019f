#pragma once
/// Text in the columns of a terminal.

#include <cstddef>
#include <string>
#include <string_view>

namespace carlo {

/// Columns of the terminal behind a descriptor: the variable COLUMNS where it is a number of at least 20, else the
/// terminal's own answer, else 80.
std::size_t terminal_columns(int descriptor);

/// Columns that UTF-8 text takes, one for each character.
std::size_t columns_of(std::string_view text);

/// Text broken between words, so that no line exceeds `columns` unless a single word does. Every line begins with
/// `indent` blanks and ends with a line feed. The first line omits the first `used` of these blanks, for text that
/// already precedes it. "\n" in the text begins a new line.
std::string wrapped(std::string_view text, std::size_t columns, std::size_t indent = 0, std::size_t used = 0);

/// A row of a list of terms: the term at column `indent`, the text at column `hang`. The text begins on a line of its
/// own where the term is too long.
std::string term_row(std::string_view term, std::string_view text, std::size_t columns, std::size_t indent,
                     std::size_t hang);

} // namespace carlo
