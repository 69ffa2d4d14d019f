#pragma once
/// Command line arguments of rendering benchmarks: SCENE.xml... [-- NUMBER...].

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace bench {

struct Arguments {
  std::vector<std::string> scenes;
  std::vector<int> numbers;

  Arguments(int argc, char** argv) {
    int i = 1;
    for (; i < argc && std::strcmp(argv[i], "--") != 0; ++i) scenes.emplace_back(argv[i]);
    for (++i; i < argc; ++i) numbers.push_back(std::atoi(argv[i]));
  }
  int number(std::size_t place, int fallback) const { return place < numbers.size() ? numbers[place] : fallback; }
};

} // namespace bench
