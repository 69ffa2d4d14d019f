/* Correct samplers; a parameter turns on each fault. */
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

/* Samples with density 1 / (x + 1)^2 on the half line, computed in float and stored in doubles. */
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

/* A narrow logistic distribution far from 0, and its mirrored half. */
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

/* A three-dimensional box; create() builds its state from the parameter. */
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

/* Three outcomes with probabilities 0, 3/4 and 1/4. With `forgets`, u = 0 returns the first. */
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

/* Uses three uniform numbers for two dimensions: the first selects a half of the sphere, the others a point on it. The
   parameter rotates the samples, but not the pdf, about x [degrees]. */
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

/* Four samplers: uniform in the ball, uniform in an annulus, normal in the plane, and a cosine lobe times an exponential
   on [0, inf). With `wrong` the density belongs to another sampler. */
static int wrong(const void* self) { return *(const double*)self != 0; }
static void polar(double r, double u, double* x) {
  x[0] = r * cos(2 * pi * u);
  x[1] = r * sin(2 * pi * u);
}
static int32_t sample_ball(const void* self, const double* u, double* x) {
  const double r = cbrt(u[2]), z = 1 - 2 * u[0];
  (void)self;
  polar(r * sqrt(1 - z * z), u[1], x);
  x[2] = r * z;
  return MC_POINT;
}
static double pdf_ball(const void* self, const double* x) {
  return wrong(self) ? 1 / (2 * pi * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2])) / 2 : 0.75 / pi;
}
static int32_t sample_annulus(const void* self, const double* u, double* x) {
  (void)self;
  polar(sqrt(0.25 + 0.75 * u[0]), u[1], x);
  return MC_POINT;
}
static double pdf_annulus(const void* self, const double* x) {
  return wrong(self) ? 1 / (pi * hypot(x[0], x[1])) : 1 / (0.75 * pi);
}
static int32_t sample_plane(const void* self, const double* u, double* x) {
  (void)self;
  polar(sqrt(-2 * log(1 - u[0])), u[1], x);
  return MC_POINT;
}
static double pdf_plane(const void* self, const double* x) {
  const double s = wrong(self) ? 1.1 : 1;
  return exp(-(x[0] * x[0] + x[1] * x[1]) / (2 * s)) / (2 * pi * s);
}
static int32_t sample_flight(const void* self, const double* u, double* x) {
  (void)self;
  polar(sqrt(u[0]), u[1], x);
  x[2] = sqrt(1 - u[0]);
  x[3] = -log(1 - u[2]);
  return MC_POINT;
}
static double pdf_flight(const void* self, const double* x) {
  return x[2] < 0 ? 0 : wrong(self) ? x[2] / pi * 1.1 * exp(-1.1 * x[3]) : x[2] / pi * exp(-x[3]);
}

/* Two mirror directions with probabilities 0.3 and 0.1, and a cosine lobe. */
static int32_t sample_glossy(const void* self, const double* u, double* x) {
  (void)self;
  if (u[2] < 0.3) return MC_OUTCOME;
  if (u[2] < 0.4) return MC_OUTCOME + 1;
  polar(sqrt(u[0]), u[1], x);
  x[2] = sqrt(1 - u[0]);
  return MC_POINT;
}
static double pdf_glossy(const void* self, const double* x) {
  (void)self;
  return x[2] > 0 ? 0.6 * x[2] / pi : 0;
}
static double probability_glossy(const void* self, int32_t k) {
  return k == 0 ? (wrong(self) ? 0.29 : 0.3) : wrong(self) ? 0.11 : 0.1;
}

/* A density with four steps: 0.4, 1.6, 0.4 and 1.6. */
static int32_t sample_steps(const void* self, const double* u, double* x) {
  const double half = floor(2 * u[0]), rest = 2 * u[0] - half;
  (void)self;
  x[0] = (half + (rest < 0.2 ? 0.5 * rest / 0.2 : 0.5 + 0.5 * (rest - 0.2) / 0.8)) / 2;
  return MC_POINT;
}
static double pdf_steps(const void* self, const double* x) {
  return fmod(4 * x[0], 2) < 1 ? (wrong(self) ? 0.5 : 0.4) : (wrong(self) ? 1.5 : 1.6);
}
static int32_t breaks_of_steps(const void* self, int32_t axis, const double** places) {
  static const double quarters[] = {0.25, 0.5, 0.75};
  (void)self, (void)axis;
  *places = quarters;
  return 3;
}

