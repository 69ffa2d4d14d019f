# gnuplot plain.gp: how often the checker and the best plain test of plain.csv find a fault, by kind and size
if (!exists("kind")) kind = "svg"
if (kind eq "svg") set terminal svg size 900,620 font "sans,11"; else set terminal pngcairo size 900,620 font "sans,9"
set output "plain.".kind
set datafile separator ","
set logscale x
set format x "10^{%L}"
set yrange [-0.05:1.05]
set key bottom right
set grid
bin(x) = exp((floor(log(x) / log(2)) + 0.5) * log(2))
of(k) = sprintf("< grep -F ',%s,' plain.csv", k)
max(a, b) = a > b ? a : b
set multiplot layout 3,3 title "share of random faults found at alpha 1 %, 1e5 samples"
do for [k in "'random signs' 'one region' wave exponent tilt correlation gap spike 'one offset for two axes'"] {
  set title k
  plot of(k) using (bin($3)):4 smooth unique with linespoints pt 7 lw 2 lc rgb "#0072b2" title "checker", \
       of(k) using (bin($3)):(max(max(max($5, $6), max($7, $8)), max(max($9, $10), max($11, $12)))) smooth unique \
         with linespoints pt 4 dt 2 lc rgb "#d55e00" title "best plain test"
  set key off
}
unset multiplot
