// The other side of the comparison: Embree 3 (Wald et al. 2014), one ray at a time.
#pragma once

#include "01_spheres/ray.h"
#include "05_mesh_bvh/mesh.h"
#include "common/util/error.h"
#include "tools/bench/ours.h"

#if RT_EMBREE
#include <embree3/rtcore.h>
#endif
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <atomic>
#include <chrono>
#include <string>

namespace rt::bench {

#if RT_EMBREE

inline constexpr bool has_embree = true;

/// A committed scene of one mesh, on a device of its own. Embree's defaults (medium quality, not robust) are
/// the fastest.
class Embree {
  public:
    Embree(const Mesh& mesh, int threads) {
        device = rtcNewDevice(("threads=" + std::to_string(threads) + ",set_affinity=0").c_str());
        if (!device) throw Error("Embree does not start");
        rtcSetDeviceMemoryMonitorFunction(device, monitor, this);
        warm_up(); // its threads start with the first build
        scene = rtcNewScene(device);
        attach(scene, mesh);
        const std::int64_t before = allocated;
        peak = before;
        const auto start = std::chrono::steady_clock::now();
        rtcCommitScene(scene);
        seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        bytes = allocated - before;
        peak_bytes = peak - before;
        if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw Error("Embree reports an error");
    }
    ~Embree() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    double seconds = 0; ///< that rtcCommitScene took
    std::int64_t bytes = 0, peak_bytes = 0;
    RTCScene scene;

  private:
    static bool monitor(void* self, ssize_t change, bool) {
        auto& embree = *static_cast<Embree*>(self);
        const std::int64_t now = embree.allocated += change;
        std::int64_t top = embree.peak;
        while (now > top && !embree.peak.compare_exchange_weak(top, now)) {
        }
        return true;
    }

    void attach(RTCScene target, const Mesh& mesh) {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   mesh.positions.data(), 0, sizeof(vec3), mesh.positions.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   mesh.triangles.data(), 0, sizeof(mesh.triangles[0]),
                                   mesh.triangles.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(target, geometry);
        rtcReleaseGeometry(geometry);
    }

    void warm_up() {
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        mesh.triangles.assign(50'000, {0, 1, 2});
        const RTCScene small = rtcNewScene(device);
        attach(small, mesh);
        rtcCommitScene(small);
        rtcReleaseScene(small);
    }

    RTCDevice device;
    std::atomic<std::int64_t> allocated = 0, peak = 0;
};

/// What a thread needs to send rays. Embree's manual wants denormal numbers to count as zero meanwhile.
class EmbreeQuery {
  public:
    explicit EmbreeQuery(const Embree& embree) : scene(embree.scene) {
        rtcInitIntersectContext(&context);
#if defined(__SSE2__)
        _mm_setcsr(control | 0x8040);
    }
    ~EmbreeQuery() {
        _mm_setcsr(control);
#endif
    }
    EmbreeQuery(const EmbreeQuery&) = delete;
    EmbreeQuery& operator=(const EmbreeQuery&) = delete;

    RTCScene scene;
    RTCIntersectContext context;

  private:
#if defined(__SSE2__)
    unsigned control = _mm_getcsr();
#endif
};

inline RTCRay embree_ray(const Ray& ray) {
    RTCRay r;
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.tnear = ray.t_min;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.time = 0;
    r.tfar = ray.t_max;
    r.mask = 0xffffffff;
    r.id = 0;
    r.flags = 0;
    return r;
}

inline ClosestHit closest_hit(EmbreeQuery& query, const Ray& ray) {
    RTCRayHit hit;
    hit.ray = embree_ray(ray);
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(query.scene, &query.context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {hit.ray.tfar, hit.hit.u, hit.hit.v, hit.hit.primID};
}

inline bool any_hit(EmbreeQuery& query, const Ray& ray) {
    RTCRay shadow = embree_ray(ray);
    rtcOccluded1(query.scene, &query.context, &shadow);
    return shadow.tfar < 0; // minus infinity
}

#else // what the benchmark compiles with where there is no Embree; it makes none

inline constexpr bool has_embree = false;

struct Embree {
    Embree(const Mesh&, int) {}
    double seconds = 0;
    std::int64_t bytes = 0, peak_bytes = 0;
};

struct EmbreeQuery {
    explicit EmbreeQuery(const Embree&) {}
};

inline ClosestHit closest_hit(EmbreeQuery&, const Ray&) {
    return {};
}

inline bool any_hit(EmbreeQuery&, const Ray&) {
    return false;
}

#endif

} // namespace rt::bench
