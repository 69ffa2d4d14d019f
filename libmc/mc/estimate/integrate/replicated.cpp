#include <mc/estimate/integrate/methods.h>
#include <mc/estimate/integrate/sequences.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace mc::detail {

namespace {

// Sequences that grow, and what they say on the way.
class Growth {
 public:
  Growth(Run& r, Method method, std::optional<Outcome>& l) : out{{}, method}, run_(r), last_(l) {}

  Outcome out;

  // The longest power of two that all replicates can reach.
  std::uint64_t affordable(const Sequences& s) const {
    const auto each = run_.left() / run_.o.replicates;
    return std::min(std::bit_floor(s.length + static_cast<std::uint64_t>(static_cast<double>(each) / s.cost())),
                    Sequences::longest);
  }
  // Points of all replicates that the calls left are enough for.
  double points_left(const Sequences& s) const { return static_cast<double>(run_.left()) / s.cost(); }
  static std::uint64_t next(const Sequences& s, std::uint64_t end) {
    return std::max(std::min<std::uint64_t>(16, end), 2 * s.length);
  }
  bool grow(Sequences& s, std::uint64_t end) {
    for (std::uint64_t to = next(s, end); to <= end; to *= 2)
      if (adopt(s, s.extend(run_, to))) return true;
    return false;
  }
  // To the end of the calls: all replicates, until the fewest of them could go on to eight times the length.
  Outcome finish(Sequences& s) {
    const double all = run_.o.replicates, points = points_left(s) + all * static_cast<double>(s.length);
    const double reach = points / (all / 8 + fewest() * 7 / 8);
    const std::uint64_t shared = std::bit_floor(static_cast<std::uint64_t>(reach / 8)), most = affordable(s);
    if (grow(s, std::clamp(shared, std::min<std::uint64_t>(16, most), most))) return std::move(out);
    const End end = best_end(s);
    if (end.count < run_.o.replicates) s.keep(end.count);
    if (!grow(s, end.length)) use_up(s);
    return std::move(out);
  }
  // Takes what a sequence says for the outcome; whether that is good enough.
  bool adopt(const Sequences& s, const Means& means) {
    out.means = means;
    out.seen = s.seen();
    out.correlations = s.correlations(run_);
    run_.record(out.method, means);
    if (run_.converged(out.means)) out.stop = Stop::converged;
    last_ = out;
    return out.stop == Stop::converged;
  }

 private:
  struct End {
    std::uint64_t length;
    std::uint32_t count;
  };
  // Eight at least, where there are as many: fewer know their own error too badly.
  double fewest() const {
    const double all = run_.o.replicates;
    return std::max(std::ceil(all / 3), std::min(all, 8.0));
  }

  // How long sequences should get, and how many of them, for the calls that are left: what leaves least variance, if it
  // goes on falling as it did, and no slower than that of independent points.
  End best_end(const Sequences& s) const {
    End best{s.length, run_.o.replicates};
    double least = 0;
    const double all = run_.o.replicates, points = points_left(s), fallen = std::max(fall(s), std::log(2.0));
    for (std::uint64_t length = s.length; s.length > 0 && length <= Sequences::longest; length *= 2) {
      const double longer = static_cast<double>(length - s.length), size = static_cast<double>(length);
      const double count = longer > 0 ? std::min(std::floor(points / longer), all) : all;
      if (count < fewest()) break;
      const double more = count < all ? 0 : std::floor((points - all * longer) / size); // as long as the others
      const double variance = -fallen * std::log2(size / static_cast<double>(s.length)) - std::log(count + more);
      if (variance > least) continue;
      least = variance;
      best = {length, static_cast<std::uint32_t>(count)};
    }
    return best;
  }
  // More replicates, as long as those there are.
  void use_up(Sequences& s) {
    const std::uint64_t more = run_.left() / std::max<std::uint64_t>(s.calls_each(), 1);
    if (more > 0 && s.length > 0) adopt(s, s.widen(run_, static_cast<std::uint32_t>(more)));
  }

