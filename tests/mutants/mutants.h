#pragma once
// Known-wrong samplers in our own words.

#include <mc/check/make_subject.h>
#include <mc/check/report.h>
#include <mc/domain/disk.h>
#include <mc/domain/hemisphere.h>
#include <mc/domain/interval.h>
#include <mc/domain/sphere.h>
#include <mc/warp/hemisphere.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace mutants {

struct Mutant {
  mc::Subject subject;
  mc::Fault fault;                  // the first law it breaks
  std::uint64_t samples = 1'000'000;
  std::string story;                // what was wrong, one line
};

std::vector<Mutant> books();  // the slips of the books and courses
std::vector<Mutant> peers();  // faults of peers.md section 3b and shipped defects of renderers

inline std::vector<Mutant> all() {
  std::vector<Mutant> m = books();
  for (Mutant& p : peers()) m.push_back(std::move(p));
  return m;
}

// Tests of counts see one fault at several scales: whether it is called shape, local or atom is a matter of degree.
inline bool same_kind(mc::Fault a, mc::Fault b) {
  const auto counted = [](mc::Fault f) { return f == mc::Fault::shape || f == mc::Fault::rotation || f == mc::Fault::local || f == mc::Fault::atom; };
  return a == b || (counted(a) && counted(b));
}

// A test name: letters and digits only.
inline std::string identifier(std::string name) {
  std::replace_if(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

} // namespace mutants
