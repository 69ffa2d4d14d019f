// A plugin in C++ with one flaw, which a macro selects; without a macro it is correct.
#include <mc/check/plugin.h>

#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <stdexcept>

void nobody_defines_this();

namespace {

std::int32_t sample(const void*, const double* u, double* x) {
#if defined(FLAW_throws)
  if (u[0] > 0.5) throw std::runtime_error("no square root today");
#elif defined(FLAW_greedy)
  static char* volatile taken; // the compiler may remove an unused allocation
  for (;;) taken = new char[1 << 28];
#elif defined(FLAW_files)
  while (dup(2) >= 0) {
  }
  throw std::runtime_error("no descriptor is left");
#elif defined(FLAW_family)
  // A grandchild in its own session that would outlive the other processes. Its id is written to the file that the test
  // reads, and the parent continues after that.
  static bool born = false;
  int written[2];
  if (!born && pipe(written) == 0) {
    if (fork() == 0) {
      setsid();
      if (fork() == 0) {
        FILE* out = fopen(getenv("FAMILY_FILE"), "w");
        fprintf(out, "%d\n", static_cast<int>(getpid()));
        fclose(out);
        if (write(written[1], "", 1) != 1) _exit(1);
        for (;;) pause();
      }
      _exit(0);
    }
    char one;
    if (read(written[0], &one, 1) != 1) throw std::runtime_error("no grandchild");
  }
  born = true;
#elif defined(FLAW_undefined)
  nobody_defines_this();
#elif defined(FLAW_undeclared)
  x[0] = u[0];
  return 255;
#endif
  x[0] = u[0];
  return 1;
}
double pdf(const void*, const double*) { return 1; }

mc_sampler uniform() {
  mc_sampler s{};
  s.name = "Uniform";
  s.domain = MC_INTERVAL;
  s.sample = sample;
  s.pdf = pdf;
#if defined(FLAW_no_pdf)
  s.pdf = nullptr;
#elif defined(FLAW_unknown_domain)
  s.domain = 9;
#elif defined(FLAW_crash_on_load)
  std::abort();
#elif defined(FLAW_hang_on_load)
  for (volatile bool hangs = true; hangs;) {
  }
#elif defined(FLAW_no_name)
  s.name = "a b";
#elif defined(FLAW_weight_alone)
  s.weight = [](const void*, const double*, const double*) { return 1.0; };
#elif defined(FLAW_first_version)
  s.parts = reinterpret_cast<const char*>(1);
  s.outcomes = -1;
#elif defined(FLAW_no_parts)
  s.domain = MC_PRODUCT;
#elif defined(FLAW_bad_parts)
  s.domain = MC_PRODUCT;
  s.parts = "sphere,dsk";
#elif defined(FLAW_wide_parts)
  s.domain = MC_PRODUCT;
  s.parts = "sphere,disk";
#elif defined(FLAW_no_probability)
  s.outcomes = 2;
#elif defined(FLAW_reversed)
  s.lo[0] = 2;
  s.hi[0] = 1;
#endif
  return s;
}

const mc_sampler samplers[] = {uniform()};

} // namespace

#if defined(FLAW_wrong_abi)
extern "C" const mc_plugin_info* mc_plugin() {
  static const mc_plugin_info info = {77, sizeof(mc_sampler), 1, samplers};
  return &info;
}
#elif defined(FLAW_wrong_size)
extern "C" const mc_plugin_info* mc_plugin() {
  static const mc_plugin_info info = {MC_PLUGIN_ABI, 8, 1, samplers};
  return &info;
}
#elif defined(FLAW_first_version)
// A plugin compiled before the structs grew: the bytes after the old fields do not belong to the struct.
extern "C" const mc_plugin_info* mc_plugin() {
  static mc_plugin_info info = {1, offsetof(mc_sampler, parts), 1, samplers, 77, 77, nullptr};
  return &info;
}
#elif defined(FLAW_second_version)
// An integrand compiled before the struct grew.
static double linear(const double* x) { return x[0]; }
extern "C" const mc_plugin_info* mc_plugin() {
  static mc_integrand integrand = {};
  integrand.name = "Old";
  integrand.dim = 1;
  integrand.eval = linear;
  integrand.outputs = 99;
  integrand.uniforms = -1;
  static mc_plugin_info info = {
      2, offsetof(mc_sampler, sample_stream), 0, nullptr, offsetof(mc_integrand, outputs), 1, &integrand};
  return &info;
}
#elif !defined(FLAW_no_entry)
MC_PLUGIN(samplers)
#endif
