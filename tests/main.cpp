// The main function of all test executables: doctest's, with three additions.
// A filter that selects no test case is an error, and --reporters=lines prints events for other programs, one
// per line, with fields separated by tabs:
//     case  name                              a test case begins
//     fail  file:line  expression  expanded   an assertion failed
//     note  text                              context or explanation of the failure before it
//     end   name  ok|failed|skipped  seconds  the test case is over
// --seconds-per-check=5 ends the process if a test case uses more processor time.
#define DOCTEST_CONFIG_IMPLEMENT
#define DOCTEST_CONFIG_NO_WINDOWS_SEH // a crash ends the process with its own code, which the tutor reads
#include <doctest/doctest.h>

#include "common/util/system.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>

namespace {

int seconds_per_check = 0; ///< 0: no limit

/// Replaces line breaks and tabs by spaces, so that a reader can split lines and fields.
std::string one_line(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
    return text;
}

/// Reporter behind --reporters=lines. It flushes each line immediately, so that the output of a check that
/// crashes or hangs is not lost.
struct Lines : doctest::IReporter {
    std::ostream& out;
    std::string name;
    bool skipped = false;

    explicit Lines(const doctest::ContextOptions& options) : out(*options.cout) {}

    void test_case_start(const doctest::TestCaseData& test) override {
        name = one_line(test.m_name);
        skipped = false;
        if (seconds_per_check > 0) rt::limit_processor_time(seconds_per_check);
        out << "case\t" << name << std::endl;
    }
    void test_case_end(const doctest::CurrentTestCaseStats& stats) override {
        const char* state = !stats.testCaseSuccess ? "failed" : skipped ? "skipped" : "ok";
        out << "end\t" << name << "\t" << state << "\t" << stats.seconds << std::endl;
    }
    void log_assert(const doctest::AssertData& assertion) override {
        if (!assertion.m_failed) return;
        const doctest::String& thrown = assertion.m_exception;
        fail(assertion.m_file, assertion.m_line, assertion.m_expr,
             thrown.size() > 0 ? "threw " + std::string(thrown.c_str()) : assertion.m_decomp.c_str());
        for (int i = 0; i < get_num_active_contexts(); ++i) {
            std::ostringstream text;
            get_active_contexts()[i]->stringify(&text);
            note(text.str());
        }
    }
    void log_message(const doctest::MessageData& message) override {
        const std::string text = message.m_string.c_str();
        skipped = skipped || text.starts_with("[skipped]");
        if (message.m_severity & doctest::assertType::is_warn)
            note(text);
        else
            fail(message.m_file, message.m_line, "FAIL", text);
    }
    void test_case_exception(const doctest::TestCaseException& exception) override {
        fail("", 0, exception.is_crash ? "crashed" : "threw", exception.error_string.c_str());
    }

    void fail(const char* file, int line, const std::string& expression, const std::string& expanded) {
        out << "fail\t" << file << ":" << line << "\t" << one_line(expression) << "\t" << one_line(expanded)
            << std::endl;
    }
    void note(const std::string& text) { out << "note\t" << one_line(text) << std::endl; }

    void report_query(const doctest::QueryData&) override {}
    void test_run_start() override {}
    void test_run_end(const doctest::TestRunStats&) override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}
};

REGISTER_REPORTER("lines", 0, Lines);

/// Counts the test cases that pass the filters.
struct Counter : doctest::IReporter {
    inline static unsigned selected = 0;

    explicit Counter(const doctest::ContextOptions&) {}
    void test_run_end(const doctest::TestRunStats& stats) override {
        selected = stats.numTestCasesPassingFilters;
    }

    void report_query(const doctest::QueryData&) override {}
    void test_run_start() override {}
    void test_case_start(const doctest::TestCaseData&) override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void test_case_end(const doctest::CurrentTestCaseStats&) override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}
};

REGISTER_LISTENER("counter", 0, Counter);

} // namespace

int main(int argc, char** argv) {
    constexpr std::string_view limit = "--seconds-per-check=";
    for (int i = 1; i < argc; ++i)
        if (std::string_view(argv[i]).starts_with(limit))
            seconds_per_check = std::atoi(argv[i] + limit.size());
    doctest::Context context(argc, argv);
    const int result = context.run();
    if (context.shouldExit()) return result; // only a list, a count or help was requested
    if (Counter::selected == 0) {
        std::cerr << "error: no test case matches the filter\n";
        return 1;
    }
    return result;
}
