// Appends items to lists whose elements are referred to by index.
#pragma once

#include <type_traits>
#include <utility>
#include <vector>

namespace rt {

/// Appends an item and returns its index.
template <typename Item>
int add(std::vector<Item>& list, std::type_identity_t<Item> item) {
    list.push_back(std::move(item));
    return int(list.size()) - 1;
}

} // namespace rt
