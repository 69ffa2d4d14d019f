// A libFuzzer target for the reader of one format, FUZZ_FORMAT. Any input is read, or rejected with a one-line
// mc::Error. Anything else is a finding: a crash, another exception, or memory use out of proportion to the input.

#include "fuzz/readers.h"

#include <mc/core/error.h>

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace {

void read_by(std::string_view format, const std::string& path) {
  const auto reader = std::find_if(fuzz::readers.begin(), fuzz::readers.end(),
                                   [&](const fuzz::Reader& r) { return r.format == format; });
  try {
    reader->read(path);
  } catch (const mc::Error& e) {
    if (std::strchr(e.what(), '\n')) std::abort();
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = memfd_create("input", 0); // readers take paths; this file is in memory
  if (file < 0 || write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
  read_by(FUZZ_FORMAT, "/proc/self/fd/" + std::to_string(file));
  close(file);
  return 0;
}
