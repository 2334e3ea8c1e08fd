// ./learn course: what the learner's eight programs render, as one page to share.
#include "tools/tutor/build.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/gaps.h"
#include "tools/tutor/report.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

#include "common/util/file_bytes.h"

#include <ctime>
#include <iostream>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// A picture of the page, and how it was made.
Json rendered(const Preset& preset, const std::string& step, const Words& flags, const fs::path& picture) {
    std::cout << "rendering " << text_of(picture.stem()) << " ... " << std::flush;
    Words command{text_of(preset.program(step)), "--out", text_of(picture)};
    append(command, flags);
    std::string log;
    wait_for_program(path_of(command[0]));
    if (run_process(command, {.output = &log}).code != 0)
        throw CommandFailed(step + " could not be rendered; ./learn check " + number_of(step) + " says why");
    const Words time =
        words_in(line_after(log, "time ")); // 2.58 s, 27082410 rays, 10.5 million rays a second
    std::cout << joined({time.at(0), "s"}, " ") << std::endl;
    return {{"picture", "data:image/png;base64," + base64(read_file(text_of(picture)))},
            {"seconds", time.at(0)},
            {"rays", time.at(2)}};
}

/// How many functions of a step the learner has written.
int functions_written(const Project& project, const std::string& step) {
    const std::vector<Gap> gaps = gaps_of(project, step);
    return int(std::ranges::count(gaps, GapState::written, &Gap::state));
}

std::string date() {
    const std::time_t now = std::time(nullptr);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d", std::localtime(&now));
    return text;
}

} // namespace

void make_course_page(const Project& project, bool open) {
    if (const Words left = open_steps(project); !left.empty())
        throw CommandFailed("the page is made when all steps are done; to do: " + joined(left, ", ") +
                            "; ./learn status says what is next");
    const Preset preset{project.root};
    make(preset, {"programs"});
    const TemporaryFolder scratch(preset.folder());
    const auto checks = read_checks(project);
    Json course{{"date", date()}, {"steps", Json::array()}, {"cover", nullptr}};
    for (const std::string& step : all_steps(project)) {
        Json entry = rendered(preset, step, {}, scratch.path / (step + ".png"));
        entry["step"] = step;
        entry["question"] = question_of(project, step);
        entry["checks"] = checks.at(step).passed;
        entry["functions"] = functions_written(project, step);
        course["steps"].push_back(entry);
    }
    course["cover"] = rendered(
        preset, all_steps(project).back(),
        {"--scene", "weekend", "--width", "1200", "--height", "675", "--samples", "64", "--depth", "20"},
        scratch.path / "cover.png");
    const fs::path page = project.workshop / "report" / "course.html";
    make_folder(page.parent_path());
    write_file(text_of(page), filled_page(project.root, "course.html", course));
    std::cout << "your page: " << display_path(page) << std::endl;
    if (open && !open_page(page))
        std::cout << "there is no program here that opens a page; open it yourself\n";
}

} // namespace rt::tutor
