// Compares a picture with the pictures of known mistakes, and names one only if it matches.
#include "tools/compare/catalogue.h"

#include "tools/compare/flip.h"
#include "common/util/error.h"
#include "common/util/paths.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <system_error>

namespace rt::compare {
namespace {

namespace fs = std::filesystem;

/// Returns the root mean square of z over all tiles, or only over those that are outliers in `telling`.
double mean_z(const TileDifference& tiles, const TileDifference* telling = nullptr) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < tiles.scores.size(); ++i) {
        if (telling && std::abs(telling->scores[i].z) <= limits.outlier_z) continue;
        sum += std::min(tiles.scores[i].z * tiles.scores[i].z, 1e6);
        ++count;
    }
    return count > 0 ? std::sqrt(sum / count) : 0;
}

/// Returns the distance to a known picture; nothing if the two do not match, or if the reference is
/// about as close.
std::optional<double> exact_distance(const EncodedImage& test, const EncodedImage& reference,
                                     const CatalogueImage& known) {
    const Pair to_known = comparable(test, known.picture), to_reference = comparable(test, reference);
    if (root_mean_square(to_known.test, to_known.reference) >=
        root_mean_square(to_reference.test, to_reference.reference))
        return {};
    const FlipMap seen = flip(to_known.reference, to_known.test);
    const bool looks_same = seen.mean <= limits.catalogue_flip_mean && seen.max <= limits.catalogue_flip_max;
    if (!looks_same && !conclude(compare_pixels(to_known.test, to_known.reference)).same) return {};
    if (seen.mean > limits.catalogue_max_ratio * flip(to_reference.reference, to_reference.test).mean)
        return {};
    return seen.mean;
}

std::optional<double> noisy_distance(const EncodedImage& test, const EncodedImage& reference,
                                     const Variances& variances, const CatalogueImage& known) {
    const Image& variance = known.variance.pixels.empty() ? variances.test : known.variance;
    const TileDifference tiles = compare_tiles(test.image, known.picture.image, variances.test, variance);
    const TileDifference right =
        compare_tiles(test.image, reference.image, variances.test, variances.reference);
    if (!conclude(tiles).same || mean_z(tiles, &right) > limits.catalogue_max_ratio * mean_z(right, &right))
        return {};
    return mean_z(tiles);
}

/// Returns the paths of the pictures in a folder by name.
std::map<std::string, std::string> pictures_in(const std::string& folder) {
    std::map<std::string, std::string> paths;
    std::error_code problem;
    for (const fs::directory_entry& entry : fs::directory_iterator(path_of(folder), problem)) {
        const fs::path& path = entry.path();
        const std::string ending = text_of(path.extension()), name = text_of(path.stem());
        const bool is_variance = path.stem().extension() == ".variance";
        if (is_variance || (ending != ".hdr" && ending != ".png")) continue;
        if (ending == ".hdr" || paths.count(name) == 0) paths[name] = text_of(path);
    }
    if (problem) throw Error(folder + ": is not a readable folder (" + problem.message() + ")");
    if (paths.empty()) throw Error(folder + ": contains no .hdr or .png file to compare with");
    return paths;
}

} // namespace

CatalogueMatch find_in_catalogue(const EncodedImage& test, const EncodedImage& reference,
                                 const Variances& variances, const std::vector<CatalogueImage>& catalogue) {
    std::vector<std::pair<double, std::string>> found;
    for (const CatalogueImage& candidate : catalogue) {
        try {
            check_same_size(test.image, candidate.picture.image);
            const auto distance = variances.available()
                                      ? noisy_distance(test, reference, variances, candidate)
                                      : exact_distance(test, reference, candidate);
            if (distance) found.emplace_back(*distance, candidate.name);
        } catch (const Error& problem) {
            throw Error("known picture " + candidate.name + ": " + problem.what());
        }
    }
    if (found.empty()) return {};
    std::sort(found.begin(), found.end());
    CatalogueMatch match{{}, found.front().first};
    for (const auto& [distance, name] : found)
        if (distance <= limits.catalogue_tie * match.distance) match.names.push_back(name);
    return match;
}

std::vector<CatalogueImage> read_catalogue_images(const std::string& folder) {
    std::vector<CatalogueImage> known;
    for (const auto& [name, path] : pictures_in(folder)) {
        known.push_back({name, read_encoded(path), {}});
        const fs::path variance = path_of(folder) / path_of(name + ".variance.hdr");
        if (fs::exists(variance)) known.back().variance = read_encoded(text_of(variance)).image;
    }
    return known;
}

} // namespace rt::compare
