// Draws the plots: a page with its colours, a frame with its axes, and the marks in it.

#include "tools/bench/svg.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rt::bench {

namespace {

constexpr double width = 760;

std::string format(const char* pattern, auto... values) {
    char text[512];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text)
        out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return out;
}

/// Anchor: start, middle or end.
std::string words(double x, double y, const char* anchor, const std::string& style, const std::string& text) {
    return format("<text x='%.1f' y='%.1f' text-anchor='%s' class='%s'>", x, y, anchor, style.c_str()) +
           escaped(text) + "</text>\n";
}

/// The six colours keep their distance from each other, and from the page, on both grounds.
std::string page(double height, const std::string& title, const std::string& content) {
    return format(
               "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %.0f %.0f' width='%.0f' height='%.0f' "
               "font-family='system-ui, sans-serif' font-size='13'>\n",
               width, height, width, height) +
           "<style>\n"
           ":root { --page: #ffffff; --ink: #1f2429; --pale: #5d6770; --grid: #e3e7ea;\n"
           "  --c0: #0a6aa1; --c1: #cf4520; --c2: #24895a; --c3: #8250b4; --c4: #b17a00; --c5: #69737b; }\n"
           "@media (prefers-color-scheme: dark) { :root { --page: #15191d; --ink: #e9edf0; --pale: #a3adb5;\n"
           "  --grid: #2c333a; --c0: #5cb8ee; --c1: #ff8a66; --c2: #62cf97; --c3: #c4a0f2; --c4: #ebbb52;\n"
           "  --c5: #a9b3bb; } }\n"
           ".page { fill: var(--page); } text { fill: var(--ink); } .pale { fill: var(--pale); }\n"
           ".title { font-size: 17px; font-weight: 600; } .grid { stroke: var(--grid); }\n"
           ".axis { stroke: var(--pale); } .reference { stroke: var(--ink); stroke-dasharray: 2 4; }\n"
           ".curve { fill: none; stroke-width: 2.2; stroke-linejoin: round; } .dashed { stroke-dasharray: 7 "
           "5; }\n"
           ".s0 { stroke: var(--c0); } .s1 { stroke: var(--c1); } .s2 { stroke: var(--c2); }\n"
           ".s3 { stroke: var(--c3); } .s4 { stroke: var(--c4); } .s5 { stroke: var(--c5); }\n"
           ".f0 { fill: var(--c0); } .f1 { fill: var(--c1); } .f2 { fill: var(--c2); }\n"
           ".f3 { fill: var(--c3); } .f4 { fill: var(--c4); } .f5 { fill: var(--c5); }\n"
           ".on { fill: var(--page); font-size: 12px; }\n"
           "</style>\n" +
           format("<rect class='page' width='%.0f' height='%.0f' rx='6'/>\n", width, height) +
           words(24, 34, "start", "title", title) + content + "</svg>\n";
}

struct Key {
    std::string name;
    int colour;
    bool dashed, line;
};

/// The names of the marks, in rows under the title. Answers where the next thing may stand.
double legend(std::string& content, const std::vector<Key>& keys, double y) {
    double x = 24;
    for (const Key& key : keys) {
        const double wide = 42 + 7.1 * double(key.name.size());
        if (x + wide > width - 16) {
            x = 24;
            y += 20;
        }
        if (key.line)
            content += format("<path class='curve s%d%s' d='M%.1f %.1fh24'/>\n", key.colour,
                              key.dashed ? " dashed" : "", x, y - 4);
        else
            content += format("<rect class='f%d' x='%.1f' y='%.1f' width='12' height='12' rx='2'/>\n",
                              key.colour, x + 10, y - 10);
        content += words(x + 30, y, "start", "", key.name);
        x += wide;
    }
    return y + 18;
}

/// 1.5k, 10M; plain below a thousand.
std::string short_number(double value) {
    if (value >= 1e6) return format("%.3gM", value / 1e6);
    if (value >= 1e3) return format("%.3gk", value / 1e3);
    return format("%.3g", value);
}

