// Facts about textured surfaces: where each point of the texture appears, and how it is lit.
#include "common/math/random.h"
#include "tests/06_textures/scenes.h"
#include "tests/check.h"

using namespace rt;

TEST_CASE("a texture on a sphere is upright and not mirrored") {
    Scene scene = evenly_lit();
    const int picture = add(scene.textures, card());
    scene.spheres = {{{3, -1, 2}, 1.5f, add(scene.materials, ImageTexture{picture})}};
    build_bvhs(scene);
    // From far above the centre of each texel, whose longitude and latitude are known.
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            const float longitude = ((float(x) + 0.5f) / 3 - 0.5f) * 2 * pi,
                        latitude = ((float(y) + 0.5f) / 2 - 0.5f) * pi;
            const vec3 outward{std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                               -std::cos(latitude) * std::sin(longitude)};
            const Ray ray{vec3(3, -1, 2) + 9.0f * outward, -2.0f * outward};
            INFO("texel ", x, ", ", y);
            CHECK(radiance(scene, ray, 2) == approx(texel(card(), x, y), 1e-4f));
        }
    }
}

TEST_CASE("a texture on a quad has its lower left corner at the quad's corner") {
    Scene scene = evenly_lit();
    const int picture = add(scene.textures, card());
    // Oblique, and rotated in its plane.
    const vec3 corner{-2, 1, -4}, u{3, 0.5f, 1}, v{-0.7f, 2, 0.4f};
    scene.quads = {{corner, u, v, add(scene.materials, ImageTexture{picture})}};
    build_bvhs(scene);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            const vec3 target = corner + (float(x) + 0.5f) / 3 * u + (float(y) + 0.5f) / 2 * v;
            const vec3 from{1, 2, 6};
            INFO("texel ", x, ", ", y);
            CHECK_MESSAGE(radiance(scene, Ray{from, target - from}, 2) == approx(texel(card(), x, y), 1e-4f),
                          "u runs along edge_u and v along edge_v");
        }
    }
}

TEST_CASE("a texture on a mesh follows the uv coordinates of the vertices") {
    // Two triangles over [0, 3] x [0, 2], with a different vertex order.
    ObjModel file;
    file.positions = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}};
    file.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    file.triangles = {{{{0, 0}, {1, 1}, {2, 2}}}, {{{3, 3}, {0, 0}, {2, 2}}}};
    file.triangle_materials = {0, 0};
    Bitmap bitmap{3, 2, {}};
    for (int i = 0; i < 18; ++i) bitmap.values.push_back(code(14 * i));
    file.textures = {bitmap};
    file.materials = {{.name = "card", .diffuse = vec3(1), .texture = 0}};
    Scene scene = evenly_lit();
    add_model(scene, file, 40);
    build_bvhs(scene);
    const Texture texture = make_texture(bitmap);
    for (int i = 0; i < 29; ++i) {
        for (int k = 0; k < 19; ++k) {
            const float x = 0.1f + 0.1f * float(i), y = 0.1f + 0.1f * float(k) - 0.003f * float(i);
            if (!(seen_at(scene, x, y) == approx(bilinear(texture, {x / 3, y / 2}), 1e-4f)))
                FAIL_CHECK("at (", x, ", ", y, ") it shows ", seen_at(scene, x, y), " instead of ",
                           bilinear(texture, {x / 3, y / 2}),
                           " (a break along the diagonal: weights in the wrong order)");
        }
    }
    CHECK(seen_at(scene, 0.5f, 0.5f) == approx(texture.texels[3], 1e-4f));
    CHECK(seen_at(scene, 2.5f, 1.5f) == approx(texture.texels[2], 1e-4f));
}

TEST_CASE("a lit texture reflects albedo / pi of the irradiance and adds its emission") {
    Scene scene;
    const int picture = add(scene.textures, texture_of(1, 1, {{0.8f, 0.4f, 0.2f}}));
    scene.planes = {{{0, 0, 0},
                     {0, 0, 1},
                     add(scene.materials,
                         ImageTexture{.texture = picture, .tint = {0.5f, 1, 1}, .emission = {0, 0, 3}})}};
    scene.lights = {{{0, 0, 2}, vec3(pi)}};
    build_bvhs(scene);
    CHECK(radiance(scene, Ray{{0.5f, 0, 1}, {-0.5f, 0, -1}}, 2) == approx(vec3(0.1f, 0.1f, 0.05f + 3)));
}

