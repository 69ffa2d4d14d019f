#include <mc/points/star_cover.h>

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace mc {

namespace {

// A point inside some boxes of a part and outside others, and the number of axes along which it enters.
struct OpenPoint {
  std::uint32_t point, axes;
};

constexpr std::size_t block = 16;
using Block = Eigen::Array<double, block, 1>;

// `never` is below any volume, also after multiplication by an edge; `tiny` is a lower bound of the edges.
constexpr double never = -1e300, tiny = 1e-290;

// Volume for each number of points, padded on both sides by a block of `never`.
struct Volumes {
  std::vector<double> padded;
  std::size_t size = 0;

  double* at(std::size_t s) { return padded.data() + block + s; }
  void resize(std::size_t s) {
    size = s;
    padded.assign(size + 2 * block, never);
  }
};

// A part is a range lo[k] <= g[k] < hi[k] of ranks. Its boxes contain the points with rank at most g[k] along each axis
// k. The closed box of g ends at coordinate g[k], the open box at the next coordinate.
class CoverSearch {
 public:
  CoverSearch(const StarGrid& grid, StarCover& cover)
      : grid_(grid), cover_(cover), n_(static_cast<double>(grid.size())), lo_(grid.dim(), 0u), slabs_(grid.dim()) {
    for (std::size_t k = 0; k < grid.dim(); ++k) hi_.push_back(static_cast<std::uint32_t>(grid.axis(k).size() - 1));
    tally_.resize(grid.dim());
    fewest_first_.resize(grid.dim());
  }

  bool run() {
    std::size_t inside = 0;
    for (std::uint32_t i = 0; i < grid_.size(); ++i) {
      std::uint32_t axes = 0;
      for (std::size_t k = 0; k < grid_.dim(); ++k) axes += grid_.ranks(i)[k] > 0;
      if (axes > 0) open_.push_back({i, axes});
      else ++inside;
    }
    return part(0, inside);
  }

 private:
  // Searches the part between lo and hi. Its open points are the entries of open_ from `first` on; this function
  // removes them.
  bool part(std::size_t first, std::size_t inside) {
    const std::size_t open = open_.size() - first;
    double small = 1, large = 1;
    for (std::size_t k = 0; k < lo_.size(); ++k) {
      small *= grid_.axis(k)[lo_[k]];
      large *= grid_.axis(k)[hi_[k]];
    }
    const double fewest = static_cast<double>(inside) / n_, most = static_cast<double>(inside + open) / n_;
    const double skip = std::max(cover_.bound, cover_.lower);
    const bool may_lack = large - fewest > skip, may_exceed = most - small > skip;
    bool enough = true;
    if (may_lack || may_exceed) {
      const std::size_t steps = 2 * open + 16;
      if (cover_.work < steps) return false;
      cover_.work -= steps;
      const std::size_t axis = tangled_axis(first);
      if (axis < lo_.size()) enough = halve(axis, first, inside);
      else solve(first, inside, may_lack, may_exceed);
    }
    open_.resize(first);
    return enough;
  }

  // Axis to halve, or the number of axes if no point enters along two or more axes. Prefers an axis along which many
  // such points enter and the volume varies most, which keeps parts about equally long along all axes.
  std::size_t tangled_axis(std::size_t first) {
    std::fill(tally_.begin(), tally_.end(), 0u);
    for (std::size_t i = first; i < open_.size(); ++i) {
      if (open_[i].axes < 2) continue;
      const std::uint32_t* rank = grid_.ranks(open_[i].point);
      for (std::size_t k = 0; k < lo_.size(); ++k) tally_[k] += rank[k] > lo_[k]; // and below hi, because it is open
    }
    std::size_t found = lo_.size();
    double most = 0;
    for (std::size_t k = 0; k < lo_.size(); ++k) {
      const double a = grid_.axis(k)[lo_[k]], b = grid_.axis(k)[hi_[k]], points = tally_[k] * (b - a) / b;
      if (points <= most) continue;
      most = points;
      found = k;
    }
    return found;
  }

  // Halves at the median rank of the points that also enter along other axes. These points then no longer enter along
  // this axis in one half.
  bool halve(std::size_t axis, std::size_t first, std::size_t inside) {
    middle_.resize(open_.size() - first);
    std::size_t tangled = 0;
    for (std::size_t i = first; i < open_.size(); ++i) {
      middle_[tangled] = grid_.ranks(open_[i].point)[axis];
      tangled += open_[i].axes > 1 && middle_[tangled] > lo_[axis];
    }
    middle_.resize(tangled);
    const auto middle = middle_.begin() + static_cast<std::ptrdiff_t>(middle_.size() / 2);
    std::nth_element(middle_.begin(), middle, middle_.end());
    const std::uint32_t cut = *middle, lo = lo_[axis], hi = hi_[axis];
    const std::size_t last = open_.size();
    open_.resize(2 * last - first);
    std::size_t kept = last;
    for (std::size_t i = first; i < last; ++i) {
      open_[kept] = open_[i];
      kept += grid_.ranks(open_[i].point)[axis] < cut;
    }
    open_.resize(kept);
    hi_[axis] = cut;
    if (!part(last, inside)) return false;
    hi_[axis] = hi;
    lo_[axis] = cut;
    open_.resize(2 * last - first);
    kept = last;
    for (std::size_t i = first; i < last; ++i) {
      OpenPoint p = open_[i];
      const std::uint32_t rank = grid_.ranks(p.point)[axis];
      p.axes -= rank > lo && rank <= cut;
      open_[kept] = p;
      kept += p.axes > 0;
    }
    inside += 2 * last - first - kept;
    open_.resize(kept);
    if (!part(last, inside)) return false;
    lo_[axis] = lo;
    return true;
  }

  // Subtracts work, but not below zero. The next part then stops the search.
  void spend(std::size_t products) { cover_.work -= std::min<std::uint64_t>(cover_.work, products / 8); }

  void solve(std::size_t first, std::size_t inside, bool may_lack, bool may_exceed) {
    for (auto& slab : slabs_) slab.clear();
    for (std::size_t i = first; i < open_.size(); ++i) {
      const std::uint32_t* rank = grid_.ranks(open_[i].point);
      std::size_t k = 0;
      while (rank[k] <= lo_[k]) ++k;
      slabs_[k].push_back(rank[k]);
    }
    for (std::size_t k = 0; k < slabs_.size(); ++k) {
      std::sort(slabs_[k].begin(), slabs_[k].end());
      fewest_first_[k] = k;
    }
    std::sort(fewest_first_.begin(), fewest_first_.end(),
              [&](std::size_t a, std::size_t b) { return slabs_[a].size() < slabs_[b].size(); });
    if (may_lack) worst_of(inside, -1);
    if (may_exceed) worst_of(inside, 1);
  }

  // Finds the worst open box (sign -1) or closed box (sign 1). Multiplies all volumes by -sign, so that both cases
  // search a maximum.
  void worst_of(std::size_t inside, double sign) {
    volumes_.resize(1);
    *volumes_.at(0) = -sign;
    for (std::size_t a = 0; a + 1 < fewest_first_.size(); ++a) {
      edges(fewest_first_[a], sign);
      join();
    }
    edges(fewest_first_.back(), sign);
    const std::size_t size = volumes_.size;
    spend(size * edges_.size());
    for (std::size_t s = 0; s < size; s += block) {
      const Block volume = Block::Map(volumes_.at(s));
      Block off = Block::Constant(never);
      for (std::size_t j = 0; j < edges_.size(); ++j)
        off = off.max(volume * edges_[j] + sign * static_cast<double>(j) / n_);
      for (std::size_t i = 0; i < block && s + i < size; ++i)
        cover_.lower =
            std::max(cover_.lower, off[static_cast<Eigen::Index>(i)] + sign * static_cast<double>(inside + s + i) / n_);
    }
  }

  // edges_[j] is the edge along axis k of boxes that contain j points of the slab. Open boxes end at the next point or
  // the end of the part, closed boxes at the last point or the start of the part. A box contains all or none of several
  // points with equal coordinates. Counting only some of them underestimates its error, but another entry counts all of
  // them.
  void edges(std::size_t k, double sign) {
    const std::vector<double>& x = grid_.axis(k);
    edges_.clear();
    if (sign > 0) edges_.push_back(std::max(x[lo_[k]], tiny));
    for (const std::uint32_t rank : slabs_[k]) edges_.push_back(x[rank]);
    if (sign < 0) edges_.push_back(x[hi_[k]]);
  }

  // Computes the largest product of a volume and an edge for each total number of points.
  void join() {
    const std::size_t size = volumes_.size;
    joined_.resize(size + edges_.size() - 1);
    spend(size * edges_.size());
    for (std::size_t s = 0; s < joined_.size; s += block) {
      Block most = Block::Constant(never);
      const std::size_t from = s < size ? 0 : s - size + 1, to = std::min(edges_.size(), s + block);
      for (std::size_t j = from; j < to; ++j) most = most.max(Block::Map(volumes_.at(s) - j) * edges_[j]);
      Block::Map(joined_.at(s)) = most;
    }
    std::fill(joined_.at(joined_.size), joined_.at(joined_.size + block), never);
    std::swap(volumes_, joined_);
  }

  const StarGrid& grid_;
  StarCover& cover_;
  double n_;
  std::vector<std::uint32_t> lo_, hi_;
  std::vector<OpenPoint> open_;
  // Scratch buffers of single calls, kept to allocate their memory once.
  std::vector<std::uint32_t> tally_, middle_;
  std::vector<std::vector<std::uint32_t>> slabs_;
  std::vector<std::size_t> fewest_first_;
  std::vector<double> edges_;
  Volumes volumes_, joined_;
};

} // namespace

bool StarCover::run(const StarGrid& grid) { return CoverSearch(grid, *this).run(); }

} // namespace mc
