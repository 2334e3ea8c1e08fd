// The report of a check as a single web page: verdict, likely mistake, pictures, all checks.
#pragma once

#include "common/util/json.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace rt::tutor {

/// Returns JSON that is safe inside a <script> element: <, >, & and control characters are escaped, so that
/// no text can end the element.
std::string script_safe_json(const Json& value);

/// Encodes bytes as Base64 with padding (RFC 4648, section 4).
std::string base64(std::string_view bytes);

/// Returns a template of tools/tutor/ ("report.html") with page.js and the data in place of its two placeholders.
/// Throws Error.
std::string filled_page(const std::filesystem::path& root, const std::string& name, const Json& data);

/// Returns the page for a report with the fields step, question, own_files, checks (name, state, seconds,
/// lines), earlier, verdict, verdict_lines, flip_mean, flip_max, tiles_over_4, mistake (title, confidence,
/// shows, why, fix, picture; or null), next, settings and pictures (mine, reference, map). Pictures are paths
/// of PNG files, which are embedded in the page. With a field stamp it loads itself again when STEP.js beside it has
/// another one. The template is tools/tutor/report.html. Throws Error.
std::string report_html(const std::filesystem::path& root, Json report);

} // namespace rt::tutor
