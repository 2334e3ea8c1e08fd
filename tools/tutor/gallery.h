// The gallery of wrong pictures: what the program of a step renders with each of its known mistakes, small, in
// exercises/NN_name/gallery/. ./learn prove --write renders it.
#pragma once

#include "tools/compare/catalogue.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rt {

/// `root`/exercises/03_mirror/gallery/far-root.png; the right picture is called "right".
std::filesystem::path gallery_picture(const std::filesystem::path& root, const std::string& step,
                                      const std::string& id);

/// What an assets/reference/NN_name.txt says after `key: `; empty if it does not.
std::string reference_fact(const std::filesystem::path& root, const std::string& step,
                           const std::string& key);

/// The flags with which a step's program renders for the gallery: the reference's view on 3/8 of its pixels.
std::vector<std::string> gallery_flags(const std::filesystem::path& root, const std::string& step);

/// The ids of the mistakes whose picture this one is, rendered with those flags; none if it is like none of them.
compare::CatalogueMatch nearest_mistake(const std::filesystem::path& root, const std::string& step,
                                        const std::filesystem::path& picture);

} // namespace rt
