#include <mc/estimate/integrate/methods.h>
#include <mc/estimate/integrate/sequences.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace mc::detail {

namespace {

// Replicates that a run ends with at least: eight where there are as many, fewer know their own error too badly.
std::uint32_t fewest(std::uint32_t all) { return std::max((all + 2) / 3, std::min(all, 8u)); }

// Sequences that grow, and what they say on the way.
class Growth {
 public:
  Growth(Run& r, Method method, std::optional<Outcome>& l) : out{{}, method}, run_(r), last_(l) {}

  Outcome out;

  // The longest power of two that all replicates can reach.
  std::uint64_t affordable(const Sequences& s) const {
    const auto each = run_.left() / s.count;
    return std::min(std::bit_floor(s.length + static_cast<std::uint64_t>(static_cast<double>(each) / s.cost())),
                    Sequences::longest);
  }
  // Points of all replicates that the calls left are enough for.
  double points_left(const Sequences& s) const { return static_cast<double>(run_.left()) / s.cost(); }
  static std::uint64_t next(const Sequences& s, std::uint64_t end) {
    return std::max(std::min<std::uint64_t>(16, end), 2 * s.length);
  }
  bool grow(Sequences& s, std::uint64_t end) {
    for (std::uint64_t to = next(s, end); to <= end; to *= 2) {
      s.extend(run_, to);
      if (enough(s)) return true;
    }
    return false;
  }
  // To the end of the calls: all replicates at first, then as many as best_end says.
  Outcome finish(Sequences& s) {
    const std::uint64_t most = affordable(s);
    if (grow(s, std::clamp(shared(s), std::min<std::uint64_t>(16, most), most))) return std::move(out);
    const End end = best_end(s);
    if (end.count < s.count) s.keep(end.count);
    s.sparse = end.sparse;
    if (!grow(s, end.length)) use_up(s);
    return std::move(out);
  }
  // Makes what sequences say the outcome.
  void adopt(const Sequences& s) {
    out.means = s.means;
    out.seen = s.seen();
    out.correlations = s.correlations(run_);
    run_.record(out.method, out.means);
    last_ = out;
  }
  // The same, and returns whether that is good enough. Short ones never are: they agree where none of them has met a
  // thousandth of the volume that decides, or a place where the density is far too low.
  bool enough(const Sequences& s) {
    adopt(s);
    if (s.length >= AxisProfile::most && run_.converged(out.means)) out.stop = last_->stop = Stop::converged;
    return out.stop == Stop::converged;
  }

 private:
  struct End {
    std::uint64_t length;
    std::uint32_t count;
    std::uint64_t sparse;
  };

  // How long all replicates get so that the fewest still reach the greatest length that the calls allow; an eighth of
  // that at most, a 32nd at least, and 64 points, to see how the error falls. Those that are so long already grow no
  // longer together, where some may go: of a million calls 67 thousand went to the replicates that were dropped.
  std::uint64_t shared(const Sequences& s) const {
    const double all = s.count, points = points_left(s) + all * static_cast<double>(s.length);
    const double fewer = std::min<double>(fewest(run_.o.replicates), all);
    double longest = std::exp2(std::floor(std::log2(static_cast<double>(s.length) + points_left(s) / fewer)));
    const auto affords = [&](double length) { return all * length + fewer * (longest - length) <= points; };
    const double least = std::min(std::max(longest / 32, 64.0), longest / 8); // shorter ones hardly show the fall
    if (!affords(std::max(least, static_cast<double>(s.length)))) longest /= 2;
    if (static_cast<double>(s.length) >= least && all > fewer) return s.length;
    double length = longest / 8;
    while (length > 1 && !affords(length)) length /= 2;
    return static_cast<std::uint64_t>(length);
  }
  // How long sequences should get, how many of them, and how dense their uniform part, for the calls that are left:
  // what leaves least variance, if it goes on falling as it did, and no slower than that of independent points. Where
  // it falls fast a uniform part of an eighth of the points has most of the variance.
  End best_end(const Sequences& s) const {
    End best{s.length, s.count, s.sparse};
    double least = std::numeric_limits<double>::infinity();
    const double fallen = std::max(fall(s) / std::log(2.0), 1.0), of_uniform = s.uniform_variance();
    const auto falls = [&](std::uint64_t from, std::uint64_t to) {
      return std::pow(static_cast<double>(to) / static_cast<double>(from), -fallen);
    };
    for (std::uint64_t sparse = s.sparse; sparse > 0 && s.length > 0; sparse = of_uniform > 0 ? sparse / 2 : 0)
      // Replicates that do not grow keep the uniform part they have.
      for (std::uint64_t length = sparse < s.sparse ? 2 * s.length : s.length; length <= Sequences::longest;
           length *= 2) {
        const std::uint64_t uniform_length = s.uniform_points(length, sparse);
        const double replicates = ends(s, length + uniform_length);
        if (replicates < fewest(run_.o.replicates)) break;
        double variance = (1 - of_uniform) * falls(s.length, length);
        if (of_uniform > 0) variance += of_uniform * falls(s.uniform_length, uniform_length);
        if (variance / replicates > least) continue;
        least = variance / replicates;
        best = {length, static_cast<std::uint32_t>(std::min<double>(replicates, s.count)), sparse};
      }
    return best;
  }
  // How many replicates of so many calls there will be: some of those there are, or all of them and others.
  double ends(const Sequences& s, std::uint64_t calls) const {
    const double all = s.count, left = static_cast<double>(run_.left()), each = static_cast<double>(calls),
                 longer = each - static_cast<double>(s.calls_each());
    if (left < all * longer) return std::floor(left / longer);
    return all + std::floor((left - all * longer) / each);
  }
  // More replicates, as long as those there are.
  void use_up(Sequences& s) {
    const std::uint64_t more = run_.left() / std::max<std::uint64_t>(s.calls_each(), 1);
    if (more == 0 || s.length == 0) return;
    s.widen(run_, static_cast<std::uint32_t>(more));
    enough(s);
  }

