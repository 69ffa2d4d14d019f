/* Right samplers, and what can be wrong with them, turned on by a parameter. */
#include <mc/check/plugin.h>

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

enum fault {
  pdf_high,
  weight_low,
  nan_sample,
  nan_pdf,
  crash,
  hang,
  quit,
  leak,
  not_unit,
  silent,
  wrong_inverse,
  tilted_pdf,
  hole,
  slow
};

static int is(const void* self, enum fault f) { return ((const double*)self)[f] != 0; }

/* Malley's method by the polar map: pdf cos / pi. */
static int32_t sample(const void* self, const double* u, double* x) {
  const double phi = 2 * pi * u[0];
  const double v = is(self, hole) ? 0.99 * u[1] : u[1], r = sqrt(v);
  double z = sqrt(1 - v);
  volatile int* nowhere = NULL;
  volatile unsigned spin = 0;
  if (is(self, crash) && u[0] > 0.5) *nowhere = 1;
  if (is(self, hang) && u[0] > 0.5)
    for (;;) ++spin;
  if (is(self, quit) && u[0] > 0.5) exit(0);
  if (is(self, silent)) return 1;
  if (is(self, leak) && u[1] < 0.01) z = -z;
  if (is(self, not_unit)) z *= 1.001;
  if (is(self, slow))
    for (spin = 0; spin < 200000;) ++spin;
  x[0] = r * cos(phi), x[1] = r * sin(phi), x[2] = z;
  if (is(self, nan_sample) && u[0] > 0.9 && u[1] > 0.9) x[1] = log(-1.0);
  return 1;
}

static double pdf(const void* self, const double* x) {
  const double d = x[2] > 0 ? x[2] / pi : 0;
  if (is(self, hole)) return x[2] > 0.1 ? d / 0.99 : 0;
  if (is(self, pdf_high)) return 1.01 * d;
  if (is(self, tilted_pdf)) return d * (1 + 0.0003 * (2 * x[2] * x[2] - 1));
  if (is(self, nan_pdf) && x[0] > 0.7 && x[1] > 0) return d / 0.0 * 0.0;
  return d;
}

static int32_t invert(const void* self, const double* x, double* u) {
  const double phi = atan2(x[1], x[0]) / (2 * pi);
  u[0] = phi < 0 ? phi + 1 : phi;
  u[1] = x[0] * x[0] + x[1] * x[1];
  if (is(self, hole)) u[1] /= 0.99;
  if (is(self, wrong_inverse)) u[1] = sqrt(u[1]);
  return 1;
}

static double eval(const void* self, const double* x) {
  (void)self;
  return x[2] > 0 ? 0.5 * x[2] / pi : 0;
}

static double weight(const void* self, const double* u, const double* x) {
  (void)u;
  (void)x;
  if (is(self, hole)) return 0.5 * 0.99;
  return is(self, weight_low) ? 0.499 : 0.5;
}

/* Samples, in doubles that hold floats, of the density 1 / (x + 1)^2 on the half line. */
static int32_t sample_tail(const void* self, const double* u, double* x) {
  const float v = (float)u[0];
  (void)self;
  x[0] = (double)(v / (1 - v));
  return 1;
}
static double pdf_tail(const void* self, const double* x) {
  (void)self;
  return x[0] >= 0 ? 1 / ((1 + x[0]) * (1 + x[0])) : 0;
}

/* The logistic distribution, far from 0 and narrow, and its mirrored half. */
static int32_t sample_logistic(const void* self, const double* u, double* x) {
  (void)self;
  x[0] = 1e6 + 1e-3 * log((u[0] + 0x1p-60) / (1 - u[0]));
  return 1;
}
static double pdf_logistic(const void* self, const double* x) {
  const double t = exp(-fabs(x[0] - 1e6) * 1e3);
  (void)self;
  return 1e3 * t / ((1 + t) * (1 + t));
}
static int32_t sample_below(const void* self, const double* u, double* x) {
  (void)self;
  x[0] = 5 + 20 * log(1 - u[0]);
  return 1;
}
static double pdf_below(const void* self, const double* x) {
  (void)self;
  return x[0] <= 5 ? exp((x[0] - 5) / 20) / 20 : 0;
}

/* Uniform in the disk by rejection from the square: fails with probability 1 - pi / 4. */
static int32_t sample_rejection(const void* self, const double* u, double* x) {
  (void)self;
  x[0] = 2 * u[0] - 1, x[1] = 2 * u[1] - 1;
  return x[0] * x[0] + x[1] * x[1] <= 1;
}
static double pdf_rejection(const void* self, const double* x) {
  (void)self, (void)x;
  return 0.25;
}