TEST_CASE("a reflective coat covers a texture like any other material") {
    Scene scene;
    scene.sky = {vec3(0.2f), vec3(1)};
    const int base = add(scene.materials, ImageTexture{add(scene.textures, card()), vec3(1)});
    const int mirror = add(scene.materials, Mirror{});
    const int coat = add(scene.materials, Coated{0.3f, base});
    const auto seen = [&](int material) {
        scene.spheres = {{{0, 0, 0}, 2, material}};
        build_bvhs(scene);
        return radiance(scene, Ray{{1, 1.2f, 5}, {-0.2f, 0.05f, -1}}, 3);
    };
    CHECK(seen(coat) == approx(0.7f * seen(base) + 0.3f * seen(mirror)));
}

TEST_CASE("a checkerboard of .8 and .15 seen from far away averages .475") {
    // 400 x 400 rays over about 3,000 squares: the mean of a fair coin between .8 and .15 has a
    // standard error of .325 / 400 = .0008 (less, because the rays are stratified). |z| < 4:
    // one false alarm in 16,000.
    Scene scene = evenly_lit();
    scene.planes = {
        {{0.3f, 0, 0.2f}, {0, 1, 0}, add(scene.materials, Checkerboard{vec3(0.8f), vec3(0.15f), 0.37f})}};
    build_bvhs(scene);
    Random random(72);
    Mean mean;
    for (int i = 0; i < 160000; ++i) {
        const vec2 jitter = random.get_2d();
        const vec2 p = vec2(float(i % 400), float(i / 400)) + jitter;
        const vec3 from{0, 60, 0};
        const vec3 target{(p.x - 200) / 20, 0, (p.y - 200) / 20};
        mean.add(double(radiance(scene, Ray{from, target - from}, 1).x));
    }
    INFO(mean.against(0.475));
    CHECK(std::abs(mean.z(0.475)) < 4);
}

TEST_CASE("a texture of .8 and .15 seen from far away averages .475 too") {
    Scene scene = evenly_lit();
    const Texture squares = texture_of(2, 2, {vec3(0.8f), vec3(0.15f), vec3(0.15f), vec3(0.8f)});
    scene.quads = {
        {{-10, 0, 10},
         {20, 0, 0},
         {0, 0, -20},
         add(scene.materials, ImageTexture{.texture = add(scene.textures, squares), .uv_scale = vec2(31)})}};
    build_bvhs(scene);
    Random random(73);
    Mean mean;
    for (int i = 0; i < 100000; ++i) {
        const vec2 p = 19.9f * (random.get_2d() - 0.5f);
        mean.add(double(radiance(scene, Ray{{p.x, 60, p.y}, {0, -2, 0}}, 1).x));
    }
    INFO(mean.against(0.475));
    CHECK(std::abs(mean.z(0.475)) < 4);
}

TEST_CASE("tinted glass, mirrors and depth work in a textured scene as in step 04") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    Scene scene = evenly_lit();
    scene.spheres = {{{1, 2, 3}, 2, add(scene.materials, Dielectric{{1, absorption}})},
                     {{1, 2, 3}, 0.5f, add(scene.materials, Mirror{{0.5f, 0.6f, 0.7f}})}};
    build_bvhs(scene);
    const Ray ray{{1, 2, 9}, {0, 0, -2}};
    CHECK(radiance(scene, ray, 5) == approx(vec3(0.5f, 0.6f, 0.7f) * exp(-absorption * 3.0f), 1e-4f));
    scene.spheres[0].material = add(scene.materials, Dielectric{{1.5f}});
    scene.spheres.pop_back();
    build_bvhs(scene);
    CHECK(radiance(scene, ray, 1) == approx(vec3(0.04f)));
    CHECK(radiance(scene, ray, 2) == approx(vec3(0.9616f)));
    CHECK(radiance(scene, ray, 30) == approx(vec3(1), 1e-4f));
}