  Run& run_;
  std::optional<Outcome>& last_;
};

struct Candidate {
  Method method;
  Sequences sequences;
};

// Lets what was learned run against the bare sequences as far as these went, and against each other, at the length that
// they would end with. As many replicates race as end: what others would say is worth less than their calls.
class Contest {
  static constexpr double clear = 3; // a decision by more than this is made on the way
  // Of what was gained for each doubling so far, the part that those which follow gain more: of interlaced points than
  // of others, of bare ones than of those behind a grid, of these than of those behind a tree, whose boxes are jumps.
  static constexpr double of_interlacing = 1, without_grid = 0.5, without_boxes = 1.5;

 public:
  // `last`: the length that they would end with.
  Contest(Run& r, const Sequences& b, std::uint64_t last)
      : run_(r), bare_(b),
        doublings_(std::max(std::log2(static_cast<double>(last) / static_cast<double>(b.length)), 0.0)) {}

  std::optional<Candidate> best_of(std::vector<Candidate>& all) {
    for (std::uint64_t to = std::min<std::uint64_t>(16, bare_.length); to <= bare_.length; to *= 2) {
      for (Candidate& c : all) c.sequences.extend(run_, to);
      if (to >= 64 && all.size() > 1 && std::abs(over_grid(all)) > clear && !disagree(all)) drop(all, 1 - best(all));
    }
    const std::size_t first = best(all);
    const bool ahead = over_bare(all[first]) > 0;
    for (Round& r : run_.rounds) r.independent &= ahead;
    if (ahead) run_.independent(Method::rqmc);
    if (all.size() > 1) drop(all, 1 - first);
    if (ahead) return std::move(all.front());
    drop(all, 0);
    return {};
  }

 private:
  // The answer is independent of one that is out.
  void drop(std::vector<Candidate>& all, std::size_t i) {
    run_.record(all[i].method, all[i].sequences.means);
    run_.rounds.back().independent = true;
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
  }
  // By how much one is ahead, beyond doubt, in the logarithm of the variance.
  double over_bare(const Candidate& c) const {
    if (sees_less(bare_.history.back(), c.sequences.history.back())) return clear;
    return advantage(bare_, c.sequences, doublings_, run_.interlaced() ? of_interlacing : without_grid) -
           doubt(c.sequences.history.back());
  }
  double over_grid(const std::vector<Candidate>& all) const {
    return advantage(all[0].sequences, all[1].sequences, doublings_, without_boxes) -
           doubt(all[1].sequences.history.back());
  }
  // The one that has not met what counts may look better by far.
  static bool disagree(const std::vector<Candidate>& all) {
    return apart(all[0].sequences.history.back(), all[1].sequences.history.back());
  }
  std::size_t best(const std::vector<Candidate>& all) const { return all.size() > 1 && over_grid(all) > 0 ? 1 : 0; }

  Run& run_;
  const Sequences& bare_;
  double doublings_; // after the contest
};

std::vector<Candidate> candidates(const Learned& learned, std::uint32_t count) {
  std::vector<Candidate> all;
  const auto propose = [&](Method method, std::uint64_t purpose, std::shared_ptr<const AdaptedDensity> density) {
    all.push_back({method, {.purpose = purpose, .count = count, .proposal = {std::move(density), learned.centre}}});
  };
  // The rounds of learning have the purposes between.
  const AdaptedDensity& density = *learned.density;
  propose(Method::vegas, 1, std::make_shared<AdaptedDensity>(AdaptedDensity{density.grid}));
  if (density.tree && density.tree->leaves() > 1) propose(Method::tree, 30, learned.density);
  return all;
}

} // namespace

Outcome sequences(Run& run, Method method, std::optional<Outcome>& last) {
  Growth growth(run, method == Method::automatic ? Method::rqmc : method, last);
  Sequences bare{.purpose = 0, .count = run.o.replicates, .record = method == Method::automatic};
  if (method == Method::rqmc) return growth.finish(bare);
  if (method == Method::automatic) {
    const std::uint64_t most = growth.affordable(bare);
    if (growth.grow(bare, std::max<std::uint64_t>(most / 16, 1))) return std::move(growth.out);
    // What would have converged but for its length gets it.
    if (run.converged(bare.means) && growth.grow(bare, std::min(most, AxisProfile::most))) return std::move(growth.out);
  }

  const std::optional<Learned> learned = learn(run, method == Method::automatic ? &bare : nullptr, last);
  bare.forget();
  if (!learned) return growth.finish(bare);
  growth.out.density = learned->density;
  const bool contest = method == Method::automatic;
  std::vector<Candidate> all = candidates(*learned, contest ? fewest(run.o.replicates) : run.o.replicates);
  if (method != Method::automatic) {
    Candidate& c = method == Method::vegas ? all.front() : all.back();
    return growth.finish(c.sequences);
  }
  // Of few calls none are left to hold against each other what was learned; a point costs two calls at most.
  if (2 * all.size() * all.front().sequences.count * bare.length > run.left()) return growth.finish(bare);
  std::optional<Candidate> best = Contest(run, bare, growth.affordable(all.front().sequences)).best_of(all);
  if (!best) return growth.finish(bare);
  growth.out.method = best->method;
  growth.adopt(best->sequences); // not yet good enough: it was chosen for the error that it shows here
  return growth.finish(best->sequences);
}

} // namespace mc::detail