// ---- logarithmic plots ----

/// A stretch of numbers on a stretch of the page.
struct LogAxis {
    double low, high; ///< of the numbers
    double from, to;  ///< on the page

    double at(double value) const {
        return from + std::log(value / low) / std::log(high / low) * (to - from);
    }
};

/// Just wide enough for the values, with some air.
LogAxis log_axis(const std::vector<double>& values, double from, double to) {
    const auto [least, most] = std::ranges::minmax(values);
    return {least / 1.25, most * 1.25, from, to};
}

/// Powers of ten, with their doubles and fives where the axis spans few of them.
std::vector<double> ticks(const LogAxis& axis) {
    const double decades = std::log10(axis.high / axis.low);
    std::vector<double> result;
    for (double power = std::pow(10, std::floor(std::log10(axis.low))); power <= axis.high; power *= 10)
        for (const double factor : {1.0, 2.0, 5.0})
            if ((factor == 1 || decades < 2.6) && power * factor >= axis.low && power * factor <= axis.high)
                result.push_back(power * factor);
    return result;
}

std::string axes(const LogAxis& x, const LogAxis& y, const LogPlot& plot) {
    std::string out;
    for (const double tick : ticks(x)) {
        out += format("<path class='grid' d='M%.1f %.1fV%.1f'/>\n", x.at(tick), y.from, y.to);
        out += words(x.at(tick), y.from + 20, "middle", "pale", short_number(tick));
    }
    for (const double tick : ticks(y)) {
        out += format("<path class='grid' d='M%.1f %.1fH%.1f'/>\n", x.from, y.at(tick), x.to);
        out += words(x.from - 8, y.at(tick) + 4, "end", "pale", short_number(tick));
    }
    out += format("<path class='axis' fill='none' d='M%.1f %.1fV%.1fH%.1f'/>\n", x.from, y.to, y.from, x.to);
    out += words((x.from + x.to) / 2, y.from + 44, "middle", "pale", plot.x_label);
    out += format("<g transform='translate(22 %.1f) rotate(-90)'>", (y.from + y.to) / 2) +
           words(0, 0, "middle", "pale", plot.y_label) + "</g>\n";
    return out;
}

bool drawable(const std::pair<double, double>& point) {
    return std::isfinite(point.first) && std::isfinite(point.second) && point.first > 0 && point.second > 0;
}

std::string drawn(const Curve& curve, const LogAxis& x, const LogAxis& y) {
    std::string path, dots;
    for (const auto& point : curve.points) {
        if (!drawable(point)) continue;
        const double px = x.at(point.first), py = y.at(point.second);
        path += format("%c%.1f %.1f", path.empty() ? 'M' : 'L', px, py);
        dots += format("<circle class='f%d' cx='%.1f' cy='%.1f' r='3'/>\n", curve.colour, px, py);
    }
    if (path.empty()) return "";
    return format("<path class='curve s%d%s' d='", curve.colour, curve.dashed ? " dashed" : "") + path +
           "'/>\n" + dots;
}

// ---- bars ----

/// A round number that about five steps of reach `most`.
double round_step(double most) {
    const double rough = most / 5, power = std::pow(10, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 2.5, 5.0})
        if (rough <= factor * power) return factor * power;
    return 10 * power;
}

double largest(const std::vector<std::vector<double>>& values, double at_least) {
    for (const auto& row : values)
        for (const double value : row)
            if (std::isfinite(value)) at_least = std::max(at_least, value);
    return at_least > 0 ? at_least : 1;
}

} // namespace

