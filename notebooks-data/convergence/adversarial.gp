# gnuplot adversarial.gp writes adversarial.svg and adversarial.png
if (!exists("kind")) kind = "svg"
if (kind eq "svg") set terminal svg size 1000,440 font "sans-serif,13" background "white"; set output "adversarial.svg"
if (kind eq "png") set terminal pngcairo size 1000,440 font "sans-serif,11" background "white"; set output "adversarial.png"
set datafile separator ","
set border 3 lc rgb "#666666"
set tics nomirror out
set grid lc rgb "#e6e6e6" lt 1
set multiplot layout 1,2 title "-cos(2 pi x) on [0,100]: a regular grid sees only the crests" noenhanced font ",15"
set logscale xy
set format y "10^{%L}"
set key left bottom Left reverse samplen 2 spacing 1.2 tc rgb "#333333"
set ylabel "root-mean-square error"
set xlabel "samples N"
set format x "10^{%L}"
plot "adversarial.csv" skip 1 using (strcol(2) eq "random" ? $3 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#2160c2" notitle, \
     "adversarial.csv" skip 1 using (strcol(2) eq "random" ? $3 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#2160c2" title "random: N^{-0.51 ± 0.06}", \
     51.3425 * x**(-0.5) with lines dt 3 lw 1 lc rgb "#2160c2" notitle, \
     "adversarial.csv" skip 1 using (strcol(2) eq "stratified" ? $3 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#b73300" notitle, \
     "adversarial.csv" skip 1 using (strcol(2) eq "stratified" ? $3 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#b73300" title "stratified: N^{-1.49 ± 0.03}", \
     13768.5 * x**(-1.5) with lines dt 3 lw 1 lc rgb "#b73300" notitle, \
     "adversarial.csv" skip 1 using (strcol(2) eq "sobol" ? $3 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#15985d" notitle, \
     "adversarial.csv" skip 1 using (strcol(2) eq "sobol" ? $3 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#15985d" title "sobol: N^{-1.49 ± 0.03}", \
     12918.1 * x**(-1.5) with lines dt 3 lw 1 lc rgb "#15985d" notitle, \
     NaN notitle
set xlabel "CPU seconds"
set format x "10^{%L}"
plot "adversarial.csv" skip 1 using (strcol(2) eq "random" ? $7 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#2160c2" notitle, \
     "adversarial.csv" skip 1 using (strcol(2) eq "random" ? $7 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#2160c2" title "random", \
     "adversarial.csv" skip 1 using (strcol(2) eq "stratified" ? $7 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#b73300" notitle, \
     "adversarial.csv" skip 1 using (strcol(2) eq "stratified" ? $7 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#b73300" title "stratified", \
     "adversarial.csv" skip 1 using (strcol(2) eq "sobol" ? $7 : NaN):5:6 with filledcurves fs transparent solid 0.18 noborder lc rgb "#15985d" notitle, \
     "adversarial.csv" skip 1 using (strcol(2) eq "sobol" ? $7 : NaN):4 with linespoints pt 7 ps 0.4 lw 1.5 lc rgb "#15985d" title "sobol", \
     NaN notitle
unset multiplot
