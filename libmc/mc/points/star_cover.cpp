#include <mc/points/star_cover.h>

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace mc {

namespace {

// A point that some boxes of a part hold and others do not, and along how many axes that is so.
struct OpenPoint {
  std::uint32_t point, axes;
};

constexpr std::size_t block = 16;
using Block = Eigen::Array<double, block, 1>;

// Less than any volume, also times an edge, of which none is less than tiny.
constexpr double never = -1e300, tiny = 1e-290;

// Volumes by the number of points, with a block of `never` before and behind them.
struct Volumes {
  std::vector<double> padded;
  std::size_t size = 0;

  double* at(std::size_t s) { return padded.data() + block + s; }
  void resize(std::size_t s) {
    size = s;
    padded.assign(size + 2 * block, never);
  }
};

// The boxes of a part hold the points whose rank along axis k is at most g[k], lo[k] <= g[k] < hi[k]: of each of them
// the closed box ends at coordinate g[k], the open one at the next.
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
  // The part between lo and hi, whose open points are the last ones from `first` on. Takes them away again.
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

  // The axis to be halved, the number of axes if no point comes in along two of them: where many points do, and where
  // the volume differs most, which keeps parts about as long along each axis.
  std::size_t tangled_axis(std::size_t first) {
    std::fill(tally_.begin(), tally_.end(), 0u);
    for (std::size_t i = first; i < open_.size(); ++i) {
      if (open_[i].axes < 2) continue;
      const std::uint32_t* rank = grid_.ranks(open_[i].point);
      for (std::size_t k = 0; k < lo_.size(); ++k) tally_[k] += rank[k] > lo_[k]; // and below hi, since it is open
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

  // At the middle one of the points that come in along other axes, too: along this one it then no longer does.
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

  // There may be too little work left for what is being done; then the next part ends it.
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

  // Of the open boxes (sign -1) or the closed ones (sign 1), all of whose volumes are taken times -sign so that the
  // largest is looked for in both cases.
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

  // edges_[j]: where boxes with j points of the slab end along axis k, the open ones at the next point or the part's
  // end, the closed ones at the last point or the part's beginning. Of equal coordinates a box holds all or none; that
  // only some are counted makes it look better than it is, and it is met as it is, too.
  void edges(std::size_t k, double sign) {
    const std::vector<double>& x = grid_.axis(k);
    edges_.clear();
    if (sign > 0) edges_.push_back(std::max(x[lo_[k]], tiny));
    for (const std::uint32_t rank : slabs_[k]) edges_.push_back(x[rank]);
    if (sign < 0) edges_.push_back(x[hi_[k]]);
  }

  // The largest products of a volume and an edge for each sum of their points.
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
  // For one call each, here so that their memory is taken once.
  std::vector<std::uint32_t> tally_, middle_;
  std::vector<std::vector<std::uint32_t>> slabs_;
  std::vector<std::size_t> fewest_first_;
  std::vector<double> edges_;
  Volumes volumes_, joined_;
};

} // namespace

bool StarCover::run(const StarGrid& grid) { return CoverSearch(grid, *this).run(); }

} // namespace mc
