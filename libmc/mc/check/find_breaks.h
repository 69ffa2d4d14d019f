#pragma once
/// Where a map of the unit interval jumps or bends: beside its branches.

#include <mc/core/types.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace mc {

/// Numbers of (0,1) at which map : [0,1) -> scalar or vector has a jump or a kink. The interval is scanned in `segments` steps; the
/// `most` steps that stand out from their neighbours are halved until two neighbouring numbers of S enclose the jump, of which the
/// upper one is returned; likewise for changes of slope, as far down as rounding lets them be seen (2^-60 over wide scalars).
/// A heuristic: breaks closer than two segments to another may be missed, and steep smooth places may be returned.
template <Real S, class F> std::vector<S> find_breaks(const F& map, int segments, std::size_t most) {
  using P = std::remove_cvref_t<decltype(map(S(0)))>;
  const auto length = [](const P& d) -> double {
    if constexpr (requires { d.norm(); }) return static_cast<double>(d.norm());
    else return std::abs(static_cast<double>(d));
  };
  const auto step = [&](const P& a, const P& b) { return length(P(b - a)); };
  const auto bend = [&](const P& a, const P& m, const P& b) { return length(P((b - m) - (m - a))); };

  // The last number that a sampler can meet: wide scalars get doubles.
  const S last = one_minus_epsilon<S> < S(1 - 0x1p-53) ? one_minus_epsilon<S> : S(1 - 0x1p-53);
  const auto n = static_cast<std::size_t>(segments);
  std::vector<S> at;
  std::vector<P> x;
  for (int i = 0; i <= segments; ++i) {
    at.push_back(i < segments ? S(i) / S(segments) : last);
    x.push_back(map(at.back()));
  }
  std::vector<double> steps(n), bends(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) steps[i] = step(x[i], x[i + 1]);
  for (std::size_t i = 1; i < n; ++i) bends[i] = bend(x[i - 1], x[i], x[i + 1]);
  // The entries that stand out most from those `apart` places away.
  const auto outstanding = [most](const std::vector<double>& values, std::size_t apart) {
    std::vector<std::pair<double, std::size_t>> found;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double before = i >= apart ? values[i - apart] : 0, after = i + apart < values.size() ? values[i + apart] : 0;
      if (values[i] > 3 * std::max(before, after)) found.emplace_back(std::max(before, after) / values[i], i);
    }
    std::sort(found.begin(), found.end());
    if (found.size() > most) found.resize(most);
    return found;
  };

  std::vector<S> breaks;
  const S least = S(0x1p-60);
  for (const auto& [ratio, i] : outstanding(steps, 1)) {
    S a = at[i], b = at[i + 1];
    P fa = x[i], fb = x[i + 1];
    for (;;) {
      const S m = (a + b) / 2;
      if (!(m > a && m < b) || S(b - a) < least) break;
      const P fm = map(m);
      if (step(fa, fm) > step(fm, fb)) b = m, fb = fm;
      else a = m, fa = fm;
    }
    breaks.push_back(b);
  }
  for (const auto& [ratio, i] : outstanding(bends, 2)) {
    if (i == 0 || i == n) continue;
    S a = at[i - 1], m = at[i], b = at[i + 1];
    P fa = x[i - 1], fm = x[i], fb = x[i + 1];
    for (;;) {
      const S l = (a + m) / 2, r = (m + b) / 2;
      if (!(l > a && l < m && r > m && r < b) || S(b - a) < least) break;
      const P fl = map(l), fr = map(r);
      // The half with the sharpest bend: left, middle or right.
      const double left = bend(fa, fl, fm), middle = bend(fl, fm, fr), right = bend(fm, fr, fb);
      if (middle >= left && middle >= right) a = l, fa = fl, b = r, fb = fr;
      else if (left > right) b = m, fb = fm, m = l, fm = fl;
      else a = m, fa = fm, m = r, fm = fr;
    }
    breaks.push_back(m);
  }
  return breaks;
}

} // namespace mc
