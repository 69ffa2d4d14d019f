#include <mc/check/laws/find_breaks.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mc {
namespace {

template <Real S> double step(const std::vector<S>& a, const std::vector<S>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += sqr(static_cast<double>(S(b[i] - a[i])));
  return std::sqrt(sum);
}

template <Real S> double bend(const std::vector<S>& a, const std::vector<S>& m, const std::vector<S>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += sqr(static_cast<double>(S(S(b[i] - m[i]) - S(m[i] - a[i]))));
  return std::sqrt(sum);
}

} // namespace

template <Real S>
std::vector<S> find_breaks(const std::function<std::vector<S>(const S&)>& map, int segments, std::size_t most) {
  using P = std::vector<S>;
  // The largest u of a distribution; wide scalars receive doubles.
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
  // Returns the entries that exceed the entries `apart` places away most.
  const auto outstanding = [most](const std::vector<double>& values, std::size_t apart) {
    std::vector<std::pair<double, std::size_t>> found;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double before = i >= apart ? values[i - apart] : 0,
                   after = i + apart < values.size() ? values[i + apart] : 0;
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
      if (step(fa, fm) > step(fm, fb)) {
        b = m;
        fb = fm;
      } else {
        a = m;
        fa = fm;
      }
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
      // Continues in the part with the sharpest bend: left, middle or right.
      const double left = bend(fa, fl, fm), middle = bend(fl, fm, fr), right = bend(fm, fr, fb);
      if (middle >= left && middle >= right) {
        a = l;
        fa = fl;
        b = r;
        fb = fr;
      } else if (left > right) {
        b = m;
        fb = fm;
        m = l;
        fm = fl;
      } else {
        a = m;
        fa = fm;
        m = r;
        fm = fr;
      }
    }
    breaks.push_back(m);
  }
  return breaks;
}

template std::vector<float> find_breaks(const std::function<std::vector<float>(const float&)>&, int, std::size_t);
template std::vector<double> find_breaks(const std::function<std::vector<double>(const double&)>&, int, std::size_t);
template std::vector<Oracle> find_breaks(const std::function<std::vector<Oracle>(const Oracle&)>&, int, std::size_t);

} // namespace mc
