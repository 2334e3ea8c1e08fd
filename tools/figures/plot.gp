# gnuplot -c plot.gp DATA.txt OUT.svg: draws a plot that is legible on light and on dark pages.
# DATA.txt is loaded first: it sets `kind`, `title` and `y_label`, and defines the data block $data. The kinds:
#   curves  logarithmic axes. $data has a block of lines "x y" per curve, below its name in quotes, separated by two
#           empty lines. Also set `x_label`, and `styles`: for each curve a colour from 1 to 6, plus 10 for dashes
#   bars    grouped columns. $data has a column per series with its name on top, and a row per group with its name in
#           front. Also set `reference`: the height of a horizontal line (0: none)
#   shares  stacked columns: like bars, with the shares of each row in percent
load ARG1

height = kind eq "curves" ? 472 : 420
set terminal svg size 760, height noenhanced font "sans-serif,13" background "#ffffff"
# On a dark page the lightness is inverted and the hue kept. gnuplot's version is removed, so that equal data
# give equal files.
style = "text { font-family: system-ui, sans-serif } @media (prefers-color-scheme: dark) \
    { #gnuplot_canvas { filter: invert(.92) hue-rotate(180deg) } }"
set output sprintf("| sed -e 's|<title>Gnuplot</title>|<style>%s</style>|; /^<desc>/d; s|<title>gnuplot_plot_.*</title>||' \
                    -e 's|font-family=\"sans-serif:bold\"|font-weight=\"600\"|' >'%s'", style, ARG2)

array colours[6] = ["#0a6aa1", "#cf4520", "#24895a", "#8250b4", "#b17a00", "#69737b"]
do for [i = 1:6] {
    set style line i lc rgb colours[i] lw 2.2 pt 7 ps 0.6 dt solid
    set style line i + 10 lc rgb colours[i] lw 2.2 pt 7 ps 0.6 dt (7, 5)
}
set label 1 title at screen 0.03, screen 1 - 28.0 / height font "sans-serif:bold,17" tc rgb "#1f2429"
set key at screen 0.025, screen 1 - 46.0 / height left top horizontal Left reverse samplen 2.2 width -3 maxrows 2 tc rgb "#1f2429"
set margins at screen 0.1, screen 0.97, screen 62.0 / height, screen 1 - 92.0 / height
set border 3 lc rgb "#5d6770"
set grid lt 1 lw 1 lc rgb "#e3e7ea"
set tics nomirror scale 0 tc rgb "#5d6770"
set label 2 y_label at screen 0.03, graph 0.5 center rotate tc rgb "#5d6770"

if (kind eq "curves") {
    stats $data using 1:2 nooutput
    set logscale xy
    set xlabel x_label tc rgb "#5d6770"
    set xrange [STATS_min_x / 1.25:STATS_max_x * 1.25]
    set yrange [STATS_min_y / 1.25:STATS_max_y * 1.25]
    # Tics at powers of ten, and at round numbers between them if there is room.
    name(v) = v < 1000 ? sprintf("%g", v) : gprintf("%.0s%c", v)
    marks(ratio) = ratio > 400 ? "1" : ratio > 8 ? "1 2 5" : "1 1.5 2 3 4 5 6 8"
    set xtics () ; set ytics ()
    do for [power = -9:12] {
        do for [m in marks(STATS_max_x / STATS_min_x)] { set xtics add (name(m * 10.0**power) m * 10.0**power) }
        do for [m in marks(STATS_max_y / STATS_min_y)] { set ytics add (name(m * 10.0**power) m * 10.0**power) }
    }
    plot for [i = 1:words(styles)] $data index i - 1 using 1:2 with linespoints ls int(word(styles, i)) title columnheader(1)
} else {
    stats $data using 2 every ::1 nooutput
    series = STATS_columns - 1
    set style data histograms
    set style fill solid noborder
    set boxwidth 0.9
    set grid noxtics
    set xtics font ",11"
    set xrange [-0.6:STATS_records + STATS_invalid - 0.4]
    if (kind eq "shares") {
        set style histogram rowstacked
        set yrange [0:100]
        plot for [i = 1:series] $data using i + 1:xtic(1) ls i title columnheader(i + 1)
    } else {
        set style histogram clustered gap 1
        set yrange [0:*]
        place(i) = $0 + (i - (series + 1) / 2.0) / (series + 1.0)
        plot for [i = 1:series] $data using i + 1:xtic(1) ls i title columnheader(i + 1), \
            for [i = 1:series] $data every ::1 using (place(i)):i + 1:(sprintf("%.2f", column(i + 1))) \
                with labels offset 0, 0.6 font ",11" tc rgb "#5d6770" notitle, \
            reference > 0 ? reference : NaN lc rgb "#1f2429" dt (2, 4) notitle
    }
}
# Closes the pipe, so that the file is complete when gnuplot exits.
unset output
