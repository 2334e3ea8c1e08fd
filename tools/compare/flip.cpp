// LDR-FLIP: filters the pictures as the eye does, compares colours, and weights differences at edges more.
#include "tools/compare/flip.h"

#include "tools/compare/difference.h"

#include <algorithm>
#include <cmath>

namespace rt::compare {
namespace {

const vec3 white(0.950428545f, 1, 1.088900371f); // D65 in XYZ

// ---- colours

vec3 xyz_from_linear(vec3 c) {
    return {0.412386563f * c.x + 0.357591491f * c.y + 0.180450491f * c.z,
            0.212636822f * c.x + 0.715182982f * c.y + 0.072180196f * c.z,
            0.019330620f * c.x + 0.119197164f * c.y + 0.950372587f * c.z};
}

vec3 linear_from_xyz(vec3 c) {
    return {3.241003233f * c.x - 1.537398969f * c.y - 0.498615882f * c.z,
            -0.969224252f * c.x + 1.875929984f * c.y + 0.041554226f * c.z,
            0.055639420f * c.x - 0.204011206f * c.y + 1.057148977f * c.z};
}

/// Converts to YCxCz: luminance and two opponent colours, linear in light.
vec3 ycxcz_from_linear(vec3 colour) {
    const vec3 c = xyz_from_linear(colour) / white;
    return {116 * c.y - 16, 500 * (c.x - c.y), 200 * (c.y - c.z)};
}

vec3 linear_from_ycxcz(vec3 c) {
    const float y = (c.x + 16) / 116;
    return linear_from_xyz(vec3(y + c.y / 500, y, y - c.z / 200) * white);
}

float lab_curve(float t) {
    constexpr float delta = 6.0f / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29;
}

/// Converts to CIELab with the Hunt effect: colours look less saturated in the dark.
vec3 hunt_lab(vec3 linear) {
    const vec3 c = xyz_from_linear(linear) / white;
    const float x = lab_curve(c.x), y = lab_curve(c.y), z = lab_curve(c.z);
    const float light = 116 * y - 16;
    return {light, 0.01f * light * 500 * (x - y), 0.01f * light * 200 * (y - z)};
}

/// Returns (|dL| + sqrt(da^2 + db^2))^0.7.
float colour_distance(vec3 a, vec3 b) {
    const vec3 d = a - b;
    return std::pow(std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z), 0.7f);
}

/// Maps small distances to [0, 0.95] and compresses larger ones into the rest.
float remapped(float distance, float largest) {
    constexpr float knee = 0.4f, at_knee = 0.95f;
    if (distance < knee * largest) return distance * at_knee / (knee * largest);
    return at_knee + (distance - knee * largest) / (largest - knee * largest) * (1 - at_knee);
}

// ---- single channels and their filters

struct Plane {
    int width = 0, height = 0;
    std::vector<float> values;

    Plane(int w, int h) : width(w), height(h), values(std::size_t(w) * std::size_t(h)) {}
    float* row(int y) { return values.data() + std::size_t(y) * std::size_t(width); }
    const float* row(int y) const { return values.data() + std::size_t(y) * std::size_t(width); }
};

using Kernel = std::vector<float>; ///< 2 * radius + 1 weights

int radius_of(const Kernel& kernel) {
    return int(kernel.size()) / 2;
}

/// Filters along the rows; the border pixels are repeated.
Plane across(const Plane& in, const Kernel& kernel) {
    Plane out(in.width, in.height);
    const int radius = radius_of(kernel);
    const std::size_t width = std::size_t(in.width);
    std::vector<float> padded(width + kernel.size() - 1);
    for (int y = 0; y < in.height; ++y) {
        const float* const from = in.row(y);
        std::fill_n(padded.begin(), radius, from[0]);
        std::copy_n(from, width, padded.begin() + radius);
        std::fill(padded.begin() + radius + in.width, padded.end(), from[width - 1]);
        float* const to = out.row(y);
        for (std::size_t k = 0; k < kernel.size(); ++k)
            for (std::size_t x = 0; x < width; ++x) to[x] += kernel[k] * padded[x + k];
    }
    return out;
}

/// Filters along the columns; the border pixels are repeated.
Plane down(const Plane& in, const Kernel& kernel) {
    Plane out(in.width, in.height);
    const int radius = radius_of(kernel);
    for (int y = 0; y < in.height; ++y) {
        float* const to = out.row(y);
        for (int k = -radius; k <= radius; ++k) {
            const float weight = kernel[std::size_t(k + radius)];
            const float* const from = in.row(std::clamp(y + k, 0, in.height - 1));
            for (int x = 0; x < in.width; ++x) to[x] += weight * from[x];
        }
    }
    return out;
}

template <typename Weight>
Kernel make_kernel(int radius, Weight weight) {
    Kernel kernel;
    for (int i = -radius; i <= radius; ++i) kernel.push_back(float(weight(double(i))));
    return kernel;
}

/// Scales the positive weights so that they sum to 1, and the negative ones so that they sum to -1.
void normalise(Kernel& kernel) {
    double positive = 0, negative = 0;
    for (const float weight : kernel) (weight > 0 ? positive : negative) += std::abs(double(weight));
    for (float& weight : kernel) weight = float(double(weight) / (weight > 0 ? positive : negative));
}

// ---- 1: the contrast sensitivity of the eye

/// The filter a sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees: a separable kernel with sum 1,
/// and its integral.
struct Gaussian {
    Kernel kernel;
    double volume = 0;

