#include <mc/check/laws.h>

namespace mc::detail {

template <Real S> void EdgeWalk<S>::operator()(std::uint64_t seed) const {
  using std::nextafter;
  const S h = std::numeric_limits<S>::epsilon() / 2, last = one_minus_epsilon<S>;
  const std::array<S, 9> places{S(0), h, S(0.25), S(0.5) - h / 2, S(0.5), S(0.5) + h, S(0.75), S(1 - 0x1p-24), last};
  int total = 1;
  for (int i = 0; i < dim; ++i) total *= static_cast<int>(places.size());
  for (int k = 0; k < total; ++k) {
    Triple<S> u{};
    for (int i = 0, rest = k; i < dim; ++i, rest /= 9)
      u[static_cast<std::size_t>(i)] = places[static_cast<std::size_t>(rest % 9)];
    probe(u);
  }

  Pcg random(seed, 14);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dim); ++axis) {
    for (int line = 0; line < (dim == 1 ? 1 : 8); ++line) {
      const Subject::Coordinates c = law_point(random, dim);
      const Triple<S> start{narrowed<S>(c[0]), narrowed<S>(c[1]), narrowed<S>(c[2])};
      const auto neighbours = [&](S t) {
        Triple<S> u = start;
        for (const S place : {S(t - h), S(nextafter(S(nextafter(t, S(0))), S(0))), S(nextafter(t, S(0))), t,
                              S(nextafter(t, S(1))), S(nextafter(S(nextafter(t, S(1))), S(1))), S(t + h)}) {
          u[axis] = place < 0 ? S(0) : place < last ? place : last;
          probe(u);
        }
      };
      const auto along = [axis]<class T>(const Map<T>& f, const Triple<T>& from) {
        return [&f, from, axis](const T& t) {
          Triple<T> u = from;
          u[axis] = t;
          return f(u, from);
        };
      };
      for (const S t : find_breaks<S>(along(map, start), 256, 4)) neighbours(t);
      if (line > 0 || !exact) continue;
      const Triple<Oracle> wide{Oracle(start[0]), Oracle(start[1]), Oracle(start[2])};
      for (const Oracle& t : find_breaks<Oracle>(along(exact, wide), 48, 2)) neighbours(static_cast<S>(t));
    }
  }
}

template struct EdgeWalk<float>;
template struct EdgeWalk<double>;

void jacobian_law(int dim, const std::function<Triple<Oracle>(const Triple<Oracle>&)>& chart,
                  const std::function<Oracle(const Triple<Oracle>&)>& density, std::uint64_t points, std::uint64_t seed,
                  LawLedger& ledger) {
  const Oracle h(1e-20);
  const auto n = static_cast<std::size_t>(dim);
  Pcg random(seed, 12);
  for (std::uint64_t k = 0; k < points; ++k) {
    const Subject::Coordinates c = law_point(random, dim);
    const Triple<Oracle> u{Oracle(c[0]), Oracle(c[1]), Oracle(c[2])};
    // The unit matrix beyond the domain's dimensions.
    std::array<Triple<Oracle>, 3> j{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (std::size_t axis = 0; axis < n; ++axis) {
      Triple<Oracle> ahead = u, behind = u;
      ahead[axis] += h, behind[axis] -= h;
      const Triple<Oracle> a = chart(ahead), b = chart(behind);
      for (std::size_t i = 0; i < n; ++i) j[i][axis] = (a[i] - b[i]) / (2 * h);
    }
    const Oracle determinant = j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
                               j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
                               j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
    const double off = std::abs(static_cast<double>(Oracle(abs(Oracle(determinant * density(u))) - 1)));
    ledger.note(off, [&] {
      return fmt::format("|det| pdf - 1 = {:.3g} at u = ({:.17g}, {:.17g}, {:.17g})", off, c[0], c[1], c[2]);
    });
  }
}

} // namespace mc::detail
