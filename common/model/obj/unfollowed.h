// What material files ask for and is not done: told once per kind, not once per line.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace rt {

class Unfollowed {
  public:
    /// `what`: a sentence, "bump maps are not followed"; `path` and `material`: where that is asked for.
    void add(const std::string& path, const std::string& what, const std::string& material);

    /// Warns of each kind in each file, with the number of materials and the names of up to three.
    void tell() const;

  private:
    struct Materials {
        int count = 0;
        std::string last;               ///< so that each counts once
        std::vector<std::string> names; ///< of the first three
    };
    std::map<std::string, Materials> kinds; ///< by path and sentence
};

} // namespace rt
