/* Integrands of a plugin: correct ones, and one for each fault. */
#include <mc/check/plugin.h>

#include <math.h>

static double sum(const double* x) { return x[0] + x[1]; }
static void sums(int64_t count, const double* x, double* values) {
  int64_t i;
  for (i = 0; i < count; ++i) values[i] = x[2 * i] + x[2 * i + 1];
}
static void sums_of_pairs(int64_t count, const double* x, double* values) { /* omits the last point of an odd count */
  int64_t i;
  for (i = 0; i + 1 < count; i += 2) sums(2, x + 2 * i, values + i);
}
static double remembers(const double* x) {
  static double before;
  const double value = x[0] + 1e-3 * before;
  before = x[0];
  return value;
}
static double crash(const double* x) {
  volatile int* nowhere = 0;
  if (x[0] > 0.5) *nowhere = 1;
  return x[0];
}
static double not_a_number(const double* x) { return x[0] > 0.9 ? sqrt(-x[0]) : 1; }
static double hang(const double* x) {
  volatile unsigned spin = 0;
  if (x[0] > 0.5)
    for (;;) ++spin;
  return x[0];
}
static double slow(const double* x) {
  volatile unsigned spin;
  for (spin = 0; spin < 5000000;) ++spin;
  return x[0];
}

static void moments(const double* x, double* values) {
  values[0] = 1;
  values[1] = x[0];
  values[2] = x[0] * x[1];
}
static void many_moments(int64_t count, const double* x, double* values) {
  int64_t i;
  for (i = 0; i < count; ++i) moments(x + 2 * i, values + 3 * i);
}
static double sum_of_all(const double* x) {
  double total = 0;
  int i;
  for (i = 0; i < 1024; ++i) total += x[i];
  return total;
}
/* 1 / sqrt(x y), whose variance over the unit square is infinite, with the density 1 / (4 sqrt(x y)). */
static double singular(const double* x) { return 1 / sqrt(x[0] * x[1]); }
static void squares(const double* u, double* x) {
  x[0] = (1 - u[0]) * (1 - u[0]);
  x[1] = (1 - u[1]) * (1 - u[1]);
}
static double density_of_squares(const double* x) { return 1 / (4 * sqrt(x[0] * x[1])); }
/* Uniform points of [0,2], from the last of three numbers; half of them lie outside of the domain. */
static double one(const double* x) { return x[0] >= 0 && x[0] <= 1 ? 1 : sqrt(-1.0); }
static void beyond(const double* u, double* x) { x[0] = 2 * u[2]; }
static double half(const double* x) { return 0.5 + 0 * x[0]; }
static double zero(const double* x) { return 0 * x[0]; }
static void nowhere(const double* u, double* x) { x[0] = u[0] / 0.0; }

static const double lo[] = {0, -1}, hi[] = {1, 2};
static const double truths[] = {3, 1.5, 0.75};
static const char* const moment_names[] = {"mass", "mean", "cross"};
static const mc_integrand integrands[] = {
    {.name = "Sum", .title = "x + y over a box", .dim = 2, .has_truth = 1, .truth = 3, .lo = lo, .hi = hi, .eval = sum},
    {.name = "Batch", .dim = 2, .has_truth = 1, .truth = 3, .lo = lo, .hi = hi, .eval = sum, .eval_many = sums},
    {.name = "WrongTruth", .dim = 2, .has_truth = 1, .truth = 1.01, .eval = sum},
    {.name = "Pairs", .dim = 2, .lo = lo, .hi = hi, .eval = sum, .eval_many = sums_of_pairs},
    {.name = "Remembers", .dim = 1, .eval = remembers},
    {.name = "Crash", .dim = 1, .eval = crash},
    {.name = "NaN", .dim = 1, .eval = not_a_number},
    {.name = "Hang", .dim = 1, .eval = hang},
    {.name = "Slow", .dim = 1, .eval = slow},
    {.name = "Moments",
     .dim = 2,
     .has_truth = 1,
     .lo = lo,
     .hi = hi,
     .eval_many = many_moments,
     .outputs = 3,
     .output_names = moment_names,
     .truths = truths,
     .eval_outputs = moments},
    {.name = "Wide", .dim = 1024, .has_truth = 1, .truth = 512, .eval = sum_of_all},
    {.name = "Singular",
     .dim = 2,
     .has_truth = 1,
     .truth = 4,
     .eval = singular,
     .sample = squares,
     .pdf = density_of_squares},
    {.name = "Beyond", .dim = 1, .has_truth = 1, .truth = 1, .eval = one, .uniforms = 3, .sample = beyond, .pdf = half},
    {.name = "NoDensity", .dim = 1, .eval = one, .sample = beyond, .pdf = zero},
    {.name = "NoPoint", .dim = 1, .eval = one, .sample = nowhere, .pdf = half},
};
MC_INTEGRANDS(integrands)
