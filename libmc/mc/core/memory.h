#pragma once
/// Limit of the memory of this process, for work whose size a file or an option determines.

#include <string_view>

namespace mc {

/// Memory that this process may take [bytes]. The limit that limit_memory(), `ulimit -d` or `ulimit -v` set, if there
/// is one; else half of the memory of the machine or of its control group.
double allowed_memory();

/// Throws MemoryError if `bytes` and the memory in use exceed allowed_memory(): "40000x40000 pixels need 18 GiB of
/// memory; 7.8 GiB are allowed; --crop renders a part". Call it before the allocation.
///   what   : the beginning of the message, "40000x40000 pixels"
///   remedy : what the caller of this function can offer; empty: nothing
void require_memory(double bytes, std::string_view what, std::string_view remedy = {});

/// Sets the limit of this process. Allocations beyond it fail with std::bad_alloc.
void limit_memory(double bytes);

} // namespace mc
