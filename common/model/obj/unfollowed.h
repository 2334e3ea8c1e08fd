// Collects unsupported features of material files and warns once per kind, not once per line.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace rt {

class Unfollowed {
  public:
    /// Records an unsupported feature. `what`: a sentence, as in "bump maps are not supported". `path` and
    /// `material`: where it occurs.
    void add(const std::string& path, const std::string& what, const std::string& material);

    /// Warns of each kind in each file, with the number of materials and up to three of their names.
    void tell() const;

  private:
    struct Materials {
        int count = 0;
        std::string last;               ///< the last material counted, so that each counts once
        std::vector<std::string> names; ///< names of the first three
    };
    std::map<std::string, Materials> kinds; ///< keyed by path and sentence
};

} // namespace rt
