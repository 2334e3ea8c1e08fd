// match(variant, arms...): calls the one arm that takes what the variant holds.
// An alternative that no arm takes is a compile error, which is how the compiler names every place to extend.
#pragma once

#include <utility>
#include <variant>

namespace rt {

template <typename... Arms>
struct Overloaded : Arms... {
    using Arms::operator()...;
};
template <typename... Arms>
Overloaded(Arms...) -> Overloaded<Arms...>; // Clang 14 does not deduce this by itself

template <typename Variant, typename... Arms>
constexpr decltype(auto) match(Variant&& variant, Arms&&... arms) {
    return std::visit(Overloaded{std::forward<Arms>(arms)...}, std::forward<Variant>(variant));
}

} // namespace rt
