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

static const double lo[] = {0, -1}, hi[] = {1, 2};
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
};
MC_INTEGRANDS(integrands)
