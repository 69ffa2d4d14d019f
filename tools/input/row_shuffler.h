#pragma once
/// Assigns the rows of a file to sample streams.

#include <mc/core/error.h>
#include <mc/random/permute.h>

#include <cstdint>
#include <map>

namespace carlo {

/// Deals the rows in a random order given by the seed, each once. A new stream receives the next rows.
class RowShuffler {
 public:
  RowShuffler(std::uint32_t rows, std::uint64_t seed) : rows_(rows), seed_(seed) {}
  std::uint64_t open(std::uint64_t stream, std::size_t n) {
    const auto [it, fresh] = first_.try_emplace(stream, next_);
    if (fresh) next_ += n;
    mc::require(it->second + n <= rows_, "the samples do not suffice");
    return it->second;
  }
  std::uint32_t row(std::uint64_t i) const { return mc::permute(static_cast<std::uint32_t>(i), rows_, seed_); }

 private:
  std::uint32_t rows_;
  std::uint64_t seed_, next_ = 0;
  std::map<std::uint64_t, std::uint64_t> first_;
};

} // namespace carlo
