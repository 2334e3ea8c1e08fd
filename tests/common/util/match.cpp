// Facts about match(): it runs the arm for the type that the variant holds.
#include "common/util/match.h"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <type_traits>

namespace {

struct Matte {
    int value = 1;
};
struct Mirror {
    int value = 2;
};
using Material = std::variant<Matte, Mirror>;

constexpr int number(const Material& material) {
    return rt::match(
        material, [](const Matte&) { return 10; }, [](const Mirror&) { return 20; });
}

} // namespace

TEST_CASE("match calls the arm for the type that the variant holds") {
    CHECK(number(Matte{}) == 10);
    CHECK(number(Mirror{}) == 20);
    static_assert(number(Mirror{}) == 20, "match works at compile time");
}

TEST_CASE("match prefers the arm that names the type to a generic one") {
    const auto name = [](const Material& material) {
        return rt::match(
            material, [](const Mirror&) { return std::string("mirror"); },
            [](const auto&) { return std::string("other"); });
    };
    CHECK(name(Mirror{}) == "mirror");
    CHECK(name(Matte{}) == "other");
}

TEST_CASE("match passes a reference to the value and not a copy") {
    Material material = Mirror{};
    int& value = rt::match(material, [](auto& held) -> int& { return held.value; });
    value = 7;
    CHECK(std::get<Mirror>(material).value == 7);
}

TEST_CASE("match moves out of an rvalue variant") {
    std::variant<std::unique_ptr<int>, int> owner = std::make_unique<int>(5);
    const auto taken = rt::match(
        std::move(owner), [](std::unique_ptr<int>&& held) { return std::move(held); },
        [](int&& held) { return std::make_unique<int>(held); });
    REQUIRE(taken);
    CHECK(*taken == 5);
    CHECK_FALSE(std::get<0>(owner));
}

TEST_CASE("a type without an arm is not invocable") {
    const auto arm = [](const Matte&) { return 1; };
    using Arms = rt::Overloaded<decltype(arm)>;
    static_assert(std::is_invocable_v<Arms, const Matte&>);
    static_assert(!std::is_invocable_v<Arms, const Mirror&>);
    CHECK(rt::Overloaded{arm}(Matte{}) == 1);
}
