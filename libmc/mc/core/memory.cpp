#include <mc/core/error.h>
#include <mc/core/memory.h>

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
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

// Memory in use by this process, as each limit counts it [bytes]; 0 where the system does not say.
struct UsedMemory {
  double addresses = 0, resident = 0, data = 0;

  UsedMemory() {
    std::FILE* file = std::fopen("/proc/self/statm", "r");
    if (!file) return;
    double shared = 0, text = 0;
    if (std::fscanf(file, "%lf %lf %lf %lf %*f %lf", &addresses, &resident, &shared, &text, &data) != 5)
      addresses = resident = data = 0;
    std::fclose(file);
    const double page = double(sysconf(_SC_PAGESIZE)), free = free_memory();
    for (double* bytes : {&addresses, &resident, &data}) *bytes = std::max(*bytes * page - free, 0.0);
  }

  // Memory that was freed, and that the next allocations take first [bytes].
  static double free_memory() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
    return double(mallinfo2().fordblks);
#else
    return 0;
#endif
  }
};

struct Limit {
  double allowed, used;
};

// The limit of which least is left.
Limit tightest_limit() {
  const UsedMemory used;
  Limit least{HUGE_VAL, 0};
  for (const auto& [resource, in_use] : {std::pair(RLIMIT_DATA, used.data), std::pair(RLIMIT_AS, used.addresses)}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) continue;
    if (double(limit.rlim_cur) - in_use < least.allowed - least.used) least = {double(limit.rlim_cur), in_use};
  }
  return least.allowed < HUGE_VAL ? least : Limit{machine_memory() / 2, used.resident};
}

} // namespace

double allowed_memory() { return tightest_limit().allowed; }

void require_memory(double bytes, std::string_view what, std::string_view remedy) {
  constexpr double gib = 0x1p30, small = 0x1p24; // too little to be worth a look at the process
  if (bytes < small) return;
  const Limit limit = tightest_limit();
  if (bytes <= limit.allowed - limit.used) return;
  const std::string in_use =
      bytes <= limit.allowed ? fmt::format(" beside the {:.3g} GiB in use", limit.used / gib) : std::string();
  throw MemoryError(fmt::format("{} need {:.3g} GiB of memory{}; {:.3g} GiB are allowed{}{}", what, bytes / gib, in_use,
                                limit.allowed / gib, remedy.empty() ? "" : "; ", remedy));
}

void limit_memory(double bytes) {
  rlimit limit{};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = static_cast<rlim_t>(std::min(bytes, double(limit.rlim_max)));
  setrlimit(RLIMIT_DATA, &limit);
}

} // namespace mc
