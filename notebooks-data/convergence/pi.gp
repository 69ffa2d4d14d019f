# gnuplot pi.gp writes pi.svg and pi.png
if (!exists("kind")) kind = "svg"
if (kind eq "svg") set terminal svg size 1000,440 font "sans-serif,13" background "white"; set output "pi.svg"
if (kind eq "png") set terminal pngcairo size 1000,440 font "sans-serif,11" background "white"; set output "pi.png"
set datafile separator ","
set border 3 lc rgb "#666666"
set tics nomirror out
set grid lc rgb "#e6e6e6" lt 1
set multiplot layout 1,2 title "pi by darts at a square" noenhanced font ",15"
set logscale xy
set format y "10^{%L}"
set key left bottom Left reverse samplen 2 spacing 1.2 tc rgb "#333333"
set ylabel "root-mean-square error"
set xlabel "samples N"
set format x "10^{%L}"
plot "pi.csv" skip 1 using (strcol(2) eq "random" ? $3 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#2160c2" notitle, \
     "pi.csv" skip 1 using (strcol(2) eq "random" ? $3 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#2160c2" title "random: N^{-0.49 ± 0.02}", \
     1.93862 * x**(-0.5) with lines dt 3 lw 1 lc rgb "#2160c2" notitle, \
     "pi.csv" skip 1 using (strcol(2) eq "stratified" ? $3 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#b73300" notitle, \
     "pi.csv" skip 1 using (strcol(2) eq "stratified" ? $3 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#b73300" title "stratified: N^{-0.74 ± 0.03}", \
     3.38461 * x**(-0.75) with lines dt 3 lw 1 lc rgb "#b73300" notitle, \
     "pi.csv" skip 1 using (strcol(2) eq "sobol" ? $3 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#15985d" notitle, \
     "pi.csv" skip 1 using (strcol(2) eq "sobol" ? $3 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#15985d" title "sobol: N^{-0.75 ± 0.02}", \
     2.19317 * x**(-0.75) with lines dt 3 lw 1 lc rgb "#15985d" notitle, \
     NaN notitle
set xlabel "CPU seconds"
set format x "10^{%L}"
plot "pi.csv" skip 1 using (strcol(2) eq "random" ? $7 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#2160c2" notitle, \
     "pi.csv" skip 1 using (strcol(2) eq "random" ? $7 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#2160c2" title "random", \
     "pi.csv" skip 1 using (strcol(2) eq "stratified" ? $7 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#b73300" notitle, \
     "pi.csv" skip 1 using (strcol(2) eq "stratified" ? $7 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#b73300" title "stratified", \
     "pi.csv" skip 1 using (strcol(2) eq "sobol" ? $7 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#15985d" notitle, \
     "pi.csv" skip 1 using (strcol(2) eq "sobol" ? $7 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#15985d" title "sobol", \
     NaN notitle
unset multiplot
