// Models and bitmaps as plain bytes: one description of the order, for writing them and for reading them.
#pragma once

#include "common/image/image_file.h"
#include "common/model/obj_file.h"

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace rt {

struct Packer {
    std::string bytes;

    void raw(const void* data, std::size_t count) { bytes.append(static_cast<const char*>(data), count); }
    std::uint32_t size(std::size_t count) {
        const auto number = std::uint32_t(count);
        raw(&number, sizeof number);
        return number;
    }
};

struct Unpacker {
    std::span<const char> bytes;

    void raw(void* data, std::size_t count) {
        std::memcpy(data, bytes.data(), count);
        bytes = bytes.subspan(count);
    }
    std::uint32_t size(std::size_t) {
        std::uint32_t number = 0;
        raw(&number, sizeof number);
        return number;
    }
};

template <typename Side, typename Value>
void pack(Side& side, Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    side.raw(static_cast<void*>(&value), sizeof value);
}

/// A list of plain values.
template <typename Side, typename Value>
void pack_list(Side& side, std::vector<Value>& list) {
    static_assert(std::is_trivially_copyable_v<Value>);
    list.resize(side.size(list.size()));
    side.raw(static_cast<void*>(list.data()), list.size() * sizeof(Value));
}

/// A list of values that `each` packs.
template <typename Side, typename Value, typename Each>
void pack_each(Side& side, std::vector<Value>& list, const Each& each) {
    list.resize(side.size(list.size()));
    for (Value& value : list) each(side, value);
}

/// 16-bit values, of which the upper eight are enough: an 8-bit value v is stored as v * 257.
template <typename Side>
void pack_values(Side& side, std::vector<std::uint16_t>& values) {
    std::vector<std::uint8_t> small(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) small[i] = std::uint8_t(values[i] / 257);
    pack_list(side, small);
    values.resize(small.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::uint16_t(small[i] * 257);
}

template <typename Side>
void pack_bitmap(Side& side, Bitmap& bitmap) {
    pack(side, bitmap.width);
    pack(side, bitmap.height);
    pack_values(side, bitmap.values);
    pack_values(side, bitmap.opacity);
}

template <typename Side>
void pack_mask(Side& side, Mask& mask) {
    pack(side, mask.width);
    pack(side, mask.height);
    pack_values(side, mask.opacity);
}

template <typename Side>
void pack_material(Side& side, ObjMaterial& material) {
    pack(side, material.diffuse);
    pack(side, material.emission);
    pack(side, material.reflectivity);
    pack(side, material.ior);
    pack(side, material.glass);
    pack(side, material.texture);
    pack(side, material.mask);
}

template <typename Side>
void pack_model(Side& side, ObjModel& model) {
    pack(side, model.origin);
    pack_list(side, model.positions);
    pack_list(side, model.normals);
    pack_list(side, model.uvs);
    pack_list(side, model.colors);
    pack_list(side, model.triangles);
    pack_list(side, model.smoothing_groups);
    pack_list(side, model.triangle_materials);
    pack_each(side, model.materials, pack_material<Side>);
    pack_each(side, model.textures, pack_bitmap<Side>);
    pack_each(side, model.masks, pack_mask<Side>);
}

} // namespace rt
