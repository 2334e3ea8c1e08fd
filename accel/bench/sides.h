// The two sides of the comparison: the fast tree, and Embree 3 (Wald et al. 2014), one ray at a time. For one
// source file of a program, since it replaces operator new and delete by ones that count.
#pragma once

#include "accel/bench/agreement.h"
#include "tools/bench/numbers.h"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>
#include <span>

#if RT_EMBREE
#include <embree3/rtcore.h>
#endif
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace rt::bench {

/// Counts bytes, and how many there were at most, from any number of threads.
struct ByteCounter {
    std::atomic<std::int64_t> bytes = 0, peak = 0;

    void add(std::int64_t change) {
        const std::int64_t now = bytes += change;
        std::int64_t most = peak;
        while (now > most && !peak.compare_exchange_weak(most, now)) {
        }
    }
};

inline ByteCounter heap; ///< of aligned operator new

/// What a build takes, and keeps or needs meanwhile of memory.
struct BuildCost {
    double seconds = unknown, bytes = unknown, peak_bytes = unknown;
};

BuildCost measure_build(ByteCounter& memory, const auto& build) {
    const std::int64_t before = memory.peak = memory.bytes.load();
    const Stopwatch watch;
    build();
    return {watch.wall(), double(memory.bytes - before), double(memory.peak - before)};
}

/// The hit of a ray of which only counts that it hits.
inline std::optional<accel::Hit> shadow_hit(bool hits) {
    return hits ? std::optional(accel::Hit{}) : std::nullopt;
}

struct Ours {
    accel::TriangleBvh bvh;
    BuildCost cost;

    Ours(const accel::TriangleMesh& mesh, int)
        : cost(measure_build(heap, [&] { bvh = accel::build_triangle_bvh(mesh); })) {}

    void trace(std::span<const accel::Ray> rays, std::optional<accel::Hit>* hits, bool shadow) const {
        for (const accel::Ray& ray : rays)
            *hits++ = shadow ? shadow_hit(accel::any_hit(bvh, ray)) : accel::closest_hit(bvh, ray);
    }
};

#if RT_EMBREE

/// A scene of one mesh, on a device of its own. Embree's defaults (medium, not robust) are the fastest.
class Embree {
  public:
    BuildCost cost;

    Embree(const accel::TriangleMesh& mesh, int threads) {
        device = rtcNewDevice(("threads=" + std::to_string(threads) + ",set_affinity=0").c_str());
        if (!device) throw Error("Embree does not start");
        const auto count_memory = [](void* counter, ssize_t change, bool) {
            static_cast<ByteCounter*>(counter)->add(change);
            return true;
        };
        rtcSetDeviceMemoryMonitorFunction(device, count_memory, &memory);
        const std::vector<std::array<std::uint32_t, 3>> many(50'000, mesh.triangles[0]);
        const RTCScene first = make_scene({mesh.vertices, many});
        rtcCommitScene(first); // starts the threads
        rtcReleaseScene(first);
        scene = make_scene(mesh);
        cost = measure_build(memory, [&] { rtcCommitScene(scene); });
        if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw Error("Embree reports an error");
    }
    ~Embree() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    /// Embree's manual wants denormal numbers to count as zero meanwhile.
    void trace(std::span<const accel::Ray> rays, std::optional<accel::Hit>* hits, bool shadow) const {
#if defined(__SSE2__)
        const unsigned control = _mm_getcsr();
        _mm_setcsr(control | 0x8040);
#endif
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (const auto& [o, d, t_min, t_max] : rays) {
            RTCRayHit r;
            r.ray = {o.x, o.y, o.z, t_min, d.x, d.y, d.z, 0, t_max, 0xffffffff, 0, 0};
            r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            if (shadow) {
                rtcOccluded1(scene, &context, &r.ray);
                *hits++ = shadow_hit(r.ray.tfar < 0); // minus infinity
            } else {
                rtcIntersect1(scene, &context, &r);
                const accel::Hit hit{r.ray.tfar, r.hit.u, r.hit.v, r.hit.primID};
                *hits++ = r.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::nullopt : std::optional(hit);
            }
        }
#if defined(__SSE2__)
        _mm_setcsr(control);
#endif
    }

  private:
    RTCScene make_scene(const accel::TriangleMesh& mesh) {
        const auto& [vertices, triangles] = mesh;
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices.data(), 0,
                                   sizeof(vertices[0]), vertices.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(), 0,
                                   sizeof(triangles[0]), triangles.size());
        rtcCommitGeometry(geometry);
        const RTCScene made = rtcNewScene(device);
        rtcAttachGeometry(made, geometry);
        rtcReleaseGeometry(geometry);
        return made;
    }

    ByteCounter memory;
    RTCDevice device;
    RTCScene scene;
};

#else

using Embree = Ours; // takes the place of Embree where there is none, and is never made

#endif

} // namespace rt::bench

// The trees are in vectors of aligned memory. The size of a block stands before it.
void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto unit = std::size_t(alignment);
    char* const block = static_cast<char*>(std::aligned_alloc(unit, unit + (size + unit - 1) / unit * unit));
    if (!block) throw std::bad_alloc();
    std::memcpy(block, &size, sizeof size);
    rt::bench::heap.add(std::int64_t(size));
    return block + unit;
}
void operator delete(void* memory, std::align_val_t alignment) noexcept {
    if (!memory) return;
    char* const block = static_cast<char*>(memory) - std::size_t(alignment);
    std::size_t size = 0;
    std::memcpy(&size, block, sizeof size);
    rt::bench::heap.add(-std::int64_t(size));
    std::free(block);
}
