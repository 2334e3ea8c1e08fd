// match(variant, arms...): calls the arm that accepts the variant's current alternative.
// An alternative that no arm accepts is a compile error, so the compiler lists every place to extend.
#pragma once

#include <utility>
#include <variant>

namespace rt {

template <typename... Arms>
struct Overloaded : Arms... {
    using Arms::operator()...;
};
template <typename... Arms>
Overloaded(Arms...) -> Overloaded<Arms...>; // Clang 14 does not deduce this on its own

template <typename Variant, typename... Arms>
constexpr decltype(auto) match(Variant&& variant, Arms&&... arms) {
    return std::visit(Overloaded{std::forward<Arms>(arms)...}, std::forward<Variant>(variant));
}

} // namespace rt
