// plot FILE.txt FILE.svg: draws curves of measured points, both axes logarithmic. The text says, a line each:
//     # a remark                        left out, as empty lines are
//     title Error against samples       once each, before the first curve
//     x samples a pixel
//     y RMSE
//     curve 0 solid random              a colour (0 to 5), solid or dashed, and a name for what follows:
//     16 0.0421                         a point, x and y, both above 0
#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/bench/svg.h"

#include <exception>
#include <sstream>
#include <string>

namespace {

using rt::bench::Curve;
using rt::bench::LogPlot;

/// What stands on the line behind its first word.
std::string rest_of(std::istringstream& words) {
    std::string rest;
    std::getline(words >> std::ws, rest);
    return rest;
}

Curve curve_from(std::istringstream& words) {
    Curve curve;
    std::string dashes;
    if (!(words >> curve.colour >> dashes) || curve.colour < 0 || curve.colour > 5 ||
        (dashes != "solid" && dashes != "dashed"))
        throw rt::Error("a curve wants a colour from 0 to 5, then solid or dashed, then a name");
    curve.dashed = dashes == "dashed";
    curve.name = rest_of(words);
    return curve;
}

std::pair<double, double> point_from(const std::string& line) {
    std::istringstream words(line);
    std::pair<double, double> point;
    if (!(words >> point.first >> point.second) || !(words >> std::ws).eof() || !(point.first > 0) ||
        !(point.second > 0))
        throw rt::Error("a point wants two numbers above 0");
    return point;
}

void read_line(LogPlot& plot, const std::string& line) {
    std::istringstream words(line);
    std::string first;
    if (!(words >> first) || first[0] == '#') return;
    if (first == "title")
        plot.title = rest_of(words);
    else if (first == "x")
        plot.x_label = rest_of(words);
    else if (first == "y")
        plot.y_label = rest_of(words);
    else if (first == "curve")
        plot.curves.push_back(curve_from(words));
    else if (plot.curves.empty())
        throw rt::Error("a point before the first curve, or a word that is not known");
    else
        plot.curves.back().points.push_back(point_from(line));
}

LogPlot plot_from(const std::string& name, const std::string& text) {
    LogPlot plot;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) try {
            read_line(plot, line);
        } catch (const rt::Error& error) {
            throw rt::Error(name + ", line " + std::to_string(number) + ": " + error.what());
        }
    return plot;
}

} // namespace

int main(int argc, char** argv) {
    try {
        if (argc != 3) throw rt::Error("what to plot, and where to? plot FILE.txt FILE.svg");
        const std::string name = argv[1];
        rt::write_file(argv[2], rt::bench::svg(plot_from(name, rt::read_file(name, 1 << 20))));
    } catch (const std::exception& problem) {
        return rt::report_error("plot", problem.what());
    }
    return 0;
}
