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

/// What is asked of Embree's build and traversal. Medium and not robust is its default, and the fastest.
enum class Quality { medium, high, robust };

#if RT_EMBREE

inline constexpr bool has_embree = true;

/// A committed scene of one mesh, on a device of its own.
class Embree {
  public:
    Embree(const Mesh& mesh, int threads, Quality quality) {
        device = rtcNewDevice(("threads=" + std::to_string(threads) + ",set_affinity=0").c_str());
        if (!device) throw Error("Embree does not start");
        rtcSetDeviceMemoryMonitorFunction(device, monitor, this);
        warm_up(); // its threads start with the first build
        scene = rtcNewScene(device);
        rtcSetSceneBuildQuality(scene,
                                quality == Quality::high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
        if (quality == Quality::robust) rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        attach(scene, mesh, quality);
        const std::int64_t before = held;
        most = before;
        const auto start = std::chrono::steady_clock::now();
        rtcCommitScene(scene);
        seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        bytes = held - before;
        peak_bytes = most - before;
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
        const std::int64_t now = embree.held += change;
        std::int64_t top = embree.most;
        while (now > top && !embree.most.compare_exchange_weak(top, now)) {
        }
        return true;
    }

    void attach(RTCScene where, const Mesh& mesh, Quality quality) {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        if (quality == Quality::high) rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   mesh.positions.data(), 0, sizeof(vec3), mesh.positions.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   mesh.triangles.data(), 0, sizeof(mesh.triangles[0]),
                                   mesh.triangles.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(where, geometry);
        rtcReleaseGeometry(geometry);
    }

    void warm_up() {
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        mesh.triangles.assign(50'000, {0, 1, 2});
        const RTCScene small = rtcNewScene(device);
        attach(small, mesh, Quality::medium);
        rtcCommitScene(small);
        rtcReleaseScene(small);
    }

    RTCDevice device;
    std::atomic<std::int64_t> held = 0, most = 0;
};

/// Embree's manual asks that denormal numbers count as zero while it traces.
struct FlushDenormals {
#if defined(__SSE2__)
    FlushDenormals() : before(_mm_getcsr()) {
        _mm_setcsr(before | 0x8040);
    }
    ~FlushDenormals() {
        _mm_setcsr(before);
    }
    unsigned before;
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

inline Found nearest(const Embree& embree, RTCIntersectContext& context, const Ray& ray) {
    RTCRayHit query;
    query.ray = embree_ray(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(embree.scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {query.ray.tfar, query.hit.u, query.hit.v, query.hit.primID};
}

inline bool any_hit(const Embree& embree, RTCIntersectContext& context, const Ray& ray) {
    RTCRay query = embree_ray(ray);
    rtcOccluded1(embree.scene, &context, &query);
    return query.tfar < 0; // minus infinity
}

#else

inline constexpr bool has_embree = false;

#endif

} // namespace rt::bench
