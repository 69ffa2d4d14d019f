#pragma once
/// The descendants of a process and their memory, from /proc. Source: proc(5)

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <sys/types.h>
#include <unistd.h>

namespace carlo {

struct Process {
  pid_t id, parent;
};

/// All running processes. A process that ends during the call may have the parent -1.
inline std::vector<Process> all_processes() {
  std::vector<Process> all;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (!std::isdigit(static_cast<unsigned char>(name[0]))) continue;
    std::ifstream in(entry.path() / "stat");
    std::string stat;
    std::getline(in, stat, '\0');                 // the name may contain line ends
    const std::size_t name_end = stat.rfind(')'); // and parentheses
    long parent = -1;
    if (name_end != std::string::npos) std::sscanf(stat.c_str() + name_end, ") %*c %ld", &parent);
    all.push_back({static_cast<pid_t>(std::stol(name)), static_cast<pid_t>(parent)});
  }
  return all;
}

/// The children of a process. They include orphans that the process adopted (PR_SET_CHILD_SUBREAPER).
inline std::vector<pid_t> children(pid_t of) {
  std::vector<pid_t> found;
  for (const Process& p : all_processes())
    if (p.parent == of) found.push_back(p.id);
  return found;
}

/// Its children, their children, and so on.
inline std::vector<pid_t> descendants(pid_t of) {
  const std::vector<Process> all = all_processes();
  std::vector<pid_t> found = {of};
  for (std::size_t i = 0; i < found.size(); ++i) {
    const pid_t parent = found[i];
    for (const Process& p : all) // a process id reused during the search could form a cycle
      if (p.parent == parent && std::find(found.begin(), found.end(), p.id) == found.end()) found.push_back(p.id);
  }
  found.erase(found.begin());
  return found;
}

/// Resident memory of the processes [bytes]. Pages that several processes share count for each of them. It costs one
/// small read for each process.
inline double resident_bytes(const std::vector<pid_t>& ids) {
  double pages = 0;
  for (const pid_t id : ids) {
    std::ifstream in("/proc/" + std::to_string(id) + "/statm");
    double size = 0, resident = 0;
    if (in >> size >> resident) pages += resident;
  }
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Proportional memory of the processes [bytes]: each page is divided by the number of processes that share it. The
/// kernel walks over all their pages. A process that does not report this value counts with its resident memory.
inline double proportional_bytes(const std::vector<pid_t>& ids) {
  double bytes = 0;
  for (const pid_t id : ids) {
    std::ifstream in("/proc/" + std::to_string(id) + "/smaps_rollup");
    double kilobytes = -1;
    for (std::string line; std::getline(in, line) && std::sscanf(line.c_str(), "Pss: %lf", &kilobytes) != 1;) {
    }
    bytes += kilobytes >= 0 ? 1024 * kilobytes : resident_bytes({id});
  }
  return bytes;
}

} // namespace carlo
