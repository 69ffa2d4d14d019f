#!/usr/bin/env bash
# From a clean clone: installs what is missing, builds, renders two Cornell boxes, validates every sampler, measures
# convergence, and collects it all in out/index.html.
set -eu
cd "$(dirname "$0")/.."
./tools/bootstrap.sh
cmake --preset release -DMC_BUILD_TESTS=OFF
cmake --build --preset release
carlo=build/release/tools/carlo
mkdir -p out

failed=0
# run NAME COMMAND...: shows and runs a command; keeps what it printed for the page.
run() {
  local name=$1
  shift
  echo "\$ $*"
  local status=0
  "$@" | tee "out/$name.txt" || status=$?
  [ "$status" -eq 0 ] || failed=1
  verdict[$name]=$([ "$status" -eq 0 ] && echo passed || echo "failed (exit $status)")
  command_line[$name]="${*/$carlo/carlo}"
}
declare -A verdict command_line
set -o pipefail

run cbox $carlo render librender/scenes/cbox.xml -o out/cbox.exr --size 256x256 --spp 256
run cbox_png $carlo render librender/scenes/cbox.xml -o out/cbox.png --size 512x512 --spp 64 --exposure 1
run glass $carlo render librender/scenes/book3-cornell-glass.xml -o out/cornell_glass.png --size 400x400 --spp 144
run validate $carlo validate --all --json out/validate.json --report out/validate
run converge $carlo converge pi -o out/convergence

escape() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'; }
section() { # TITLE NAME TEXT
  printf '<section><h2>%s</h2><p class="%s">%s</p><p>%s</p>' "$1" "${verdict[$2]%% *}" "${verdict[$2]}" "$3"
  printf '<pre>$ %s\n' "$(escape <<<"${command_line[$2]}")"
  tail -n 4 "out/$2.txt" | escape
  printf '</pre>'
}
{
  cat <<'HTML'
<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1">
<title>carlo: the demo</title>
<style>
body{font:16px/1.5 system-ui,sans-serif;max-width:56rem;margin:2rem auto;padding:0 1rem;color:#222;background:#fff}
h1{font-size:1.6rem}h2{font-size:1.2rem;margin:2.5rem 0 .3rem}
img{max-width:100%;height:auto;border-radius:4px}pre{background:#f4f4f4;padding:.7rem;overflow-x:auto;font-size:.8rem}
.passed{color:#17693a;font-weight:600;margin:0}.failed{color:#b00020;font-weight:600;margin:0}
</style>
<h1>carlo: rendered, validated, measured</h1>
<p>Everything below was made on this machine by <code>tools/demo.sh</code>.</p>
HTML
  section "Cornell box" cbox_png "The scene file that came with lajolla and Mitsuba, path traced with next event estimation and multiple importance sampling. cbox.exr beside it carries the variance of every pixel."
  printf '<img src="cbox.png" alt="Cornell box" width="512"></section>'
  section "Glass sphere in a Cornell box" glass "The closing picture of Ray Tracing: The Rest of Your Life, with light let through the glass."
  printf '<img src="cornell_glass.png" alt="Cornell box with a glass sphere"></section>'
  section "Every sampler obeys its laws" validate "Chi-square, Kolmogorov-Smirnov, mass, Jacobian, inverse and 50-digit oracle, under one family-wise error rate. <a href=\"validate/index.html\">Maps and curves of every case</a>."
  printf '</section>'
  section "Random against stratified" converge "Root-mean-square error of pi by darts. Stratified samples converge as N<sup>-3/4</sup>, random ones as N<sup>-1/2</sup>."
  printf '<img src="convergence/pi.svg" alt="RMS error against N"></section></html>'
} > out/index.html.tmp
mv out/index.html.tmp out/index.html
echo
echo "The pictures, the plot and the verdicts: $PWD/out/index.html"
exit $failed
