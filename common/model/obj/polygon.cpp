// Triangulates a polygon by clipping ears (Meisters, American Mathematical Monthly, 1975).
// We do not use tinyobjloader's triangulation: it depends on where the origin is and splits concave quads
// along the wrong diagonal.
#include "common/model/obj/polygon.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>

namespace rt {
namespace {

using glm::dvec2;

/// Returns twice the signed area of the triangle a, b, c: positive if it is counter-clockwise.
double turn(dvec2 a, dvec2 b, dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Returns Newell's normal, whose length is twice the area, for a polygon of any shape.
dvec3 newell_normal(const std::vector<vec3>& corners) {
    const dvec3 origin(corners.front()); // keeps precision far from the origin
    dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += cross(dvec3(corners[i]) - origin, dvec3(corners[(i + 1) % corners.size()]) - origin);
    return normal;
}

/// Projects the polygon along the major axis of its normal; the result is counter-clockwise.
std::vector<dvec2> flattened(const std::vector<vec3>& corners) {
    const dvec3 normal = newell_normal(corners);
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
        if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    }
    const int right = (axis + 1) % 3, up = (axis + 2) % 3;
    const double side = normal[axis] < 0 ? -1 : 1;
    std::vector<dvec2> flat;
    for (const vec3& corner : corners) flat.emplace_back(side * double(corner[right]), double(corner[up]));
    return flat;
}

/// A k-d tree (Bentley 1975) of points in the plane, each node split in half along the
/// longer side of its box.
class PointTree {
  public:
    PointTree(const std::vector<dvec2>& flat_, std::vector<int> points_);

    void remove(int point);
    /// Returns whether `test` is true for any point that may be in the triangle.
    template <typename Test>
    bool any_near(const std::array<dvec2, 3>& triangle, const Test& test, std::size_t node = 1) const;

  private:
    struct Node {
        dvec2 low, high;
        std::size_t begin, end; ///< range in `points`
        std::size_t left;       ///< number of points not removed
    };
    static constexpr std::size_t leaf_size = 8;

    void build(std::size_t node, std::size_t begin, std::size_t end);
    bool is_apart(const Node& node, const std::array<dvec2, 3>& triangle) const;

    const std::vector<dvec2>& flat;
    std::vector<int> points;
    std::vector<std::size_t> places; ///< index in `points` of each point
    std::vector<Node> nodes;         ///< the children of node n are 2 n and 2 n + 1
};

PointTree::PointTree(const std::vector<dvec2>& flat_, std::vector<int> points_)
    : flat(flat_), points(std::move(points_)), places(flat.size()) {
    nodes.resize(std::max<std::size_t>(2, 2 * std::bit_ceil(points.size() / leaf_size + 1)));
    build(1, 0, points.size());
    for (std::size_t i = 0; i < points.size(); ++i) places[std::size_t(points[i])] = i;
}

void PointTree::build(std::size_t node, std::size_t begin, std::size_t end) {
    const auto at = [&](int point) { return flat[std::size_t(point)]; };
    dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (std::size_t i = begin; i < end; ++i) low = min(low, at(points[i])), high = max(high, at(points[i]));
    nodes[node] = {low, high, begin, end, end - begin};
    if (end - begin <= leaf_size) return;
    const int axis = high.x - low.x > high.y - low.y ? 0 : 1;
    const auto first = points.begin() + std::ptrdiff_t(begin), last = points.begin() + std::ptrdiff_t(end);
    const auto middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, [&](int i, int j) { return at(i)[axis] < at(j)[axis]; });
    build(2 * node, begin, std::size_t(middle - points.begin()));
    build(2 * node + 1, std::size_t(middle - points.begin()), end);
}

void PointTree::remove(int point) {
    const std::size_t place = places[std::size_t(point)];
    for (std::size_t node = 1;; node = 2 * node + (place < nodes[2 * node].end ? 0 : 1)) {
        --nodes[node].left;
        if (nodes[node].end - nodes[node].begin <= leaf_size) return;
    }
}

/// Returns whether the box is outside one of the triangle's edges, or the triangle is outside the box.
bool PointTree::is_apart(const Node& node, const std::array<dvec2, 3>& triangle) const {
    const auto& [a, b, c] = triangle;
    if (any(lessThan(max(max(a, b), c), node.low)) || any(greaterThan(min(min(a, b), c), node.high)))
        return true;
    for (std::size_t i = 0; i < 3; ++i) {
        const dvec2 from = triangle[i], to = triangle[(i + 1) % 3];
        const dvec2 innermost(to.y > from.y ? node.low.x : node.high.x,
                              to.x > from.x ? node.high.y : node.low.y);
        if (turn(from, to, innermost) < 0) return true;
    }
    return false;
}

template <typename Test>
bool PointTree::any_near(const std::array<dvec2, 3>& triangle, const Test& test, std::size_t node) const {
    const Node& n = nodes[node];
    if (n.left == 0 || is_apart(n, triangle)) return false;
    if (n.end - n.begin > leaf_size)
        return any_near(triangle, test, 2 * node) || any_near(triangle, test, 2 * node + 1);
    return std::any_of(points.begin() + std::ptrdiff_t(n.begin), points.begin() + std::ptrdiff_t(n.end),
                       test);
}

/// The remaining polygon while its ears are clipped.
class Ring {
  public:
    explicit Ring(const std::vector<dvec2>& flat_);