    Gaussian(double a, double b, double pixels_per_degree) {
        const double pi2 = 9.86960440108935861883;
        const int radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi2)) * pixels_per_degree));
        kernel = make_kernel(radius, [&](double i) {
            return std::exp(-pi2 * i * i / (pixels_per_degree * pixels_per_degree * b));
        });
        double sum = 0;
        for (const float weight : kernel) sum += double(weight);
        volume = a * std::sqrt(std::sqrt(pi2) / b) * sum * sum; // separable: both directions
        normalise(kernel);
    }
    Plane blur(const Plane& in) const { return down(across(in, kernel), kernel); }
};

/// Returns the YCxCz channels of a picture; non-finite pixels count as black.
std::vector<Plane> planes_of(const Image& image) {
    std::vector<Plane> planes(3, Plane(image.width, image.height));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const vec3 pixel = is_finite(image.pixels[i]) ? image.pixels[i] : vec3(0.0f);
        const vec3 c = ycxcz_from_linear(glm::clamp(pixel, 0.0f, 1.0f));
        for (int channel = 0; channel < 3; ++channel) planes[std::size_t(channel)].values[i] = c[channel];
    }
    return planes;
}

/// Returns each pixel after the filter of the eye, in Hunt-adjusted CIELab.
std::vector<vec3> seen(const std::vector<Plane>& planes, double pixels_per_degree) {
    const Plane y = Gaussian(1, 0.0047, pixels_per_degree).blur(planes[0]);
    const Plane cx = Gaussian(1, 0.0053, pixels_per_degree).blur(planes[1]);
    const Gaussian wide(34.1, 0.04, pixels_per_degree), narrow(13.5, 0.025, pixels_per_degree);
    const Plane cz_wide = wide.blur(planes[2]), cz_narrow = narrow.blur(planes[2]);
    const float share = float(wide.volume / (wide.volume + narrow.volume));
    std::vector<vec3> colours(y.values.size());
    for (std::size_t i = 0; i < colours.size(); ++i) {
        const float cz = share * cz_wide.values[i] + (1 - share) * cz_narrow.values[i];
        colours[i] = hunt_lab(glm::clamp(linear_from_ycxcz({y.values[i], cx.values[i], cz}), 0.0f, 1.0f));
    }
    return colours;
}

// ---- 2: edges and points

/// The strength of edges and points at each pixel.
struct Features {
    std::vector<float> edge, point;
};

std::vector<float> lengths(const Plane& x, const Plane& y) {
    std::vector<float> result(x.values.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
    return result;
}

/// Detects edges and points by the first and second derivatives of a Gaussian, as wide as the features that
/// the eye detects.
Features features(Plane light, double pixels_per_degree) {
    for (float& y : light.values) y = (y + 16) / 116;
    const double sigma = 0.5 * 0.082 * pixels_per_degree;
    const int radius = int(std::ceil(3 * sigma));
    const auto gaussian = [&](double i) { return std::exp(-i * i / (2 * sigma * sigma)); };
    Kernel smooth = make_kernel(radius, gaussian);
    Kernel first = make_kernel(radius, [&](double i) { return -i * gaussian(i); });
    Kernel second =
        make_kernel(radius, [&](double i) { return (i * i / (sigma * sigma) - 1) * gaussian(i); });
    for (Kernel* kernel : {&smooth, &first, &second}) normalise(*kernel);
    const Plane smooth_across = across(light, smooth), smooth_down = down(light, smooth);
    return {lengths(across(smooth_down, first), down(smooth_across, first)),
            lengths(across(smooth_down, second), down(smooth_across, second))};
}

} // namespace

FlipMap flip(const Image& reference, const Image& test, double pixels_per_degree) {
    check_same_size(reference, test);
    FlipMap result{reference.width, reference.height, std::vector<float>(reference.pixels.size()), 0, 0};
    if (reference.pixels.empty()) return result;
    const std::vector<Plane> a = planes_of(reference), b = planes_of(test);
    const std::vector<vec3> seen_a = seen(a, pixels_per_degree), seen_b = seen(b, pixels_per_degree);
    const Features fa = features(a[0], pixels_per_degree), fb = features(b[0], pixels_per_degree);
    const float largest = colour_distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1}));
    for (std::size_t i = 0; i < result.errors.size(); ++i) {
        const float colour = remapped(colour_distance(seen_a[i], seen_b[i]), largest);
        const float feature = std::sqrt(
            std::max(std::abs(fa.edge[i] - fb.edge[i]), std::abs(fa.point[i] - fb.point[i])) * 0.70710678f);
        const bool finite = is_finite(reference.pixels[i]) && is_finite(test.pixels[i]);
        result.errors[i] = finite ? std::clamp(std::pow(colour, 1 - feature), 0.0f, 1.0f) : 1;
        result.mean += double(result.errors[i]);
        result.max = std::max(result.max, double(result.errors[i]));
    }
    result.mean /= double(result.errors.size());
    return result;
}

} // namespace rt::compare
