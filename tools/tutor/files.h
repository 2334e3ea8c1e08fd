// The learner's files: what they began with, and where they are moved.
#pragma once

#include "tools/tutor/workshop.h"

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace rt::tutor {

/// Returns a file of the reference with all its exercises replaced by gaps.
std::string stub_of(const Project& project, const std::string& step, const std::string& file,
                    const std::vector<Exercise>& exercises);

/// Returns where the stub is kept that the learner's file began with.
std::filesystem::path base_of(const Project& project, const std::string& step, const std::string& file);

/// Keeps a stub there.
void write_base(const Project& project, const std::string& step, const std::string& file,
                const std::string& stub);

/// Moves a file of the learner's to workshop/.backup/ and says how to restore it. Throws Error.
void back_up(const Project& project, const std::string& step, const std::string& file, std::ostream& out);

} // namespace rt::tutor
