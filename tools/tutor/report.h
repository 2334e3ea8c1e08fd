// The report of a check as one web page that opens from disk: verdict, likely mistake, pictures, all checks.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rt {

/// A check as the report shows it.
struct ReportCheck {
    std::string name;
    std::string state; ///< ok failed skipped unfinished
    double seconds = 0;
    std::vector<std::string> lines; ///< what was expected, what came, notes
};

struct Report {
    std::string step;                   ///< "03_mirror"
    std::string question;               ///< "what does the mirror see?"
    std::vector<std::string> own_files; ///< "03_mirror/mirror.h"
    std::vector<ReportCheck> checks;    ///< of the step, in its order
    std::vector<std::string> earlier;   ///< "01_spheres: 67 of 67 checks"
    std::string verdict; ///< on the picture: same, noise, look, different, or why there is none
    std::vector<std::string> verdict_lines; ///< for a person
    double flip_mean = 0, flip_max = 0;
    std::optional<int> tiles_over_4;
    std::filesystem::path mine, reference, map; ///< PNG files of one size; empty: none
    std::string mistake_title, mistake_confidence, mistake_shows, mistake_why,
        mistake_fix;                       ///< empty: none known
    std::filesystem::path mistake_picture; ///< the gallery's wrong picture, may be missing
    std::string next;                      ///< "./learn hint 03 reflected_ray"
    std::string settings;                  ///< "480 x 480, 16 samples a pixel, seed 1"
    std::filesystem::path root; ///< of the project: the page's frame is tools/tutor/report.html in it
};

/// The whole page. Reads the frame and the pictures. Throws Error.
std::string report_html(const Report& report);

} // namespace rt
