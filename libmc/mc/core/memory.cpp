#include <mc/core/error.h>
#include <mc/core/memory.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace mc {

namespace {

// Memory of the machine, or of the control group of this process if that is less [bytes].
double machine_memory() {
  double bytes = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (std::FILE* file = std::fopen("/sys/fs/cgroup/memory.max", "r")) {
    double limit = 0;
    if (std::fscanf(file, "%lf", &limit) == 1 && limit > 0) bytes = std::min(bytes, limit); // else "max"
    std::fclose(file);
  }
  return bytes;
}

} // namespace

double allowed_memory() {
  double bytes = HUGE_VAL;
  for (const auto resource : {RLIMIT_DATA, RLIMIT_AS}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      bytes = std::min(bytes, double(limit.rlim_cur));
  }
  return bytes < HUGE_VAL ? bytes : machine_memory() / 2;
}

void require_memory(double bytes, std::string_view what) {
  constexpr double gib = 0x1p30;
  const double allowed = allowed_memory();
  require(bytes <= allowed, "{} need {:.3g} GiB of memory; {:.3g} GiB are allowed (--memory)", what, bytes / gib,
          allowed / gib);
}

void limit_memory(double bytes) {
  rlimit limit{};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = static_cast<rlim_t>(std::min(bytes, double(limit.rlim_max)));
  setrlimit(RLIMIT_DATA, &limit);
}

} // namespace mc
