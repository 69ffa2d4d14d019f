# gnuplot x2_quadratic.gp writes x2_quadratic.svg and x2_quadratic.png
if (!exists("kind")) kind = "svg"
if (kind eq "svg") set terminal svg size 1000,440 font "sans-serif,13" background "white"; set output "x2_quadratic.svg"
if (kind eq "png") set terminal pngcairo size 1000,440 font "sans-serif,11" background "white"; set output "x2_quadratic.png"
set datafile separator ","
set border 3 lc rgb "#666666"
set tics nomirror out
set grid lc rgb "#e6e6e6" lt 1
set multiplot layout 1,2 title "x^2 on [0,2], density 3 x^2 / 8: no error at all" noenhanced font ",15"
set logscale xy
set format y "10^{%L}"
set key left bottom Left reverse samplen 2 spacing 1.2 tc rgb "#333333"
set ylabel "root-mean-square error"
set xlabel "samples N"
set format x "10^{%L}"
plot NaN notitle
set xlabel "CPU seconds"
set format x "10^{%L}"
plot NaN notitle
unset multiplot
