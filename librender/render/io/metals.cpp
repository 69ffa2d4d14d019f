#include <render/io/metals.h>

#include <render/io/spectrum.h>

#include <mc/core/error.h>
#include <mc/core/text.h>

#include <algorithm>
#include <span>

namespace render {

namespace {

struct Sample {
  double wavelength, eta, k; // [nm]
};

// Silver: [JohnsonChristy72].
constexpr Sample silver[] = {{397.4, 0.05, 2.07},  {413.3, 0.05, 2.275}, {430.5, 0.04, 2.462}, {450.9, 0.04, 2.657},
                             {471.4, 0.05, 2.869}, {495.9, 0.05, 3.093}, {520.9, 0.05, 3.324}, {548.6, 0.06, 3.586},
                             {582.1, 0.05, 3.858}, {616.8, 0.06, 4.152}, {659.5, 0.05, 4.483}, {704.5, 0.04, 4.838}};
// Aluminium: [Rakic95].
constexpr Sample aluminium[] = {{364.66, 0.39877, 4.3957}, {413.28, 0.52135, 5.0008}, {442.8, 0.6079, 5.3676},
                                {476.87, 0.7278, 5.7781},  {516.6, 0.8734, 6.2418},   {563.57, 1.0728, 6.7839},
                                {619.93, 1.366, 7.4052},   {652.25, 1.5724, 7.7354},  {688.81, 1.8301, 8.0601},
                                {729.32, 2.1606, 8.3565}};
// Gold: [JohnsonChristy72].
constexpr Sample gold[] = {{397.4, 1.47, 1.952}, {413.3, 1.46, 1.958}, {430.5, 1.45, 1.948}, {450.9, 1.38, 1.914},
                           {471.4, 1.31, 1.849}, {495.9, 1.04, 1.833}, {520.9, 0.62, 2.081}, {548.6, 0.43, 2.455},
                           {582.1, 0.29, 2.863}, {616.8, 0.21, 3.272}, {659.5, 0.14, 3.697}, {704.5, 0.13, 4.103}};
// Beryllium: [RakicEtAl98], its Brendel-Bormann model; every third value.
constexpr Sample beryllium[] = {{397.42, 2.8678, 3.1388}, {431.91, 3.0138, 3.13},  {469.4, 3.137, 3.1241},
                                {510.15, 3.2381, 3.125},  {554.43, 3.318, 3.1362}, {602.55, 3.3772, 3.1606},
                                {654.85, 3.4161, 3.2013}, {711.7, 3.4348, 3.2614}};
// Chromium: [JohnsonChristy74].
constexpr Sample chromium[] = {{397, 2, 2.83},    {413, 2.08, 2.93}, {431, 2.19, 3.04}, {451, 2.33, 3.14},
                               {471, 2.51, 3.24}, {496, 2.75, 3.3},  {521, 2.94, 3.33}, {549, 3.18, 3.33},
                               {582, 3.22, 3.3},  {617, 3.17, 3.3},  {659, 3.09, 3.34}, {704, 3.05, 3.39}};
// Copper: [JohnsonChristy72].
constexpr Sample copper[] = {{397.4, 1.32, 2.116}, {413.3, 1.28, 2.207}, {430.5, 1.25, 2.305}, {450.9, 1.24, 2.397},
                             {471.4, 1.25, 2.483}, {495.9, 1.22, 2.564}, {520.9, 1.18, 2.608}, {548.6, 1.02, 2.577},
                             {582.1, 0.7, 2.704},  {616.8, 0.3, 3.205},  {659.5, 0.22, 3.747}, {704.5, 0.21, 4.205}};
// Mercury: [InagakiEtAl81], liquid.
constexpr Sample mercury[] = {{387.45, 0.79824, 3.29351}, {413.28, 0.898, 3.53785},  {442.8, 1.02698, 3.80193},
                              {476.86, 1.186, 4.08981},   {516.6, 1.38332, 4.40608}, {563.56, 1.62088, 4.7505},
                              {619.92, 1.90988, 5.14953}, {688.8, 2.28417, 5.58189}, {774.9, 2.74611, 6.05402}};
// Iridium: [SchmittEtAl22], sputtered film; every third value.
constexpr Sample iridium[] = {{398.1, 1.99, 3.993},  {427.8, 2.102, 4.217}, {457.5, 2.209, 4.447},
                              {487.2, 2.33, 4.678},  {517, 2.468, 4.896},   {546.7, 2.614, 5.094},
                              {576.4, 2.759, 5.269}, {606.1, 2.896, 5.422}, {635.8, 3.018, 5.561},
                              {665.5, 3.124, 5.692}, {695.2, 3.214, 5.82},  {705.2, 3.242, 5.863}};
// Potassium: [Smith69].
constexpr Sample potassium[] = {{364.981, 0.051887, 0.549265}, {404.648, 0.040668, 0.799158},
                                {420.001, 0.041221, 0.897607}, {439.972, 0.042618, 1.020694},
                                {469.993, 0.042573, 1.139216}, {505.027, 0.045694, 1.280269},
                                {545.945, 0.04921, 1.432628},  {599.827, 0.053102, 1.619512},
                                {661.955, 0.050023, 1.839158}, {750.056, 0.044219, 2.193617}};
// Lithium: [InagakiEtAl76].
constexpr Sample lithium[] = {{400, 0.273, 1.78}, {413, 0.263, 1.84}, {428, 0.255, 1.9},  {443, 0.244, 1.99},
                              {459, 0.235, 2.08}, {477, 0.225, 2.19}, {496, 0.214, 2.33}, {517, 0.209, 2.43},
                              {539, 0.202, 2.58}, {564, 0.199, 2.69}, {590, 0.194, 2.86}, {620, 0.191, 3.04},
                              {653, 0.19, 3.22},  {689, 0.191, 3.42}, {729, 0.194, 3.62}};
// Molybdenum: [KirillovaEtAl71].
constexpr Sample molybdenum[] = {{365, 2.65, 3.5},  {404, 2.66, 3.41}, {425, 2.71, 3.41}, {450, 2.84, 3.51},
                                 {475, 2.95, 3.64}, {500, 3.15, 3.73}, {525, 3.22, 3.74}, {550, 3.47, 3.56},
                                 {575, 3.42, 3.55}, {600, 3.38, 3.56}, {650, 3.45, 3.67}, {675, 3.47, 3.74},
                                 {700, 3.48, 3.7}};
// Sodium: [InagakiEtAl76].
constexpr Sample sodium[] = {{400, 0.0794, 1.5},  {413, 0.0812, 1.56}, {428, 0.0815, 1.64}, {443, 0.0791, 1.71},
                             {459, 0.0745, 1.8},  {477, 0.0689, 1.88}, {496, 0.064, 1.99},  {517, 0.0587, 2.1},
                             {539, 0.0539, 2.23}, {564, 0.0495, 2.36}, {590, 0.0464, 2.48}, {620, 0.0442, 2.62},
                             {653, 0.0424, 2.78}, {689, 0.0418, 2.96}, {729, 0.0418, 3.15}};
// Niobium: [WeaverEtAl73], read from a figure.
constexpr Sample niobium[] = {
    {384.5, 2.528, 2.517}, {405, 2.528, 2.634},   {417.6, 2.541, 2.703}, {425.2, 2.559, 2.736},
    {429.2, 2.569, 2.751}, {441.5, 2.608, 2.795}, {466.1, 2.692, 2.861}, {488.2, 2.768, 2.891},
    {517.8, 2.856, 2.894}, {538.6, 2.905, 2.879}, {553.2, 2.925, 2.869}, {570, 2.933, 2.861},
    {576.2, 2.932, 2.86},  {639.1, 2.879, 2.843}, {676, 2.811, 2.856},   {702.9, 2.7, 2.93}};
// Nickel: [JohnsonChristy74].
constexpr Sample nickel[] = {{397, 1.72, 2.57}, {413, 1.7, 2.69},  {431, 1.71, 2.82}, {451, 1.73, 2.95},
                             {471, 1.78, 3.09}, {496, 1.82, 3.25}, {521, 1.85, 3.42}, {549, 1.92, 3.61},
                             {582, 1.96, 3.8},  {617, 1.99, 4.02}, {659, 1.99, 4.26}, {704, 2.06, 4.5}};
// Rhodium: [WeaverEtAl77], as tabulated in [Palik85].
constexpr Sample rhodium[] = {{400, 1.41, 4.2},    {413.3, 1.53, 4.29}, {427.5, 1.63, 4.36}, {459.2, 1.8, 4.49},
                              {476.9, 1.85, 4.55}, {495.9, 1.88, 4.65}, {516.6, 1.9, 4.78},  {539.1, 1.94, 4.94},
                              {563.6, 2, 5.11},    {590.4, 2.05, 5.3},  {619.9, 2.12, 5.51}, {652.6, 2.2, 5.76},
                              {688.8, 2.3, 6.02},  {729.3, 2.42, 6.33}};
// Vanadium: [JohnsonChristy74].
constexpr Sample vanadium[] = {{397, 3.07, 3.48}, {413, 3.31, 3.49}, {431, 3.52, 3.49}, {451, 3.59, 3.46},
                               {471, 3.81, 3.38}, {496, 3.92, 3.26}, {521, 3.86, 3.18}, {549, 4, 3.04},
                               {582, 3.83, 3},    {617, 3.54, 3.02}, {659, 3.25, 3.09}, {704, 3.18, 3.15}};
// Tungsten: [WeaverEtAl75], read from a figure; every second value.
constexpr Sample tungsten[] = {
    {393, 3.438, 2.449},  {411.5, 3.379, 2.416}, {425.3, 3.346, 2.439}, {442.6, 3.317, 2.489}, {465, 3.325, 2.574},
    {492.1, 3.38, 2.664}, {511.1, 3.433, 2.7},   {532.7, 3.497, 2.719}, {570.5, 3.524, 2.787}, {599.7, 3.557, 2.86},
    {626, 3.607, 2.906},  {646, 3.657, 2.925},   {657.2, 3.697, 2.943}, {680.8, 3.797, 2.914}, {700.8, 3.871, 2.879}};

struct NamedMetal {
  std::string_view name;
  std::span<const Sample> samples;
};

constexpr NamedMetal metals[] = {
    {"Ag", silver},       {"Al", aluminium}, {"Au", gold},         {"Be", beryllium},     {"Cr", chromium},
    {"Cu", copper},       {"Hg", mercury},   {"Ir", iridium},      {"K", potassium},      {"Li", lithium},
    {"Mo", molybdenum},   {"Na", sodium},    {"Na_palik", sodium}, {"Nb", niobium},       {"Ni", nickel},
    {"Ni_palik", nickel}, {"Rh", rhodium},   {"V", vanadium},      {"V_palik", vanadium}, {"W", tungsten},
};

// Names that Mitsuba has and that this table leaves out.
constexpr std::string_view others[] = {"a-C", "AlAs", "AlSb", "CsI", "Cu2O", "CuO", "d-C", "HgTe", "MgO", "Se",
                                       "SiC", "SnTe", "Ta",   "Te",  "ThF4", "TiC", "TiN", "TiO2", "VC",  "VN"};

Spectrum colour_of(const NamedMetal& metal, double Sample::*value) {
  std::vector<SpectralSample> samples;
  for (const Sample& s : metal.samples) samples.push_back({s.wavelength, s.*value});
  return spectrum_to_rgb(samples).max(0);
}

} // namespace

std::vector<std::string_view> metal_names() {
  std::vector<std::string_view> names;
  for (const NamedMetal& metal : metals) names.push_back(metal.name);
  return names;
}

OpticalConstants metal_constants(std::string_view name) {
  for (const NamedMetal& metal : metals)
    if (metal.name == name) return {colour_of(metal, &Sample::eta), colour_of(metal, &Sample::k)};
  const auto names = metal_names();
  mc::require(std::find(std::begin(others), std::end(others), name) == std::end(others),
              "material '{}' is not in the table of metals; give its eta and k instead", name);
  throw mc::Error(fmt::format("material '{}' is not known{}; give eta and k, none, or one of {}", name,
                              mc::did_you_mean(name, names), fmt::join(names, ", ")));
}

} // namespace render
