#pragma once
/// Version of carlo, for --version and the metadata of its files.

namespace carlo {

extern const char* const version; ///< "0.2.0"
extern const char* const commit;  ///< abbreviated commit, "-dirty" when the tree was changed, "unknown" outside git

} // namespace carlo
