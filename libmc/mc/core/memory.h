#pragma once
/// Limit of the memory that the content of a file may take.

#include <string_view>

namespace mc {

/// Memory that this process may take [bytes]. The limit that limit_memory(), `ulimit -d` or `ulimit -v` set, if there
/// is one; else half of the memory of the machine or of its control group.
double allowed_memory();

/// Throws Error if `bytes` exceed allowed_memory(): "40000x40000 pixels need 18 GiB of memory; 7.8 GiB are allowed
/// (--memory)". Call it before an allocation whose size a file determines.
///   what : the beginning of the message, "40000x40000 pixels"
void require_memory(double bytes, std::string_view what);

/// Sets the limit of this process. Allocations beyond it fail with std::bad_alloc.
void limit_memory(double bytes);

} // namespace mc
