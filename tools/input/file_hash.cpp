#include <input/file_hash.h>

#include <mc/core/file.h>
#include <mc/random/hash.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <vector>

namespace carlo {

std::string hash_of_files(const std::set<std::string>& files) {
  std::vector<std::uint64_t> hashes;
  for (const std::string& file : files) {
    if (!std::filesystem::is_regular_file(file)) return {};
    const std::string bytes = mc::read_file(file);
    std::uint64_t hash = mc::hash(bytes.size());
    for (std::size_t i = 0; i < bytes.size(); i += sizeof hash) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
      hash = mc::hash(hash, word);
    }
    hashes.push_back(hash);
  }
  std::sort(hashes.begin(), hashes.end());
  std::uint64_t hash = hashes.size();
  for (const std::uint64_t h : hashes) hash = mc::hash(hash, h);
  return fmt::format("{:016x}", hash);
}

} // namespace carlo