    int before(int i) const { return corners[std::size_t(i)].before; }
    int behind(int i) const { return corners[std::size_t(i)].behind; }
    std::array<int, 3> triangle(int tip) const { return {before(tip), tip, behind(tip)}; }
    int size() const { return count; }
    bool is_ear(int tip) const;
    void clip(int tip);

  private:
    struct Corner {
        int before, behind;
        bool in_tree;
    };
    dvec2 point(int i) const { return flat[std::size_t(i)]; }
    bool turns_left(int i) const { return turn(point(before(i)), point(i), point(behind(i))) > 0; }
    void leave_tree(int i);

    const std::vector<dvec2>& flat;
    int count;
    std::vector<Corner> corners;
    PointTree tree; ///< the vertices that do not turn left
};

std::vector<int> not_left(const std::vector<dvec2>& flat) {
    std::vector<int> list;
    const std::size_t n = flat.size();
    for (std::size_t i = 0; i < n; ++i)
        if (!(turn(flat[(i + n - 1) % n], flat[i], flat[(i + 1) % n]) > 0)) list.push_back(int(i));
    return list;
}

Ring::Ring(const std::vector<dvec2>& flat_)
    : flat(flat_), count(int(flat.size())), tree(flat, not_left(flat)) {
    for (int i = 0; i < count; ++i) corners.push_back({(i + count - 1) % count, (i + 1) % count, false});
    for (const int i : not_left(flat)) corners[std::size_t(i)].in_tree = true;
}

/// Returns whether a vertex is an ear: it turns left, and no other vertex is inside its triangle. It is
/// enough to test vertices that do not turn left, since one of them would be the first to enter the triangle.
bool Ring::is_ear(int tip) const {
    if (!turns_left(tip)) return false;
    const dvec2 a = point(before(tip)), b = point(tip), c = point(behind(tip));
    return !tree.any_near({a, b, c}, [&](int i) {
        const dvec2 p = point(i);
        if (!corners[std::size_t(i)].in_tree || p == a || p == b || p == c) return false;
        return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
    });
}

void Ring::leave_tree(int i) {
    if (corners[std::size_t(i)].in_tree) tree.remove(i);
    corners[std::size_t(i)].in_tree = false;
}

void Ring::clip(int tip) {
    const auto [a, b, c] = triangle(tip);
    corners[std::size_t(a)].behind = c;
    corners[std::size_t(c)].before = a;
    --count;
    leave_tree(b);
    if (turns_left(a)) leave_tree(a);
    if (turns_left(c)) leave_tree(c);
}

/// Clips ears around the polygon, since always restarting at the first vertex makes longer triangles. A
/// vertex can become an ear only when a neighbour is clipped, so each is tested a few times in all. This does
/// not hold for polygons that touch or cross themselves: they get further rounds, at most 64 in all, and then
/// lose an arbitrary vertex at each step.
std::vector<std::array<int, 3>> clip_ears(const std::vector<dvec2>& flat) {
    Ring ring(flat);
    std::vector<std::array<int, 3>> triangles;
    std::set<int> candidates;
    int at = 1;
    bool any_clipped = true; // since the current round began
    for (int rounds_left = 64; ring.size() > 3;) {
        if (candidates.empty() && any_clipped && rounds_left-- > 0) {
            for (int i = 0; i < ring.size(); ++i, at = ring.behind(at)) candidates.insert(at);
            any_clipped = false;
        }
        auto next = candidates.lower_bound(at);
        if (next == candidates.end()) next = candidates.begin();
        const bool found = next != candidates.end();
        const int tip = found ? *next : at;
        if (found) candidates.erase(next);
        at = ring.behind(tip);
        if (found && !ring.is_ear(tip)) continue;
        triangles.push_back(ring.triangle(tip));
        candidates.insert({ring.before(tip), at});
        ring.clip(tip);
        at = ring.behind(at);
        any_clipped = true;
    }
    while (ring.before(at) > std::min(at, ring.behind(at))) at = ring.behind(at); // start at the lowest index
    triangles.push_back(ring.triangle(at));
    return triangles;
}

/// Splits a quad along its shorter diagonal, if that is inside.
std::vector<std::array<int, 3>> cut_quad(const std::vector<vec3>& corners, const std::vector<dvec2>& flat) {
    const auto half = [&](std::size_t i, std::size_t j, std::size_t k) {
        return turn(flat[i], flat[j], flat[k]);
    };
    const bool inside_02 = half(0, 1, 2) > 0 && half(0, 2, 3) > 0;
    const bool inside_13 = half(0, 1, 3) > 0 && half(1, 2, 3) > 0;
    const bool shorter_13 = distance(corners[1], corners[3]) < distance(corners[0], corners[2]);
    if (inside_13 && (!inside_02 || shorter_13)) return {{0, 1, 3}, {1, 2, 3}};
    return {{0, 1, 2}, {0, 2, 3}};
}

} // namespace

std::vector<std::array<int, 3>> triangulate(const std::vector<vec3>& corners) {
    if (corners.size() == 3) return {{0, 1, 2}};
    const std::vector<dvec2> flat = flattened(corners);
    return corners.size() == 4 ? cut_quad(corners, flat) : clip_ears(flat);
}

} // namespace rt