  Run& run_;
  std::optional<Outcome>& last_;
};

struct Candidate {
  Method method;
  Sequences sequences;
};

// Lets what was learned run against the bare sequences as far as these went, and against each other: whoever falls
// behind by more than chance is out, and the bare sequences or the grid only make way for what is better by more than
// chance. Interlaced points may start worse and fall faster than others, and all others than those behind a tree, whose
// boxes are jumps: these compete at the length they would end with.
class Contest {
  static constexpr double chance = 0.5; // what may lie between two that are equal

 public:
  Contest(Run& r, const Sequences& b, std::uint64_t l) : run_(r), bare_(b), last_(l) {}

  std::optional<Candidate> best_of(std::vector<Candidate>& all) {
    for (std::uint64_t to = std::min<std::uint64_t>(16, bare_.length); to <= bare_.length && !all.empty(); to *= 2) {
      for (Candidate& c : all) c.sequences.extend(run_, to);
      doublings_ = std::max(std::log2(static_cast<double>(last_) / static_cast<double>(to)), 0.0);
      if (to < 128) continue;
      std::vector<Candidate> left;
      for (Candidate& c : all)
        if (beaten(c, all)) tell(c);
        else left.push_back(c);
      all = std::move(left);
    }
    if (all.empty()) return {};
    const bool second = all.size() > 1 && worse(all.front().sequences, all.back().sequences, doublings_, margin());
    if (all.size() > 1) tell(all[second ? 0 : 1]);
    Candidate& best = all[second ? 1 : 0];
    if (worse(bare_, best.sequences, between(best), run_.interlaced() ? 2 * margin() : 0)) {
      run_.independent(Method::rqmc);
      return std::move(best);
    }
    for (Round& r : run_.rounds) r.independent = false;
    tell(best);
    return {};
  }

 private:
  // Of one that is out: the answer is independent of it.
  void tell(const Candidate& c) {
    run_.record(c.method, c.sequences.means);
    run_.rounds.back().independent = true;
  }
  // What extrapolation is not trusted with: a quarter of the variance for each doubling, twice that beside interlaced
  // points.
  double margin() const { return 0.25 * doublings_; }
  double between(const Candidate& c) const { return run_.interlaced() || c.method == Method::tree ? doublings_ : 0; }
  bool beaten(const Candidate& c, const std::vector<Candidate>& all) const {
    const auto by = [&](const Candidate& o) { return worse(c.sequences, o.sequences, doublings_, chance + margin()); };
    return worse(c.sequences, bare_, between(c), chance + margin()) || std::any_of(all.begin(), all.end(), by);
  }

  Run& run_;
  const Sequences& bare_;
  std::uint64_t last_; // the length that they would end with
  double doublings_ = 0;
};

std::vector<Candidate> candidates(const Learned& learned) {
  std::vector<Candidate> all;
  const auto propose = [&](Method method, std::uint64_t purpose, std::shared_ptr<const AdaptedDensity> density) {
    all.push_back({method, {.purpose = purpose, .proposal = {std::move(density), learned.centre}}});
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
  Sequences bare{.purpose = 0, .record = method == Method::automatic};
  if (method == Method::rqmc) return growth.finish(bare);
  if (method == Method::automatic && growth.grow(bare, std::max<std::uint64_t>(growth.affordable(bare) / 16, 1)))
    return std::move(growth.out);

  const std::optional<Learned> learned = learn(run, method == Method::automatic ? &bare : nullptr);
  bare.forget();
  if (!learned) return growth.finish(bare);
  growth.out.density = learned->density;
  std::vector<Candidate> all = candidates(*learned);
  if (method != Method::automatic) {
    Candidate& c = method == Method::vegas ? all.front() : all.back();
    return growth.finish(c.sequences);
  }
  const std::uint64_t reach = growth.affordable(all.front().sequences);
  if (bare.length > reach) return growth.finish(bare); // nothing is left to hold what was learned against
  std::optional<Candidate> best = Contest(run, bare, reach).best_of(all);
  if (!best) return growth.finish(bare);
  growth.out.method = best->method;
  if (growth.adopt(best->sequences, best->sequences.means)) return std::move(growth.out);
  return growth.finish(best->sequences);
}

} // namespace mc::detail
