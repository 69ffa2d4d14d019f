/// Cost of a call by the methods of integrate() with uniform points, for the integrand u_1 + u_d. Prints CSV: CPU time
/// per call [ns], the minimum over 15 runs of 400,000 calls on one thread, and its ratio to rqmc.
/// Usage: bench_mc_estimate_call_cost

#include <mc/estimate/integrate.h>

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <span>

namespace {

double ns_per_call(mc::Method method, int dim) {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    mc::IntegrateOptions o;
    o.method = method;
    o.rel_error = 0;
    o.max_calls = 400'000;
    o.seed = seed;
    o.threads = 1;
    const std::clock_t begin = std::clock();
    const mc::Integral r = mc::integrate_unit([](std::span<const double> u) { return u.front() + u.back(); }, dim, o);
    const double seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;
    least = std::min(least, 1e9 * seconds / static_cast<double>(r.calls));
  }
  return least;
}

} // namespace

int main() {
  fmt::print("dim,method,ns_per_call,times_rqmc\n");
  for (const int dim : {1, 2, 3, 5, 8, 10, 20, 50, 100}) {
    const double rqmc = ns_per_call(mc::Method::rqmc, dim);
    for (const mc::Method method : {mc::Method::rqmc, mc::Method::plain, mc::Method::stratified}) {
      const double ns = method == mc::Method::rqmc ? rqmc : ns_per_call(method, dim);
      fmt::print("{},{},{:.1f},{:.2f}\n", dim, mc::name(method), ns, ns / rqmc);
    }
  }
}
