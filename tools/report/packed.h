#pragma once
/// Compressed numbers in the text of a page.

#include <string>
#include <vector>

namespace carlo {

/// Base64 of a zlib stream (RFC 1950). The stream contains `head`, then the numbers as little-endian 32-bit floats: the
/// lowest byte of each number, then the second byte of each, and so on, which compresses better than whole floats.
std::string packed(const std::string& head, const std::vector<float>& numbers);

} // namespace carlo