/* A box of three dimensions with a state made of its parameter. */
static void destroy(void* self) {
  if (*(double*)self == 14) abort();
  free(self);
}
static void* create(const double* parameters) {
  double* power;
  if (parameters[0] == 13) return NULL;
  power = malloc(sizeof *power);
  *power = parameters[0];
  return power;
}
static int32_t sample_box(const void* self, const double* u, double* x) {
  x[0] = 2 * pow(1 - u[0], 1 / (*(const double*)self + 1)) - 1, x[1] = 3 * u[1], x[2] = u[2];
  return 1;
}
static double pdf_box(const void* self, const double* x) {
  const double n = *(const double*)self;
  return (n + 1) * pow(0.5 * (x[0] + 1), n) / 6;
}

/* Three outcomes of probabilities 0, 3/4 and 1/4; with `forgets`, the first is returned at u = 0. */
static int32_t sample_table(const void* self, const double* u, double* x) {
  x[0] = *(const double*)self != 0 && u[0] == 0 ? 0 : u[0] < 0.75 ? 1 : 2;
  return 1;
}
static double pdf_table(const void* self, const double* x) {
  (void)self;
  return x[0] == 1 ? 0.75 : x[0] == 2 ? 0.25 : 0;
}

static int32_t sample_triangle(const void* self, const double* u, double* x) {
  const double root = sqrt(u[0]);
  (void)self;
  x[0] = 1 - root, x[1] = u[1] * root;
  return 1;
}
static double pdf_triangle(const void* self, const double* x) {
  (void)self, (void)x;
  return 2;
}

/* Takes three numbers for two dimensions: one of two halves of the sphere, then a point of it. Its parameter turns the samples, but
   not the pdf, about x by so many degrees. */
static int32_t sample_halves(const void* self, const double* u, double* x) {
  const double z = u[0] < 0.25 ? u[1] : -u[1], r = sqrt(1 - z * z), y = r * sin(2 * pi * u[2]);
  const double angle = *(const double*)self * pi / 180;
  x[0] = r * cos(2 * pi * u[2]), x[1] = y * cos(angle) - z * sin(angle), x[2] = y * sin(angle) + z * cos(angle);
  return 1;
}
static double pdf_halves(const void* self, const double* x) {
  (void)self;
  return (x[2] > 0 ? 0.25 : 0.75) / (2 * pi);
}

static const mc_parameter faults[] = {
    {"pdf_high", 0, 0, 1}, {"weight_low", 0, 0, 1}, {"nan_sample", 0, 0, 1},    {"nan_pdf", 0, 0, 1},
    {"crash", 0, 0, 1},    {"hang", 0, 0, 1},       {"quit", 0, 0, 1},          {"leak", 0, 0, 1},
    {"not_unit", 0, 0, 1}, {"silent", 0, 0, 1},     {"wrong_inverse", 0, 0, 1}, {"tilted_pdf", 0, 0, 1},
    {"hole", 0, 0, 1},     {"slow", 0, 0, 1},
};
static const mc_parameter forgets[] = {{"forgets", 0, 0, 1}};
static const mc_parameter tilt[] = {{"tilt", 0, -90, 90}};
static const mc_parameter power[] = {{"power", 2, 0, 20}};
static const mc_sampler samplers[] = {
    {.name = "Cosine",
     .domain = MC_HEMISPHERE,
     .parameters = faults,
     .parameter_count = slow + 1,
     .sample = sample,
     .pdf = pdf,
     .invert = invert,
     .eval = eval,
     .weight = weight},
    {.name = "Tail",
     .domain = MC_INTERVAL,
     .hi = {INFINITY},
     .scalar = MC_FLOAT,
     .sample = sample_tail,
     .pdf = pdf_tail},
    {.name = "Logistic",
     .domain = MC_INTERVAL,
     .lo = {-INFINITY},
     .hi = {INFINITY},
     .sample = sample_logistic,
     .pdf = pdf_logistic},
    {.name = "Below", .domain = MC_INTERVAL, .lo = {-INFINITY}, .hi = {5}, .sample = sample_below, .pdf = pdf_below},
    {.name = "Rejection", .domain = MC_DISK, .may_fail = 1, .sample = sample_rejection, .pdf = pdf_rejection},
    {.name = "Box",
     .domain = MC_BOX,
     .dim = 3,
     .lo = {-1},
     .hi = {1, 3, 1},
     .parameters = power,
     .parameter_count = 1,
     .create = create,
     .destroy = destroy,
     .sample = sample_box,
     .pdf = pdf_box},
    {.name = "Table",
     .domain = MC_DISCRETE,
     .hi = {3},
     .parameters = forgets,
     .parameter_count = 1,
     .sample = sample_table,
     .pdf = pdf_table},
    {.name = "Triangle", .domain = MC_TRIANGLE, .sample = sample_triangle, .pdf = pdf_triangle},
    {.name = "Halves",
     .domain = MC_SPHERE,
     .uniforms = 3,
     .parameters = tilt,
     .parameter_count = 1,
     .sample = sample_halves,
     .pdf = pdf_halves},
};

MC_PLUGIN(samplers)
