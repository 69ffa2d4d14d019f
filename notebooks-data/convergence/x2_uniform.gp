# gnuplot x2_uniform.gp writes x2_uniform.svg and x2_uniform.png
if (!exists("kind")) kind = "svg"
if (kind eq "svg") set terminal svg size 1000,440 font "sans-serif,13" background "white"; set output "x2_uniform.svg"
if (kind eq "png") set terminal pngcairo size 1000,440 font "sans-serif,11" background "white"; set output "x2_uniform.png"
set datafile separator ","
set border 3 lc rgb "#666666"
set tics nomirror out
set grid lc rgb "#e6e6e6" lt 1
set multiplot layout 1,2 title "x^2 on [0,2], uniform density" noenhanced font ",15"
set logscale xy
set format y "10^{%L}"
set key left bottom Left reverse samplen 2 spacing 1.2 tc rgb "#333333"
set ylabel "root-mean-square error"
set xlabel "samples N"
set format x "10^{%L}"
plot "x2_uniform.csv" skip 1 using (strcol(2) eq "random" ? $3 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#2160c2" notitle, \
     "x2_uniform.csv" skip 1 using (strcol(2) eq "random" ? $3 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#2160c2" title "random: N^{-0.50 ± 0.02}", \
     2.47418 * x**(-0.5) with lines dt 3 lw 1 lc rgb "#2160c2" notitle, \
     "x2_uniform.csv" skip 1 using (strcol(2) eq "stratified" ? $3 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#b73300" notitle, \
     "x2_uniform.csv" skip 1 using (strcol(2) eq "stratified" ? $3 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#b73300" title "stratified: N^{-1.50 ± 0.02}", \
     2.82848 * x**(-1.5) with lines dt 3 lw 1 lc rgb "#b73300" notitle, \
     "x2_uniform.csv" skip 1 using (strcol(2) eq "sobol" ? $3 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#15985d" notitle, \
     "x2_uniform.csv" skip 1 using (strcol(2) eq "sobol" ? $3 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#15985d" title "sobol: N^{-1.50 ± 0.02}", \
     2.53101 * x**(-1.5) with lines dt 3 lw 1 lc rgb "#15985d" notitle, \
     NaN notitle
set xlabel "CPU seconds"
set format x "10^{%L}"
plot "x2_uniform.csv" skip 1 using (strcol(2) eq "random" ? $7 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#2160c2" notitle, \
     "x2_uniform.csv" skip 1 using (strcol(2) eq "random" ? $7 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#2160c2" title "random", \
     "x2_uniform.csv" skip 1 using (strcol(2) eq "stratified" ? $7 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#b73300" notitle, \
     "x2_uniform.csv" skip 1 using (strcol(2) eq "stratified" ? $7 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#b73300" title "stratified", \
     "x2_uniform.csv" skip 1 using (strcol(2) eq "sobol" ? $7 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#15985d" notitle, \
     "x2_uniform.csv" skip 1 using (strcol(2) eq "sobol" ? $7 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#15985d" title "sobol", \
     NaN notitle
unset multiplot
