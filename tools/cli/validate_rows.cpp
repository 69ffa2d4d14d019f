/// The options of carlo validate and the texts of its help.

#include <cli/validate.h>

namespace carlo {

namespace {

// The options of samples from a file.
std::vector<Option> samples_rows(ValidateCommandOptions& o) {
  const Exclusion given{"--samples", "every sample of the file counts"};
  return {
      input_file({"--samples-file",
                  "FILE",
                  &o.samples_file,
                  "Check the samples of this file against a density from --pdf or --pdf-file.",
                  false,
                  {given}}),
      {"--pdf", "EXPRESSION", &o.pdf, "Density in the variables of --domain: \"exp(-x*x/2)/sqrt(2*_pi)\"."},
      input_file({"--pdf-file", "FILE", &o.pdf_file, "Density on a grid: .csv, .exr or .pfm."}),
      {"--domain", "DOMAIN", &o.domain,
       "Domain of the samples, or of --command. Default: 0:1 for each of 1 or 2 columns, sphere for 3."},
      {"--breaks", "AXIS=PLACES,...", &o.breaks,
       "Places where the density of --pdf or --command jumps, by axis of the domain: \"x=0.25,0.5\", "
       "\"r=0.5\", \"theta=0:90:15\" in degrees. A density that is constant between them is integrated "
       "exactly."},
      {"--log-density", "", &o.log_density,
       "The expression of --pdf is the natural logarithm of the density, and so is the answer of --command to "
       "\"pdf\"."},
      {"--unnormalized", "", &o.unnormalized, "The density is known up to a factor only."},
      {"--thin", "auto|K", &o.thin,
       "The rows are states of a Markov chain: keep each K-th, or as many as are nearly independent by the "
       "autocorrelation time. The output states it."},
      {"--dependent", "", &o.dependent,
       "Accept rows that depend on each other, such as a point set. Default: the order of the rows and the "
       "evenness of the counts are tested, too."},
  };
}

} // namespace

std::vector<Option> validate_rows(ValidateCommandOptions& o) {
  const Exclusion counted{"--samples", "--detect computes the number of samples"};
  std::vector<Option> expert = {
      {"--open-interval", "", &o.open_interval,
       "Accept failures where u is exactly 0, or at another single point of u, and samples on the very edge of the "
       "domain."},
      {"--scalar", "TYPE", &o.scalar, "Check float or double alone. Default: both."},
      {"--threads", "N", &o.threads, "Threads; 0 is all processors."},
      state_file({"-o,--output", "FILE", &o.output, "File of --part, such as part3.ckpt."}),
      output_file({"--junit", "FILE", &o.junit, "Write the results to this file as JUnit XML; - is standard output."}),
      resume_row(o.checkpoint),
  };
  const std::vector<Option> files = checkpoint_rows(o.checkpoint);
  expert.insert(expert.end(), files.begin(), files.end());
  return in_groups({
      {common_options,
       {
           {"NAME", "", &o.names, "Distributions to check, by name, or single cases; see --list."},
           {"--all", "", &o.all, "Check every distribution of libmc and librender."},
           {"--list", "", &o.list,
            "List the distributions with a sentence each, and stop. With a NAME: list the cases of that distribution."},
           {"--samples", "N", &o.samples, "Samples per case, at least 1000."},
           {"--detect",
            "RATIO",
            &o.detect,
            "Choose the number of samples that catches this relative error of a density with probability 0.99: 0.003 "
            "is 0.3 %. In [0.0001, 1]. From 1e7 samples on, looks of 1e6, 1e7, ... samples come first, each with 5 % "
            "of alpha: a wrong distribution ends the check there, and Ctrl-C keeps the last look.",
            false,
            {counted}},
           {"--verbose", "", &o.verbose,
            "Print every check that does not pass, and the worst cells. Default: the finding and its likely cause."},
           {"--alpha", "PROBABILITY", &o.alpha,
            "Probability of rejecting a correct distribution, over all tests of the run together."},
           {"--seed", "N", &o.seed, "Seed of the random numbers. The same seed gives the same verdicts."},
           output_file({"--json", "FILE", &o.json, "Write the results to this file; - is standard output."}),
           output_folder({"--report", "FOLDER", &o.report,
                          "Write a page with maps and curves of every case to this folder (index.html)."},
                         {"index.html"}),
       }},
      {"Your own code",
       {
           input_file({"--plugin", "FILE", &o.plugin,
                       "Check the distributions of this shared object, compiled against <mc/check/plugin.h>."}),
           {"--params", "NAME=VALUE,...", &o.parameters,
            "Parameters of the plugin's distributions: \"alpha=0.1,n=3\", a list \"alpha=0.1,0.2\", or a range "
            "\"alpha=0.1:0.5:0.1\" with both ends. Each --params makes one case or more."},
           {"--random-params", "N", &o.random_parameters,
            "N cases of each distribution of the plugin, with random values of the parameters that --params leaves "
            "out: uniform in their ranges, or log-uniform for 0 < lo <= hi/100. 0: their default values."},
           {"--command", "PROGRAM", &o.sampler_command,
            "Check the distribution of this program, which answers over pipes: \"python3 mine.py\". Needs --domain."},
           {"--uniforms", "N", &o.uniforms,
            "Random numbers that one sample of --command takes; own: it draws its own from a seed, as a rejection "
            "sampler does. Default: the dimensions of --domain."},
           {"--timeout", "SECONDS", &o.timeout,
            "Wall-clock time for a case of a plugin or program. Default: 60, and 10 more per million samples of "
            "--detect."},
           {"--memory", "GIB", &o.memory, "Memory for a plugin or program, in GiB. Default: 4."},
       }},
      {"Your own samples", samples_rows(o)},
      {expert_options, expert},
  });
}

namespace {

std::vector<HelpSection> validate_sections() {
  return {
      {"Columns of the table",
       {
           {"cell",
            "The checker divides the domain into cells, at most 4096, of about the same probability, and counts the "
            "samples in each."},
           {"detects",
            "The smallest relative error of the density that this run catches with probability 0.99, where the error "
            "covers the whole domain: the density is too high or too low by this ratio, at random, in each compact "
            "patch of four cells or more."},
           {"in a cell",
            "The same where the density is wrong in a single patch of four cells and right everywhere else."},
           {"example",
            "\"detects 3.8 %, in a cell 61 %\" at a million samples: a density that is wrong by 3.8 % all over fails. "
            "A density that is wrong in one patch, with a thousandth of the samples, fails where it is wrong by 61 % "
            "there. Four times the samples about halve both."},
           {"ns/sample", "Time of one sample in nanoseconds."},
       }},
      {"Formats",
       {
           {"--samples-file",
            "One sample a row, numbers separated by commas or blanks. # begins a comment; a first row of names is "
            "skipped."},
           {"--domain",
            "Parts separated by commas, in the order of the columns, of at most six columns: NAME=LO:HI, also "
            "-inf and inf; disk or annulus=INNER (x, y); triangle (x, y >= 0, x + y <= 1); ball, sphere or hemisphere "
            "(x, y, z; unit vectors to 1e-5); rotation (x, y, z, w; unit quaternions, of which q and -q are the same; "
            "the uniform density is 1/_pi^2). Or discrete=N: outcomes 0 to N-1 (i), with probabilities from --pdf or "
            "from the numbers of --pdf-file; also discrete=LO:HI with -inf or inf. Or outcome=N before the other "
            "parts: a first column outcome is 0 to N-1 for a discrete outcome, whose other numbers do not count, and "
            "-1 for a point. --pdf then is the probability of an outcome or the density of a point: "
            "\"outcome<0 ? 0.7*2*x : 0.3\" on outcome=1,x=0:1."},
           {"--pdf", "An expression of muParser with _pi and _e, per length, area, volume or solid angle."},
           {"--pdf-file",
            "W numbers in each of H rows, on x=LO:HI, on x=LO:HI,y=LO:HI or on the sphere. Cell (column i, row j) "
            "contains the mean density over x in lo + (hi-lo) [i,i+1]/W and y in lo + (hi-lo) [j,j+1]/H; the first row "
            "has the least y. An interval has one row. On the sphere: azimuth 2 pi [i,i+1]/W from +x toward +y, angle "
            "pi [j,j+1]/H from +z, per steradian. An image is grey (R = G = B), top row first. The integral is 1 to "
            "1e-4, or any with --unnormalized."},
           {"--command",
            "carlo writes questions to the program's input: \"sample N K\\n\" with N K doubles u, and \"pdf N C\\n\" "
            "with N C doubles x. The program writes N C doubles x or N densities, "
            "little-endian, and flushes. With --uniforms own the first question is \"draw N 1\\n\" with N seeds, "
            "whole numbers below 2^53."},
       }},
  };
}

} // namespace

About validate_about() {
  return {.name = "validate",
          .summary = "Check that distributions draw the samples their densities claim, with laws and statistical tests",
          .examples = {{"carlo validate CosineHemisphere", "checks one distribution over float and double"},
                       {"carlo validate --all --detect 0.01 --report out",
                        "checks all of them for errors of 1 %, and writes a page"},
                       {"carlo validate --samples-file s.csv --pdf \"2*x\"",
                        "compares the samples of a file with a density on [0, 1]"}},
          .failure = "a distribution failed, or a test was inconclusive",
          .sections = validate_sections()};
}

} // namespace carlo