std::string svg(const LogPlot& plot) {
    std::vector<double> xs, ys;
    std::vector<Key> keys;
    for (const Curve& curve : plot.curves) {
        const std::size_t before = xs.size();
        for (const auto& point : curve.points) {
            if (!drawable(point)) continue;
            xs.push_back(point.first);
            ys.push_back(point.second);
        }
        if (xs.size() > before) keys.push_back({curve.name, curve.colour, curve.dashed, true});
    }
    std::string content;
    if (xs.empty()) return page(90, plot.title, words(24, 64, "start", "pale", "nothing was measured"));
    const double top = legend(content, keys, 62);
    const LogAxis x = log_axis(xs, 76, width - 24);
    const LogAxis y = log_axis(ys, top + 330, top);
    content += axes(x, y, plot);
    for (const Curve& curve : plot.curves) content += drawn(curve, x, y);
    return page(y.from + 62, plot.title, content);
}

std::string svg(const Bars& bars) {
    std::string content;
    std::vector<Key> keys;
    for (std::size_t i = 0; i < bars.series.size(); ++i)
        keys.push_back({bars.series[i], int(i % 6), false, false});
    const double top = legend(content, keys, 62), bottom = top + 280, left = 64, right = width - 24;
    const double step = round_step(largest(bars.values, bars.reference));
    const double most = step * std::ceil(largest(bars.values, bars.reference) * 1.05 / step);
    const auto at = [&](double value) { return bottom - value / most * (bottom - top); };
    for (double tick = 0; tick <= most + step / 2; tick += step) {
        content += format("<path class='grid' d='M%.1f %.1fH%.1f'/>\n", left, at(tick), right);
        content += words(left - 8, at(tick) + 4, "end", "pale", format("%.3g", tick));
    }
    const double group_width = (right - left) / double(std::max<std::size_t>(1, bars.groups.size()));
    const double bar =
        std::min(34.0, 0.8 * group_width / double(std::max<std::size_t>(1, bars.series.size())));
    for (std::size_t g = 0; g < bars.groups.size(); ++g) {
        const double middle = left + (double(g) + 0.5) * group_width;
        content += words(middle, bottom + 20, "middle", "pale", bars.groups[g]);
        for (std::size_t s = 0; s < bars.series.size(); ++s) {
            const double value = bars.values[g][s],
                         x = middle + (double(s) - double(bars.series.size()) / 2) * bar;
            if (!std::isfinite(value)) continue;
            content += format("<rect class='f%d' x='%.1f' y='%.1f' width='%.1f' height='%.1f'/>\n",
                              int(s % 6), x + 1, at(value), bar - 2, bottom - at(value));
            if (bar >= 22) content += words(x + bar / 2, at(value) - 5, "middle", "", format("%.2f", value));
        }
    }
    if (bars.reference > 0)
        content += format("<path class='reference' d='M%.1f %.1fH%.1f'/>\n", left, at(bars.reference), right);
    content += format("<g transform='translate(22 %.1f) rotate(-90)'>", (top + bottom) / 2) +
               words(0, 0, "middle", "pale", bars.y_label) + "</g>\n";
    return page(bottom + 40, bars.title, content);
}

std::string svg(const Shares& shares) {
    std::string content;
    std::vector<Key> keys;
    for (std::size_t i = 0; i < shares.series.size(); ++i)
        keys.push_back({shares.series[i], int(i % 6), false, false});
    double y = legend(content, keys, 62);
    const double left = 140, right = width - 24;
    for (std::size_t r = 0; r < shares.rows.size(); ++r, y += 32) {
        content += words(left - 10, y + 17, "end", "", shares.rows[r]);
        double x = left;
        for (std::size_t s = 0; s < shares.series.size(); ++s) {
            const double wide = shares.values[r][s] * (right - left);
            if (!(wide > 0.3)) continue;
            content += format("<rect class='f%d' x='%.1f' y='%.1f' width='%.1f' height='24'/>\n", int(s % 6),
                              x, y, std::max(0.3, wide - 1));
            if (wide > 40)
                content +=
                    words(x + wide / 2, y + 17, "middle", "on", format("%.0f %%", 100 * shares.values[r][s]));
            x += wide;
        }
    }
    return page(y + 12, shares.title, content);
}

} // namespace rt::bench
