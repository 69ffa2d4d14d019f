# gnuplot power.gp: the share of faults.csv that was caught, by kind and size, in steps of a factor of 1.6
if (!exists("kind")) kind = "svg"
if (kind eq "svg") set terminal svg size 900,620 font "sans,11"; else set terminal pngcairo size 900,620 font "sans,9"
set output "power.".kind
set datafile separator ","
set logscale x
set format x "10^{%L}"
set yrange [-0.05:1.05]
set key off
set grid
bin(x) = exp((floor(log(x) / log(1.6)) + 0.5) * log(1.6))
of(k) = sprintf("< grep -F ',%s,' faults.csv", k)
set multiplot layout 3,3 title "share of random faults caught at alpha 1 %, 1e5 samples"
do for [k in "'random signs' 'one region' wave exponent tilt correlation gap spike mass"] {
  set title k
  plot of(k) using (bin($3)):(strcol(5) eq "fail" ? 1 : 0) smooth unique with linespoints pt 7 lw 2
}
unset multiplot
