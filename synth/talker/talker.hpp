// A talker: the face, lips and codex of one person, as a folder holds them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "facemodel/gltf.hpp"
#include "synth/pose/pose.hpp"
#include "viapoints/codex.hpp"

namespace viaface {

// Immutable once loaded: any number of threads may speak with it.
struct Talker {
    nlohmann::json description;  // talker.json
    Face face;
    Codex codex;
    Poser poser;

    std::string name() const { return description.at("name"); }
    std::string motion_provenance() const { return description.at("provenance").at("motion"); }
};

// talker.json, face.glb, estimators.bin and codex.via. InputError when the folder is none, or a file of it is
// damaged.
nlohmann::json read_talker_json(const std::filesystem::path& folder);
Talker load_talker(const std::filesystem::path& folder, Textures textures = Textures::kRead);

// What talker.json says of every talker: how its files are to be read.
nlohmann::json talker_description(const std::string& name, const std::string& summary);

}  // namespace viaface
