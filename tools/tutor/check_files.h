// The files of checks of a step: which there are, and in which order they are run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rt {

/// As in "05_mesh_bvh_aabb": tests/05_mesh_bvh/aabb.cpp holds the checks, test_05_mesh_bvh_aabb runs them. First come
/// those of headers with exercises, in an order in which these can be written; slow statistics come last.
std::vector<std::string> check_files(const std::filesystem::path& root, const std::string& step);

/// "tests/05_mesh_bvh/aabb.cpp" for "05_mesh_bvh_aabb".
std::string check_source(const std::string& step, const std::string& file);

/// Statistics take longer than anybody likes to wait for.
bool is_slow(const std::string& file);

/// The one that has the checks of a header: "05_mesh_bvh_aabb" for aabb.h. Not every header has one.
std::string check_file_of(const std::string& step, const std::string& header);

} // namespace rt