/* Fails at u = 0, where the sample is infinite. */
static int32_t sample_open(const void* self, const double* u, double* x) {
  (void)self;
  x[0] = -log(u[0]);
  return MC_POINT;
}
static double pdf_open(const void* self, const double* x) {
  (void)self;
  return x[0] >= 0 ? exp(-x[0]) : 0;
}

/* The unit disk by rejection. */
static int32_t sample_by_rejection(const void* self, double (*next)(void*), void* source, double* x) {
  const double limit = *(const double*)self != 0 ? 0.81 : 1;
  do {
    x[0] = 2 * next(source) - 1;
    x[1] = 2 * next(source) - 1;
  } while (x[0] * x[0] + x[1] * x[1] > limit);
  return MC_POINT;
}
static double pdf_by_rejection(const void* self, const double* x) {
  (void)self;
  return x[0] * x[0] + x[1] * x[1] <= 1 ? 0.31830988618379067 : 0;
}

/* x^(n - 1) n on the unit interval. */
static int32_t sample_power(const void* self, const double* u, double* x) {
  x[0] = pow(u[0], 1 / *(const double*)self);
  return MC_POINT;
}
static double pdf_power(const void* self, const double* x) {
  const double n = *(const double*)self;
  return n * pow(x[0], n - 1);
}

static const mc_parameter exponent[] = {{"n", 2, 1, 1000}};
static const mc_parameter faults[] = {
    {"pdf_high", 0, 0, 1}, {"weight_low", 0, 0, 1}, {"nan_sample", 0, 0, 1},    {"nan_pdf", 0, 0, 1},
    {"crash", 0, 0, 1},    {"hang", 0, 0, 1},       {"quit", 0, 0, 1},          {"leak", 0, 0, 1},
    {"not_unit", 0, 0, 1}, {"silent", 0, 0, 1},     {"wrong_inverse", 0, 0, 1}, {"tilted_pdf", 0, 0, 1},
    {"hole", 0, 0, 1},     {"slow", 0, 0, 1},
};
static const mc_parameter another[] = {{"wrong", 0, 0, 1}};
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
    {.name = "Ball",
     .domain = MC_PRODUCT,
     .parts = "ball",
     .parameters = another,
     .parameter_count = 1,
     .sample = sample_ball,
     .pdf = pdf_ball},
    {.name = "Annulus",
     .domain = MC_PRODUCT,
     .parts = "annulus=0.5",
     .parameters = another,
     .parameter_count = 1,
     .sample = sample_annulus,
     .pdf = pdf_annulus},
    {.name = "Plane",
     .domain = MC_PRODUCT,
     .parts = "x=-inf:inf,y=-inf:inf",
     .parameters = another,
     .parameter_count = 1,
     .sample = sample_plane,
     .pdf = pdf_plane},
    {.name = "Flight",
     .domain = MC_PRODUCT,
     .parts = "sphere,t=0:inf",
     .parameters = another,
     .parameter_count = 1,
     .sample = sample_flight,
     .pdf = pdf_flight},
    {.name = "Glossy",
     .domain = MC_HEMISPHERE,
     .uniforms = 3,
     .outcomes = 2,
     .parameters = another,
     .parameter_count = 1,
     .sample = sample_glossy,
     .pdf = pdf_glossy,
     .probability = probability_glossy},
    {.name = "Steps",
     .domain = MC_INTERVAL,
     .parameters = another,
     .parameter_count = 1,
     .sample = sample_steps,
     .pdf = pdf_steps,
     .breaks = breaks_of_steps},
    {.name = "Open",
     .domain = MC_INTERVAL,
     .hi = {INFINITY},
     .open_interval = 1,
     .sample = sample_open,
     .pdf = pdf_open},
    {.name = "Stream",
     .domain = MC_DISK,
     .parameters = another,
     .parameter_count = 1,
     .pdf = pdf_by_rejection,
     .sample_stream = sample_by_rejection},
    {.name = "Power",
     .domain = MC_INTERVAL,
     .parameters = exponent,
     .parameter_count = 1,
     .sample = sample_power,
     .pdf = pdf_power},
};

MC_PLUGIN(samplers)
